// The registered points as a triangle mesh.

#include <cmath>
#include <cstdio>

#include "app/placed_tiles.h"
#include "app/scan_places.h"
#include "app/step.h"
#include "core/foundation/error.h"
#include "core/geometry/statistics.h"
#include "core/geometry/voxel_grid.h"
#include "core/surface/reconstruct.h"
#include "io/atomic_file.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

constexpr double end_m = 1.5;     // of surface beyond the stretch
constexpr double beside_m = 3.0;  // points farther outside the design are not of this tunnel

bool wanted(const JobState& state) {
  return state.has_scans();
}

std::string depends_on(const JobState& state) {
  const ProfilingOptions& limits = state.job.options.profiling;
  std::string text = "surface 2|" + state.keys.at("register") + "|" + options_text(state.job.options.surface);
  for (const double limit : {limits.reach_in_m, limits.least_range_m, limits.most_range_m})
    text += "|" + short_number(limit);
  if (!state.has_design()) return text;
  text += state.profiles_text();
  const JobChainage stretch = state.stretch();
  return text + "|" + short_number(stretch.from_m) + "|" + short_number(stretch.to_m);
}

/// Signed distance to the design line, NaN away from the axis.
double deviation_at(const DesignTunnel& design, const Eigen::Vector3d& point) {
  const auto at = design.alignment().to_tunnel(point);
  if (!at) return std::nan("");
  const TunnelPoint place = design.in_section(*at);
  return design.profile_at(place.s_m).nearest({place.x_m, place.z_m}).deviation_m;
}

/// With a design only the stretch to be profiled becomes a surface, end_m more at both ends, so that the mesh is whole
/// within the stretch.
bool belongs(const JobState& state, const Eigen::Vector3d& point) {
  if (!state.design) return true;
  const auto at = state.design->alignment().to_tunnel(point);
  const JobChainage stretch = state.stretch();
  if (!at || at->s_m < stretch.from_m - end_m || at->s_m > stretch.to_m + end_m) return false;
  const double deviation = state.design->profile_at(at->s_m).nearest({at->x_m, at->z_m}).deviation_m;
  return deviation < beside_m && deviation > -state.job.options.profiling.reach_in_m;
}

std::vector<Eigen::Vector3d> surface_points(const JobState& state, const std::vector<PlacedTiles>& scans,
                                            Progress& progress) {
  const ProfilingOptions& limits = state.job.options.profiling;
  const double spacing = state.job.options.surface.spacing_m;
  PointCloud all;
  for (const PlacedTiles& scan : scans) {
    Progress part = progress.part(1.0 / static_cast<double>(scans.size()), "thinning " + scan.name);
    const double least = scan.scanner_at_origin ? limits.least_range_m : 0.0;
    const double most = scan.scanner_at_origin ? limits.most_range_m : 1e9;
    for (const auto& p : even_subsample(*scan.points, 0.6 * spacing, least, most, part).points) {
      const Eigen::Vector3d local = scan.local_from_scan * p.cast<double>();
      if (belongs(state, local)) all.points.push_back(local.cast<float>());
    }
  }
  std::vector<Eigen::Vector3d> points;
  for (const auto& p : even_subsample(all, spacing).points) points.push_back(p.cast<double>());
  return points;
}

[[noreturn]] void refuse_no_points(const JobState& state) {
  const JobChainage stretch = state.stretch();
  char words[160];
  std::snprintf(words, sizeof words, "no point of the scans lies near the design line between chainage %.3f and %.3f",
                stretch.from_m, stretch.to_m);
  throw Error(words + (": " + places_in_words(state)), state.file.string(),
              "check the poses of the scans, their unit, the axis and the chainage");
}

void add_deviations(JobState& state, SurfaceResult& result) {
  if (!state.design) return;
  std::vector<double> known;
  for (const auto& point : state.mesh->mesh.points) {
    const double deviation = deviation_at(*state.design, point);
    state.mesh->deviation_m.push_back(static_cast<float>(deviation));
    if (std::isfinite(deviation)) known.push_back(deviation);
  }
  if (known.empty()) return;
  double sum = 0.0;
  for (const double d : known) sum += d;
  result.mesh.mean_deviation_m = sum / static_cast<double>(known.size());
  result.mesh.sigma_deviation_m = robust_sigma(known);
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  const std::vector<PlacedTiles> scans = placed_tiles(state);
  std::vector<Eigen::Vector3d> viewpoints;
  for (const PlacedTiles& scan : scans) viewpoints.push_back(scan.local_from_scan.translation());
  Progress thinning = progress.part(0.3, "thinning");
  const auto points = surface_points(state, scans, thinning);
  if (points.empty() && state.design) refuse_no_points(state);
  Progress joining = progress.part(0.7, "joining " + std::to_string(points.size()) + " points to a surface");
  const Mesh mesh = reconstruct(points, viewpoints, state.job.options.surface, joining);
  SurfaceResult result;
  result.mesh = summarise(mesh);
  state.mesh = io::MeshFile{mesh_arrays(mesh), {}};
  // As the file gives them back, to the last bit: later steps are the same whether the mesh was made or taken up.
  const Eigen::Vector3d& origin = state.results.import.origin.position;
  for (Eigen::Vector3d& point : state.mesh->mesh.points) point = Eigen::Vector3d(point + origin) - origin;
  add_deviations(state, result);
  state.results.surface = result;
  io::write_mesh_ply(state.out / "mesh.ply", *state.mesh, state.results.import.origin.position);
  io::write_file_atomically(step_file(state, "surface"), io::step_text(result));
  return {"mesh.ply", "steps/surface.json"};
}

void take_up(JobState& state, Progress&) {
  SurfaceResult result;
  io::read_step_text(io::read_text_file(step_file(state, "surface")), result);
  state.mesh = io::read_mesh_ply(state.out / "mesh.ply", state.results.import.origin.position);
  if (!state.design) state.mesh->deviation_m.clear();
  state.results.surface = result;
}

}  // namespace

Step surface_step() {
  return {"surface", "making the surface", 0.15, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
