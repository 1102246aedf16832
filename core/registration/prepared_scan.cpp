#include "core/registration/prepared_scan.h"

#include <utility>

#include "core/foundation/error.h"
#include "core/geometry/cell_sums.h"

namespace adit {
namespace {

constexpr std::size_t enough_points = 20000;
constexpr double coarsest_cell_m = 10.0;  // as far as options.registration.cell_m goes

}  // namespace

PreparedScan prepare_scan(const std::string& name, const TileSource& source, double spacing_m, double least_range_m,
                          double most_range_m, Progress& progress) {
  PreparedScan scan;
  scan.name = name;
  Progress thinning = progress.part(0.5, "");
  const auto summed = [&] {
    std::vector<CellSums> sums = cell_sums(source, scan.spacing_m, least_range_m, most_range_m, thinning);
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
  if (scan.points.size() < 500)
    throw Error("only " + std::to_string(scan.points.size()) + " places remain of this scan at a spacing of " +
                    std::to_string(spacing_m) + " m",
                "scan " + name, "check the units of the file (metres are needed) or lower registration.spacing_m");
  scan.pyramid = distribution_pyramid(std::move(sums), scan.spacing_m, coarsest_cell_m, {});
  scan.tree = std::make_shared<const NearestNeighbours>(scan.points);
  Progress planes = progress.part(0.5, "");
  Eigen::Vector3f inside = Eigen::Vector3f::Zero();
  if (most_range_m > 1e8)  // where the scanner stood is unknown: the middle of a tunnel's points lies inside it
    for (const auto& p : scan.points) inside += p / static_cast<float>(scan.points.size());
  scan.normals = surface_normals(scan.points, *scan.tree, inside, planes);
  return scan;
}

}  // namespace adit
