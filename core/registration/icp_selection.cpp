#include "core/registration/icp_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

constexpr int circle_parts = 16;
constexpr int height_parts = 8;

/// Part of the half sphere (normals point either way) of equal area.
std::size_t facing_part(const Eigen::Vector3f& normal) {
  const Eigen::Vector3d n = (normal.z() < 0.0F ? -normal : normal).cast<double>();
  const int height = std::min(height_parts - 1, static_cast<int>(n.z() * height_parts));
  const double turn = (std::atan2(n.y(), n.x()) + pi) / (2.0 * pi);
  const int circle = std::min(circle_parts - 1, static_cast<int>(turn * circle_parts));
  return static_cast<std::size_t>(height * circle_parts + circle);
}

/// The first `count` of a list, by chance (Fisher, Yates).
void keep_by_chance(std::vector<std::size_t>& list, std::size_t count, const Random& random) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto other = i + static_cast<std::size_t>(random.uniform(i) * static_cast<double>(list.size() - i));
    std::swap(list[i], list[other]);
  }
  list.resize(count);
}

/// As many from each part as there are, the rest shared among those that have more.
std::vector<std::size_t> by_facing(const IcpCloud& source, std::size_t samples, std::uint64_t seed,
                                   std::uint64_t iteration) {
  std::vector<std::vector<std::size_t>> parts(circle_parts * height_parts);
  for (std::size_t i = 0; i < source.points.size(); ++i) parts[facing_part(source.normals[i])].push_back(i);
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<std::size_t> selected;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t share = (samples - selected.size()) / (parts.size() - p);
    keep_by_chance(parts[p], std::min(share, parts[p].size()), Random(seed, 1000 * iteration + p));
    selected.insert(selected.end(), parts[p].begin(), parts[p].end());
  }
  return selected;
}

}  // namespace

std::vector<std::size_t> selected_points(const IcpCloud& source, const IcpOptions& options, int iteration) {
  const std::size_t n = source.points.size();
  const auto samples = static_cast<std::size_t>(options.samples);
  std::vector<std::size_t> selected;
  if (options.selection == IcpSelection::all || n <= samples) {
    selected.resize(n);
    std::iota(selected.begin(), selected.end(), std::size_t{0});
    return selected;
  }
  const auto seed = static_cast<std::uint64_t>(options.seed);
  const auto stream = static_cast<std::uint64_t>(iteration);
  if (options.selection == IcpSelection::uniform) {
    for (std::size_t i = 0; i < samples; ++i) selected.push_back(i * n / samples);
  } else if (options.selection == IcpSelection::random) {
    selected.resize(n);
    std::iota(selected.begin(), selected.end(), std::size_t{0});
    keep_by_chance(selected, samples, Random(seed, stream));
  } else {
    selected = by_facing(source, samples, seed, stream);
  }
  std::sort(selected.begin(), selected.end());
  return selected;
}

}  // namespace adit
