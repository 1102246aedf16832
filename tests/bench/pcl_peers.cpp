#include "tests/bench/pcl_peers.h"

#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

namespace adit::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;

constexpr float voxel_m = 0.2F;
constexpr double reach_m = 1.5;  // farther points are no match; starts are about a metre off

Cloud::Ptr thinned(const Points& points) {
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(points.size());
  for (const auto& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(voxel_m, voxel_m, voxel_m);
  grid.setInputCloud(cloud);
  auto thin = std::make_shared<Cloud>();
  grid.filter(*thin);
  return thin;
}

NormalCloud::Ptr with_normals(const Cloud::Ptr& points) {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::PointNormal> estimation;
  estimation.setInputCloud(points);
  estimation.setKSearch(12);
  auto cloud = std::make_shared<NormalCloud>();
  estimation.compute(*cloud);
  for (std::size_t i = 0; i < points->size(); ++i) (*cloud)[i].getVector3fMap() = (*points)[i].getVector3fMap();
  return cloud;
}

/// PCL works with float matrices; make the result exactly rigid again.
Pose rigid(const Eigen::Matrix4f& matrix) {
  Pose pose = Pose::Identity();
  pose.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>().cast<double>())).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>().cast<double>();
  return pose;
}

template <typename Registration, typename Pointer>
Pose aligned(Registration& registration, const Pointer& target, const Pointer& source, const Pose& guess) {
  registration.setInputTarget(target);
  registration.setInputSource(source);
  typename Pointer::element_type moved;
  registration.align(moved, guess.matrix().cast<float>());
  return rigid(registration.getFinalTransformation());
}

template <typename Icp, typename Pointer>
Pose icp_aligned(const Pointer& target, const Pointer& source, const Pose& guess) {
  Icp icp;
  icp.setMaxCorrespondenceDistance(reach_m);
  icp.setMaximumIterations(100);
  icp.setTransformationEpsilon(1e-10);
  return aligned(icp, target, source, guess);
}

}  // namespace

Pose pcl_gicp(const Points& target, const Points& source, const Pose& guess) {
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
  gicp.setMaxCorrespondenceDistance(reach_m);
  gicp.setMaximumIterations(64);
  return aligned(gicp, thinned(target), thinned(source), guess);
}

Pose pcl_ndt(const Points& target, const Points& source, const Pose& guess) {
  pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
  ndt.setResolution(1.0F);
  ndt.setStepSize(0.3);
  ndt.setTransformationEpsilon(1e-6);  // PCL compares it with the squared step; its default stops after one step
  ndt.setMaximumIterations(64);
  return aligned(ndt, thinned(target), thinned(source), guess);
}

Pose pcl_icp(const Points& target, const Points& source, const Pose& guess) {
  using Icp = pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;
  return icp_aligned<Icp>(thinned(target), thinned(source), guess);
}

Pose pcl_icp_to_plane(const Points& target, const Points& source, const Pose& guess) {
  using Icp = pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal>;
  return icp_aligned<Icp>(with_normals(thinned(target)), with_normals(thinned(source)), guess);
}

}  // namespace adit::bench
