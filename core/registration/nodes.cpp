#include "core/registration/nodes.h"

#include <Eigen/LU>

#include <algorithm>
#include <exception>
#include <map>
#include <set>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "core/registration/placement.h"

namespace adit {
namespace {

constexpr double least_range_m = 0.6;
constexpr double most_range_m = 45.0;

std::map<std::string, Eigen::Vector3d> control_by_id(const RegistrationContext& context) {
  std::map<std::string, Eigen::Vector3d> by_id;
  for (const auto& point : context.control) by_id[point.id] = point.position;
  return by_id;
}

/// Information about (rotation, translation) from a covariance of (position, turns).
Matrix6d information_of(const CameraSight& sight) {
  Matrix6d covariance;
  covariance << sight.covariance.bottomRightCorner<3, 3>(), sight.covariance.bottomLeftCorner<3, 3>(),
      sight.covariance.topRightCorner<3, 3>(), sight.covariance.topLeftCorner<3, 3>();
  return covariance.inverse();
}

/// The sight that knows best how the scan is turned.
const CameraSight* best_sight(const std::string& scan, const RegistrationContext& context) {
  const CameraSight* best = nullptr;
  for (const CameraSight& sight : context.pictures)
    if (sight.scan == scan && (best == nullptr || sight.covariance.trace() < best->covariance.trace())) best = &sight;
  return best;
}

/// Where a scan stands before any other is looked at: as its picture says, its guess, or the rigid fit of its targets
/// to control.
std::optional<Node> known_node(const ScanToPlace& scan, const std::vector<GraphControl>& control,
                               const RegistrationContext& context) {
  Node node;
  if (const CameraSight* sight = best_sight(scan.name, context)) {
    node.start = sight->local_from_camera * context.cameras[sight->camera].scan_from_camera.inverse();
    node.by = Node::By::control;
    return node;
  }
  if (scan.local_from_scan_guess) {
    node.start = *scan.local_from_scan_guess;
    node.by = Node::By::guess;
    return node;
  }
  std::vector<Eigen::Vector3d> seen, points;
  for (const GraphControl& one : control) {
    seen.push_back(one.in_scan);
    points.push_back(one.in_local);
  }
  const auto fit = fit_rigid(seen, points);
  if (!fit) return std::nullopt;
  node.start = *fit;
  node.by = Node::By::control;
  return node;
}

}  // namespace

void check_targets(const std::vector<ScanToPlace>& scans, const RegistrationContext& context) {
  if (scans.empty()) throw Error("there is no scan to place", "scans", "name at least one scan in the job");
  std::set<std::string> names;
  for (const auto& scan : scans) names.insert(scan.name);
  const auto by_id = control_by_id(context);
  for (const auto& target : context.targets) {
    if (names.count(target.scan) == 0)
      throw Error("target " + target.id + " belongs to scan \"" + target.scan + "\", which the job does not have",
                  "targets", "use the names of the job's scans");
  }
  for (const CameraSight& sight : context.pictures)
    if (names.count(sight.scan) == 0 || sight.camera >= context.cameras.size())
      throw Error("picture " + sight.picture + " belongs to no scan and camera of the job", "pictures",
                  "use the names of the job's scans and cameras");
  for (const auto& target : context.targets) {
    if (by_id.count(target.id) == 0)
      throw Error("target " + target.id + " of scan " + target.scan + " has no control point", "targets",
                  "add " + target.id + " to the control file or remove the target");
  }
}

std::vector<GraphControl> control_of(const std::string& scan, const RegistrationContext& context) {
  const auto by_id = control_by_id(context);
  std::vector<GraphControl> control;
  for (const auto& target : context.targets)
    if (target.scan == scan) control.push_back({0, target.id, target.position, by_id.at(target.id), target.sigma_m});
  return control;
}

std::vector<GraphSight> sights_of(const std::string& scan, const RegistrationContext& context) {
  std::vector<GraphSight> sights;
  for (const CameraSight& sight : context.pictures)
    if (sight.scan == scan) sights.push_back({0, sight.camera, sight.local_from_camera, information_of(sight)});
  return sights;
}

PreparedScans prepare_scans(const std::vector<ScanToPlace>& scans, const RegistrationOptions& options,
                            Findings& findings, Progress& progress) {
  std::vector<Progress> parts;
  for (const ScanToPlace& scan : scans)
    parts.push_back(progress.part(1.0 / static_cast<double>(scans.size()), "preparing scan " + scan.name));
  std::vector<PreparedScan> prepared(scans.size());
  std::vector<std::exception_ptr> failed(scans.size());
  const auto prepare = [&](std::size_t i) {
    const bool limited = scans[i].scanner_at_origin;
    try {
      prepared[i] = prepare_scan(scans[i].name, *scans[i].points, options.spacing_m, limited ? least_range_m : 0.0,
                                 limited ? most_range_m : 1e9, parts[i]);
    } catch (...) {
      failed[i] = std::current_exception();
    }
  };
  parallel_for_each_index(scans.size(), prepare, 1);
  for (const std::exception_ptr& error : failed)
    if (error) std::rethrow_exception(error);  // the first in the order of the job, whichever failed first
  PreparedScans usable;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (const auto& why = prepared[i].too_few_points) {
      findings.push_back({Severity::decision, why->where(), "not placed: " + why->what_is_wrong(), why->mend()});
      continue;
    }
    usable.scans.push_back(std::move(prepared[i]));
    usable.of.push_back(i);
  }
  if (usable.scans.empty()) throw *prepared.front().too_few_points;
  return usable;
}

std::vector<Node> starting_nodes(const std::vector<ScanToPlace>& scans, const PreparedScans& prepared,
                                 const RegistrationContext& context, const RegistrationOptions& options,
                                 Findings& findings, Progress& progress) {
  std::vector<std::optional<Node>> known;
  std::vector<std::optional<Pose>> poses;
  for (const std::size_t i : prepared.of) {
    known.push_back(known_node(scans[i], control_of(scans[i].name, context), context));
    poses.push_back(known.back() ? std::optional<Pose>(known.back()->start) : std::nullopt);
  }
  const std::vector<StartingPlace> places = place_scans(prepared.scans, poses, options, progress);
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < prepared.scans.size(); ++i) {
    const std::string& name = scans[prepared.of[i]].name;
    if (!places[i].local_from_scan) {
      findings.push_back({Severity::decision, "scan " + name,
                          "not placed: it has no guess, no picture and too few targets, and " + places[i].why_not,
                          "give it a pose in job.json, survey three targets, or scan from a station between"});
      continue;
    }
    Node node = known[i].value_or(Node{});
    node.scan = prepared.of[i];
    node.prepared = &prepared.scans[i];
    node.start = *places[i].local_from_scan;
    node.control = control_of(name, context);
    node.sights = sights_of(name, context);
    nodes.push_back(node);
  }
  return nodes;
}

Eigen::Vector3d axis_at(const RegistrationContext& context, const Node& node, const Pose& local_from_scan) {
  if (context.axis_direction) return context.axis_direction(local_from_scan.translation());
  return local_from_scan.linear() * node.prepared->axis;
}

}  // namespace adit
