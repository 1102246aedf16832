#include "core/registration/icp_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/parallel.h"

namespace adit {
namespace {

/// The widest angle at the middle between neighbours that follow one another around it.
double widest_gap_rad(const std::vector<Eigen::Vector3d>& arms, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  std::vector<double> angles;
  for (const Eigen::Vector3d& arm : arms) angles.push_back(std::atan2(arm.dot(v), arm.dot(u)));
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2.0 * pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest;
}

std::vector<Eigen::Vector3f> directions_of(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> directions;
  directions.reserve(points.size());
  for (const auto& p : points) directions.push_back(p.normalized());
  return directions;
}

bool needs_normals(const IcpOptions& options) {
  return options.matching == IcpMatching::normal_shooting || options.metric != IcpMetric::point_to_point ||
         options.selection == IcpSelection::normal_space || options.weights == IcpWeights::normals ||
         options.boundary_rejected || options.most_normals_deg < 90.0;
}

}  // namespace

IcpCloud icp_cloud(const SurfaceMap& surface) {
  IcpCloud cloud;
  for (const SurfacePiece& piece : surface.pieces()) {
    cloud.points.push_back(piece.place);
    cloud.normals.push_back(piece.normal);
  }
  return cloud;
}

std::vector<std::uint8_t> boundary_points(const IcpCloud& cloud, const NearestNeighbours& tree) {
  constexpr int neighbours = 17;  // the point itself is one
  constexpr double free_rad = 110.0 * pi / 180.0;
  std::vector<std::uint8_t> boundary(cloud.points.size());
  parallel_for_each_index(cloud.points.size(), [&](std::size_t i) {
    std::vector<Eigen::Vector3d> arms;
    for (const Neighbour& near : tree.k_nearest(cloud.points[i], neighbours))
      if (near.index != i) arms.emplace_back((cloud.points[near.index] - cloud.points[i]).cast<double>());
    boundary[i] = arms.empty() || widest_gap_rad(arms, cloud.normals[i].cast<double>()) > free_rad ? 1 : 0;
  });
  return boundary;
}

IcpTarget::IcpTarget(IcpCloud cloud, const IcpOptions& options)
    : cloud_(std::move(cloud)), matching_(options.matching), tree_(cloud_.points) {
  if (cloud_.normals.size() != cloud_.points.size() && needs_normals(options))
    throw Error("these stages of iterative closest point need normals", "icp",
                "use nearest points, point to point, and no rejection by normals or boundary");
  if (matching_ == IcpMatching::projection) directions_.emplace(directions_of(cloud_.points));
  if (options.boundary_rejected) boundary_ = boundary_points(cloud_, tree_);
}

std::optional<IcpTarget::Match> IcpTarget::shot_at(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) const {
  constexpr int looked_at = 8;
  constexpr double least_cosine = 0.3;
  std::optional<Match> best;
  double least = std::numeric_limits<double>::max();
  for (const Neighbour& near : tree_.k_nearest(place.cast<float>(), looked_at)) {
    const Eigen::Vector3d arm = cloud_.points[near.index].cast<double>() - place;
    const double beside = (arm - arm.dot(normal) * normal).squaredNorm();
    if (beside >= least) continue;
    const Eigen::Vector3d facing = cloud_.normals[near.index].cast<double>();
    const double cosine = facing.dot(normal);
    if (std::abs(cosine) < least_cosine) continue;
    least = beside;
    best = Match{place + facing.dot(arm) / cosine * normal, near.index};
  }
  return best;
}

std::optional<IcpTarget::Match> IcpTarget::match(const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                                                 double reach_m) const {
  std::optional<Match> found;
  if (matching_ == IcpMatching::normal_shooting) {
    found = shot_at(place, normal);
  } else if (matching_ == IcpMatching::projection) {
    constexpr double everywhere = 3.0;  // unit vectors are no farther apart
    if (const auto seen = directions_->nearest_within(place.normalized().cast<float>(), everywhere))
      found = Match{cloud_.points[seen->index].cast<double>(), seen->index};
  } else if (const auto nearest = tree_.nearest_within(place.cast<float>(), reach_m)) {
    found = Match{cloud_.points[nearest->index].cast<double>(), nearest->index};
  }
  if (found && (found->place - place).norm() > reach_m) return std::nullopt;
  return found;
}

}  // namespace adit
