#include "core/registration/prepared_scan.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "core/geometry/cell_sums.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr std::size_t enough_points = 20000;
constexpr std::size_t least_points = 500;
constexpr double coarsest_cell_m = 10.0;  // as far as options.registration.cell_m goes
constexpr double unlimited_range_m = 1e8;
constexpr std::size_t piece_sizes = 4;
constexpr double points_a_piece = 1.7;  // smaller pieces of fewer points do worse than larger ones

Eigen::Vector3d least_faced(const DistributionMap& cells) {
  Eigen::Matrix3d facing = Eigen::Matrix3d::Zero();
  for (const NormalDistribution& cell : cells.distributions())
    if (cell.flat) facing += cell.normal * cell.normal.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(facing).eigenvectors().col(0);
}

double noise_of(const DistributionMap& cells) {
  constexpr std::size_t least_pieces = 200;
  std::vector<double> thickness;
  for (const NormalDistribution& cell : cells.distributions())
    if (cell.flat) thickness.push_back(cell.thickness_m);
  return thickness.size() < least_pieces ? 0.0 : median(thickness);
}

double mean_points(const std::vector<CellSums>& sums) {
  double all = 0.0;
  for (const CellSums& cell : sums) all += cell.points;
  return all / static_cast<double>(std::max<std::size_t>(1, sums.size()));
}

/// Why too little of a scan is left.
Error why_too_few(const std::string& name, const TileSource& source, const PreparedScan& scan, double least_range_m,
                  double most_range_m) {
  const std::string where = "scan " + name;
  const std::uint64_t all = total_points(source);
  if (all < least_points)
    return Error("it has only " + std::to_string(all) + " points; " + std::to_string(least_points) + " are needed",
                 where, "name the file of a whole scan");
  std::string range;
  if (most_range_m < unlimited_range_m)
    range = " between " + short_number(least_range_m) + " and " + short_number(most_range_m) + " m from the scanner";
  return Error("of its " + std::to_string(all) + " points only " + std::to_string(scan.points.size()) +
                   " places remain" + range + ", one each " + short_number(scan.spacing_m) + " m",
               where,
               "check that its file is in metres and that its origin is the scanner, or lower registration.spacing_m");
}

}  // namespace

const SurfaceMap& PreparedScan::surface(double size_m) const {
  const auto off = [&](const SurfaceMap& map) { return std::abs(std::log2(map.cell_m() / size_m)); };
  return *std::min_element(surfaces.begin(), surfaces.end(),
                           [&](const SurfaceMap& a, const SurfaceMap& b) { return off(a) < off(b); });
}

PreparedScan prepare_scan(const std::string& name, const TileSource& source, double spacing_m, double least_range_m,
                          double most_range_m, Progress& progress) {
  const bool scanner_at_origin = most_range_m < unlimited_range_m;
  PreparedScan scan;
  scan.name = name;
  const auto summed = [&] {
    std::vector<CellSums> sums = cell_sums(source, scan.spacing_m, least_range_m, most_range_m, progress);
    scan.points.clear();
    for (const CellSums& cell : sums) scan.points.push_back(cell.mean().cast<float>());
    return sums;
  };
  scan.spacing_m = spacing_m;
  std::vector<CellSums> sums = summed();
  for (int turn = 0; turn < 2 && scan.points.size() < enough_points && scan.points.size() < total_points(source) / 3;
       ++turn) {
    scan.spacing_m *= 0.5;
    sums = summed();
  }
  if (scan.points.size() < least_points) {
    scan.too_few_points = why_too_few(name, source, scan, least_range_m, most_range_m);
    return scan;
  }
  scan.pyramid = distribution_pyramid(sums, scan.spacing_m, coarsest_cell_m, {});
  const std::span<const DistributionMap> planes(scan.pyramid.levels);
  for (std::size_t size = 0; size < piece_sizes; ++size) {
    const double cell_m = scan.spacing_m * static_cast<double>(std::size_t{1} << size);
    if (size > 0) sums = with_double_cells(std::move(sums));
    if (scan.surfaces.empty() && size + 2 < piece_sizes && mean_points(sums) < points_a_piece) continue;
    if (scan.surfaces.empty()) scan.piece_m = cell_m;
    scan.surfaces.emplace_back(sums, cell_m, planes.subspan(size, 2), scanner_at_origin);
  }
  if (scanner_at_origin) scan.ranges = RangeImage(scan.points);
  scan.noise_m = noise_of(scan.pyramid.levels[scan.pyramid.level_near(0.2)]);
  scan.axis = least_faced(scan.pyramid.levels[scan.pyramid.level_near(0.4)]);
  return scan;
}

}  // namespace adit
