#include "core/geometry/normals.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

SurfaceNormal plane_normal(const std::vector<Eigen::Vector3f>& points, const std::vector<Neighbour>& neighbours) {
  SurfaceNormal normal;
  if (neighbours.size() < 5) return normal;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& n : neighbours) mean += points[n.index].cast<double>();
  const auto count = static_cast<double>(neighbours.size());
  mean /= count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& n : neighbours) {
    const Eigen::Vector3d d = points[n.index].cast<double>() - mean;
    covariance += d * d.transpose();
  }
  covariance /= count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  const Eigen::Vector3d values = eigen.eigenvalues().cwiseMax(0.0);
  normal.direction = eigen.eigenvectors().col(0).cast<float>();
  const double scatter = values[0] * count / (count - 3.0);
  normal.variance_rad2 = static_cast<float>(scatter / (count * std::max(values[1], 1e-12)));
  normal.planar = values[1] > 0.05 * values[2] && values[0] < 0.1 * values[1];
  return normal;
}

}  // namespace

std::vector<SurfaceNormal> surface_normals(const std::vector<Eigen::Vector3f>& points, const NearestNeighbours& tree,
                                           const Eigen::Vector3f& viewpoint, Progress& progress) {
  std::vector<SurfaceNormal> normals(points.size());
  parallel_blocks(points.size(), 2048, [&](std::size_t begin, std::size_t end) {
    progress.step(begin, points.size());
    for (std::size_t i = begin; i < end; ++i) {
      normals[i] = plane_normal(points, tree.k_nearest(points[i], normal_neighbours));
      if (normals[i].direction.dot(viewpoint - points[i]) < 0.0F) normals[i].direction = -normals[i].direction;
    }
  });
  return normals;
}

}  // namespace adit
