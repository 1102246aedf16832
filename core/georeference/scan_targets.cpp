#include "core/georeference/scan_targets.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/georeference/coded_points.h"
#include "core/georeference/detect_targets.h"
#include "core/georeference/quarter_target.h"
#include "core/georeference/scan_view.h"
#include "core/georeference/sphere_target.h"
#include "core/georeference/target_plane.h"

namespace adit {
namespace {

constexpr double least_sigma_m = 0.0003;  // what the scanner's own errors leave of any centre
constexpr double most_rms_m = 0.006;      // of the points of a board from its plane

double with_least(double sigma_m) {
  return std::hypot(sigma_m, least_sigma_m);
}

void add_spheres(const ScanView& view, double radius_m, std::vector<ScanTarget>& targets, Progress& progress) {
  for (const FoundSphere& sphere : find_spheres(view, radius_m, progress))
    targets.push_back({TargetKind::sphere, 0, sphere.center, with_least(sphere.sigma_m), 2.0 * sphere.free_radius_m,
                       2.0 * sphere.free_radius_sigma_m, static_cast<int>(std::sqrt(sphere.pixels * 4.0 / pi))});
}

/// Angle between both edges on the board, 90 degrees for a right one.
double crossing_rad(const ScanView& view, const TargetPlane& plane, const FoundQuarters& quarters) {
  Eigen::Vector3d edge[2];
  const Eigen::Vector3d center = plane.met_by(view.direction(quarters.center));
  for (int k = 0; k < 2; ++k)
    edge[k] =
        (plane.met_by(view.direction(quarters.center + quarters.radius_px * quarters.edge[k])) - center).normalized();
  return std::acos(std::clamp(edge[0].dot(edge[1]), -1.0, 1.0));
}

/// How far the quarters reach on their board, the mean along both edges.
double along_edges_m(const ScanView& view, const TargetPlane& plane, const FoundQuarters& quarters) {
  double sum_m = 0.0;
  for (const Eigen::Vector2d& edge : quarters.edge)
    sum_m += (plane.met_by(view.direction(quarters.center + quarters.radius_px * edge)) -
              plane.met_by(view.direction(quarters.center - quarters.radius_px * edge)))
                 .norm();
  return 0.5 * sum_m;
}

void add_quarters(const ScanView& view, std::vector<ScanTarget>& targets, Progress& progress) {
  constexpr double least_size_m = 0.06, most_size_m = 1.0, most_askew_rad = 0.14;
  const SampleOf sample_of = [&view](int u, int v) { return view.sample(u, v); };
  for (const FoundQuarters& quarters : find_quarters(view.grey, sample_of, progress)) {
    const auto plane = target_plane(view, quarters.center, quarters.radius_px, [&](const Eigen::Vector2d& pixel) {
      return (pixel - quarters.center).norm() < quarters.radius_px;
    });
    if (!plane || plane->rms_m > most_rms_m) continue;
    const double size_m = along_edges_m(view, *plane, quarters);
    if (size_m < least_size_m || size_m > most_size_m) continue;
    if (std::abs(crossing_rad(view, *plane, quarters) - 0.5 * pi) > most_askew_rad) continue;
    const PlanePlace place = place_on_plane(view, *plane, quarters.center, quarters.covariance_px2);
    targets.push_back({TargetKind::quarters, 0, place.at, with_least(place.sigma_m), size_m, 0.0,
                       static_cast<int>(2.0 * quarters.radius_px)});
  }
}

void add_coded(const ScanView& view, const std::vector<TargetCode>& codes, std::vector<ScanTarget>& targets,
               Progress& progress) {
  constexpr double least_size_m = 0.04, most_size_m = 1.0;
  DetectOptions options;
  options.fit.focal_length_px = view.focal_px;
  options.fit.codes = codes;
  for (const DetectedTarget& found : detect_targets(view.grey, options, progress)) {
    const Eigen::Matrix2d pattern_from_pixel = found.reading.place.shape.inverse();
    const auto plane = target_plane(view, found.center, 0.5 * found.diameter_px, [&](const Eigen::Vector2d& pixel) {
      return (pattern_from_pixel * (pixel - found.center)).norm() < 1.0;
    });
    if (!plane || plane->rms_m > most_rms_m) continue;
    const std::optional<CodedOnPlane> coded = coded_on_plane(view, *plane, found);
    if (!coded || coded->diameter_m < least_size_m || coded->diameter_m > most_size_m) continue;
    targets.push_back({TargetKind::coded, found.id, coded->center, with_least(coded->sigma_m), coded->diameter_m, 0.0,
                       static_cast<int>(found.diameter_px)});
  }
}

/// Of what two views show, the one known better.
std::vector<ScanTarget> each_once(std::vector<ScanTarget> targets) {
  constexpr double same_m = 0.03;
  std::stable_sort(targets.begin(), targets.end(),
                   [](const ScanTarget& a, const ScanTarget& b) { return a.sigma_m < b.sigma_m; });
  std::vector<ScanTarget> kept;
  for (const ScanTarget& target : targets)
    if (std::none_of(kept.begin(), kept.end(), [&](const ScanTarget& other) {
          return other.kind == target.kind && (other.center - target.center).norm() < same_m;
        }))
      kept.push_back(target);
  std::stable_sort(kept.begin(), kept.end(), [](const ScanTarget& a, const ScanTarget& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.code_id != b.code_id ? a.code_id < b.code_id : a.center.norm() < b.center.norm();
  });
  return kept;
}

}  // namespace

std::vector<ScanTarget> find_scan_targets(const TileSource& scan, const ScanTargetOptions& options,
                                          Progress& progress) {
  const double focal_px = view_focal_px(scan);
  const std::vector<Eigen::Matrix3d> views = views_about();
  std::vector<ScanTarget> targets;
  for (const Eigen::Matrix3d& scan_from_view : views) {
    Progress part = progress.part(1.0 / static_cast<double>(views.size()), "");
    const ScanView view = scan_view(scan, scan_from_view, focal_px, part);
    if (options.sphere_radius_m > 0.0) add_spheres(view, options.sphere_radius_m, targets, part);
    if (options.quarters) add_quarters(view, targets, part);
    if (options.coded) add_coded(view, options.codes, targets, part);
  }
  return each_once(std::move(targets));
}

}  // namespace adit
