#include "core/profiling/undulation.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace adit {
namespace {

constexpr double least_gap_m = 0.2;  // for the ratio: less is texture

/// Deviations along one line of cells; nothing where a cell was not measured.
struct Line {
  std::vector<std::optional<double>> deviations;
  double step_m = 0.1;
};

struct Laid {
  double depth_m = 0.0, ratio = 0.0;
  std::size_t deepest = 0;  ///< index in the line
};

/// The edge over the cells [first, last]; nothing when they are not measured well enough.
std::optional<Laid> laid_edge(const Line& line, std::size_t first, std::size_t last) {
  std::vector<std::size_t> hull;  // lower hull: innermost deviations
  std::size_t missing = 0;
  const auto d = [&](std::size_t i) { return *line.deviations[i]; };
  for (std::size_t i = first; i <= last; ++i) {
    if (!line.deviations[i]) {
      if (++missing > 1 || i == first || i == last) return std::nullopt;
      continue;
    }
    missing = 0;
    while (hull.size() >= 2) {
      const std::size_t a = hull[hull.size() - 2], b = hull.back();
      const double slope_ab = (d(b) - d(a)) / static_cast<double>(b - a);
      const double slope_bi = (d(i) - d(b)) / static_cast<double>(i - b);
      if (slope_bi > slope_ab) break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  Laid laid;
  for (std::size_t k = 0; k + 1 < hull.size(); ++k) {
    const std::size_t a = hull[k], b = hull[k + 1];
    const double length_m = static_cast<double>(b - a) * line.step_m;
    for (std::size_t i = a + 1; i < b; ++i) {
      if (!line.deviations[i]) continue;
      const double chord = d(a) + (d(b) - d(a)) * static_cast<double>(i - a) / static_cast<double>(b - a);
      const double depth_m = d(i) - chord;
      if (length_m >= least_gap_m) laid.ratio = std::max(laid.ratio, depth_m / length_m);
      if (depth_m <= laid.depth_m) continue;
      laid.depth_m = depth_m;
      laid.deepest = i;
    }
  }
  return laid;
}

/// Depths and ratios of all places, and the deepest of them.
struct Found {
  std::vector<double> depths;
  std::size_t over = 0;
  double max_ratio = 0.0;
  double max_depth_m = 0.0;
  std::size_t row = 0, column = 0;
};

void add(const Laid& laid, double limit_ratio, std::size_t row, std::size_t column, Found& found) {
  found.depths.push_back(laid.depth_m);
  if (limit_ratio > 0.0 && laid.ratio > limit_ratio) ++found.over;
  found.max_ratio = std::max(found.max_ratio, laid.ratio);
  if (laid.depth_m <= found.max_depth_m) return;
  found.max_depth_m = laid.depth_m;
  found.row = row;
  found.column = column;
}

std::optional<double> measured(const MapCell& cell) {
  return cell.kind == CellKind::measured ? std::optional(static_cast<double>(cell.deviation_m)) : std::nullopt;
}

UndulationDirection direction_of(Found found, const DeviationMap& map, const DesignTunnel& design) {
  UndulationDirection result;
  result.places = found.depths.size();
  if (found.depths.empty()) return result;
  result.max_depth_m = found.max_depth_m;
  result.chainage_m = map.row_chainage(found.row);
  const ProfileStretch stretch(design.profile_at(result.chainage_m));
  result.p_m = stretch.at(std::min((static_cast<double>(found.column) + 0.5) * map.step_q_m, stretch.length_m())).p_m;
  const auto at = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(found.depths.size() - 1));
  std::nth_element(found.depths.begin(), found.depths.begin() + at, found.depths.end());
  result.depth_95_m = found.depths[static_cast<std::size_t>(at)];
  result.over_limit = static_cast<double>(found.over) / static_cast<double>(result.places);
  result.max_ratio = found.max_ratio;
  return result;
}

}  // namespace

UndulationResult undulation(const DeviationMap& map, const DesignTunnel& design, double straightedge_m,
                            double limit_ratio) {
  UndulationResult result;
  result.straightedge_m = straightedge_m;
  result.limit_ratio = limit_ratio;
  const auto cells_of = [&](double step_m) {
    return static_cast<std::size_t>(std::max(2.0, std::round(straightedge_m / step_m)));
  };
  const std::size_t along = cells_of(map.step_s_m), around = cells_of(map.step_q_m);
  Found found_along, found_around;
  for (std::size_t c = 0; c < map.columns; ++c) {
    Line line{{}, map.step_s_m};
    for (std::size_t r = 0; r < map.rows; ++r) line.deviations.push_back(measured(map.cell(r, c)));
    for (std::size_t r = 0; r + along < map.rows; ++r)
      if (const auto laid = laid_edge(line, r, r + along)) add(*laid, limit_ratio, laid->deepest, c, found_along);
  }
  for (std::size_t r = 0; r < map.rows; ++r) {
    const std::size_t n = ProfileStretch(design.profile_at(map.row_chainage(r))).columns(map.step_q_m);
    if (n <= around) continue;
    Line line{{}, map.step_q_m};
    for (std::size_t c = 0; c < n + around; ++c) line.deviations.push_back(measured(map.cell(r, c % n)));
    for (std::size_t c = 0; c < n; ++c)
      if (const auto laid = laid_edge(line, c, c + around)) add(*laid, limit_ratio, r, laid->deepest % n, found_around);
  }
  result.along = direction_of(std::move(found_along), map, design);
  result.around = direction_of(std::move(found_around), map, design);
  return result;
}

}  // namespace adit
