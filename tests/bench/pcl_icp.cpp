#include <pcl/point_types.h>
#include <pcl/registration/icp.h>

#include "tests/bench/pcl_icp.h"

namespace adit::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

constexpr double reach_m = 1.0;  // the transform before has come closer than this

/// Points that lie on a surface, with their normals; `wanted` chooses among them.
template <typename Wanted>
Cloud::Ptr surface_points(const PreparedScan& scan, const Wanted& wanted) {
  auto cloud = std::make_shared<Cloud>();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!scan.normals[i].planar || !wanted(scan.points[i])) continue;
    pcl::PointNormal p;
    p.getVector3fMap() = scan.points[i];
    p.getNormalVector3fMap() = scan.normals[i].direction;
    cloud->push_back(p);
  }
  return cloud;
}

}  // namespace

Pose pcl_icp_align(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                   const PclIcpOptions& options, Progress& progress) {
  constexpr int iterations_a_turn = 4;  // a cancel is heard between turns
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  // PCL looks for the nearest point however far it is, which takes minutes for points beyond the target.
  const auto near_target = [&](const Eigen::Vector3f& p) {
    const Eigen::Vector3d q = guess * p.cast<double>();
    return target.tree->nearest_within(q.cast<float>(), reach_m + options.match_distance_m).has_value();
  };
  const Cloud::Ptr from = surface_points(source, near_target);
  const Cloud::Ptr onto = surface_points(target, [](const Eigen::Vector3f&) { return true; });
  if (from->size() < 100 || onto->size() < 100) return guess;
  icp.setInputSource(from);
  icp.setInputTarget(onto);
  icp.setMaxCorrespondenceDistance(options.match_distance_m);
  icp.setMaximumIterations(iterations_a_turn);
  icp.setTransformationEpsilon(1e-10);

  Pose pose = guess;
  Cloud moved;
  for (int done = 0; done < options.most_iterations; done += iterations_a_turn) {
    progress.step(static_cast<std::size_t>(done), static_cast<std::size_t>(options.most_iterations));
    icp.align(moved, pose.matrix().cast<float>());
    const Eigen::Matrix4d matrix = icp.getFinalTransformation().cast<double>();
    if (!matrix.allFinite()) return pose;
    Pose next = Pose::Identity();
    next.linear() = Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
    next.translation() = matrix.topRightCorner<3, 1>();
    const bool still = distance_between_m(pose, next) < 2e-4 && rotation_between_rad(pose, next) < 2e-5;
    pose = next;
    if (still) break;
  }
  return pose;
}

}  // namespace adit::bench
