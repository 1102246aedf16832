#include <pcl/point_types.h>
#include <pcl/registration/ndt.h>

#include "core/geometry/voxel_grid.h"
#include "tests/bench/pcl_ndt.h"

namespace adit::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr pcl_cloud(const std::vector<Eigen::Vector3f>& points) {
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(points.size());
  for (const auto& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
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

}  // namespace

Pose pcl_ndt_align(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                   const PclNdtOptions& options, Progress& progress) {
  // A few iterations at a time, so that a cancel is heard: PCL cannot be stopped from outside.
  constexpr int iterations_a_turn = 4;
  pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
  ndt.setResolution(static_cast<float>(options.cell_m));
  ndt.setStepSize(0.3);
  ndt.setTransformationEpsilon(1e-6);  // PCL compares it with the squared step; its default stops after one step
  ndt.setMaximumIterations(iterations_a_turn);
  ndt.setInputTarget(pcl_cloud(target.points));
  PointCloud thin;
  thin.points = source.points;
  ndt.setInputSource(pcl_cloud(even_subsample(thin, options.source_spacing_m).points));

  Pose pose = guess;
  Cloud moved;
  for (int done = 0; done < options.most_iterations; done += iterations_a_turn) {
    progress.step(static_cast<std::size_t>(done), static_cast<std::size_t>(options.most_iterations));
    ndt.align(moved, pose.matrix().cast<float>());
    const Pose next = rigid(ndt.getFinalTransformation());
    const bool still = distance_between_m(pose, next) < 1e-3 && rotation_between_rad(pose, next) < 1e-4;
    pose = next;
    if (still) break;
  }
  return pose;
}

}  // namespace adit::bench
