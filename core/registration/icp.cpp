#include "core/registration/icp.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"
#include "core/registration/icp_selection.h"

namespace adit {
namespace {

constexpr double lever_m = 5.0;
constexpr std::size_t least_matches = 10;

double reach_in(const IcpOptions& options, int iteration) {
  if (!options.reach_falls) return options.reach_m;
  return options.reach_m * (1.0 - static_cast<double>(iteration) / options.most_iterations);
}

double weight_of(const IcpMatch& match, double range_m, double reach_m, IcpWeights weights) {
  constexpr double half_range_m = 10.0;
  switch (weights) {
    case IcpWeights::constant:
      return 1.0;
    case IcpWeights::distance:
      return std::max(0.0, 1.0 - match.distance_m() / reach_m);
    case IcpWeights::normals:
      return std::abs(match.normal.dot(match.target_normal));
    case IcpWeights::range:
      return 1.0 / (1.0 + range_m * range_m / (half_range_m * half_range_m));
  }
  return 1.0;
}

Eigen::Vector3d normal_of(const IcpCloud& cloud, std::size_t index) {
  return cloud.normals.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(cloud.normals[index].cast<double>());
}

void keep_best(std::vector<IcpMatch>& matches, double share) {
  if (share >= 1.0 || matches.empty()) return;
  std::vector<double> distances;
  for (const IcpMatch& match : matches) distances.push_back(match.distance_m());
  const auto last = static_cast<std::size_t>(share * static_cast<double>(matches.size() - 1));
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(last), distances.end());
  std::erase_if(matches, [&](const IcpMatch& match) { return match.distance_m() > distances[last]; });
}

}  // namespace

std::vector<IcpMatch> icp_matches(const IcpTarget& target, const IcpCloud& source, const Pose& pose,
                                  const IcpOptions& options, int iteration, Progress& progress) {
  const std::vector<std::size_t> selected = selected_points(source, options, iteration);
  const double reach_m = reach_in(options, iteration);
  const double least_cosine = options.most_normals_deg < 90.0 ? std::cos(rad_from_deg(options.most_normals_deg)) : -1.0;
  std::vector<IcpMatch> matches = parallel_ordered_list(selected.size(), 512, [&](std::size_t begin, std::size_t end) {
    progress.check();
    std::vector<IcpMatch> part;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d point = source.points[selected[i]].cast<double>();
      IcpMatch match;
      match.place = pose * point;
      match.normal = pose.linear() * normal_of(source, selected[i]);
      const auto found = target.match(match.place, match.normal, reach_m);
      if (!found || target.is_boundary(found->index)) continue;
      match.target = found->place;
      match.target_normal = normal_of(target.cloud(), found->index);
      if (std::abs(match.normal.dot(match.target_normal)) < least_cosine) continue;
      match.weight = weight_of(match, point.norm(), reach_m, options.weights);
      if (match.weight > 0.0) part.push_back(match);
    }
    return part;
  });
  keep_best(matches, options.best_share);
  return matches;
}

IcpResult icp_align(const IcpTarget& target, const IcpCloud& source, const Pose& start, const IcpOptions& options,
                    Progress& progress) {
  IcpResult result;
  result.target_from_source = start;
  while (result.iterations < options.most_iterations) {
    progress.step(static_cast<std::size_t>(result.iterations), static_cast<std::size_t>(options.most_iterations));
    const auto matches = icp_matches(target, source, result.target_from_source, options, result.iterations, progress);
    result.matches = matches.size();
    if (matches.size() < least_matches) break;
    const Vector6d step = icp_step(matches, result.target_from_source.translation(), options.metric);
    result.target_from_source = stepped(result.target_from_source, step);
    ++result.iterations;
    const double moved_m = step.tail<3>().norm() + lever_m * step.head<3>().norm();
    if (!options.reach_falls && moved_m < options.least_step_m) break;
  }
  return result;
}

}  // namespace adit
