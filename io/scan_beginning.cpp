#include "io/scan_beginning.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "io/point_density.h"

namespace adit::io {
namespace {

constexpr std::size_t wanted_points = 200'000;

struct EnoughSeen {};

/// Takes the first points of one scan, then ends the reading.
class Beginning : public ScanSink {
 public:
  explicit Beginning(std::size_t scan) : wanted_(scan) {}
  bool begin(const ScanHeader&) override { return next_++ == wanted_; }
  void take(PointBlock& block) override {
    points.insert(points.end(), block.positions.begin(), block.positions.end());
    if (points.size() >= wanted_points) throw EnoughSeen{};
  }
  void end(std::uint64_t) override { throw EnoughSeen{}; }

  std::vector<Eigen::Vector3d> points;

 private:
  std::size_t wanted_;
  std::size_t next_ = 0;
};

std::vector<Eigen::Vector3d> beginning_of(std::size_t scan, const std::filesystem::path& file, StreamScans stream,
                                          Progress& progress) {
  Beginning beginning(scan);
  try {
    stream(file, {.drop_invalid = true, .positions_only = true}, beginning, progress);
  } catch (const EnoughSeen&) {
    // the rest is not wanted
  }
  return std::move(beginning.points);
}

std::optional<PointDensity> density_from(const std::vector<Eigen::Vector3d>& points, std::uint64_t of_points,
                                         const BoundingBox& box) {
  constexpr double as_dense = 1.25;
  constexpr double twice_as_dense = 1.6;
  const std::vector<Eigen::Vector3d> half(points.begin(),
                                          points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2));
  const auto of_half = point_density(half, 1.0, box);
  const auto of_all = point_density(points, 1.0, box);
  if (!of_half || !of_all || of_half->distance_m.has_value() != of_all->distance_m.has_value()) return std::nullopt;
  const double ratio = of_all->points_per_m2 / of_half->points_per_m2;
  if (ratio > 1.0 / as_dense && ratio < as_dense) return of_all;
  if (ratio < twice_as_dense) return std::nullopt;
  return PointDensity{of_all->points_per_m2 * static_cast<double>(of_points) / static_cast<double>(points.size()),
                      of_all->distance_m};
}

}  // namespace

void complete_from_beginnings(ScanFileSummary& summary, const std::filesystem::path& file, StreamScans stream,
                              Progress& progress) {
  for (std::size_t i = 0; i < summary.scans.size(); ++i) {
    ScanSummary& scan = summary.scans[i];
    if (scan.sampled_points > 0 || scan.points < wanted_points) continue;
    const auto points = beginning_of(i, file, stream, progress);
    scan.density = density_from(points, scan.points, scan.box);
    if (scan.density) scan.sampled_points = points.size();
  }
}

}  // namespace adit::io
