#include "core/registration/normal_equations.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"

namespace adit {
namespace {

double tukey_weight(double residual_m, double reach_m) {
  const double u = residual_m / reach_m;
  return std::abs(u) >= 1.0 ? 0.0 : (1.0 - u * u) * (1.0 - u * u);
}

void add_match(NormalEquations& sums, const Eigen::Vector3d& arm, const SurfaceNormal& normal, double residual_m,
               double weight) {
  const Eigen::Vector3d n = normal.direction.cast<double>();
  Vector6d j;
  j << arm.cross(n), n;
  sums.hessian += weight * j * j.transpose();
  sums.gradient += weight * residual_m * j;
  sums.weight += weight;
  Eigen::Matrix<double, 6, 3> b;
  b << cross_matrix(arm), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d tangential = Eigen::Matrix3d::Identity() - n * n.transpose();
  sums.noise += weight * static_cast<double>(normal.variance_rad2) * b * tangential * b.transpose();
}

}  // namespace

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  hessian += other.hessian;
  noise += other.noise;
  gradient += other.gradient;
  weight += other.weight;
  looked_at += other.looked_at;
  residuals_m.insert(residuals_m.end(), other.residuals_m.begin(), other.residuals_m.end());
  distances_m.insert(distances_m.end(), other.distances_m.begin(), other.distances_m.end());
  return *this;
}

NormalEquations point_to_plane_equations(const PreparedScan& target, const PreparedScan& source,
                                         const Pose& target_from_source, double match_distance_m, double tukey_m,
                                         Progress& progress) {
  const Eigen::Vector3d origin = target_from_source.translation();
  return parallel_ordered_sum(source.points.size(), 2048, NormalEquations{}, [&](std::size_t begin, std::size_t end) {
    progress.check();
    NormalEquations sums;
    for (std::size_t i = begin; i < end; ++i) {
      ++sums.looked_at;
      const Eigen::Vector3d q = target_from_source * source.points[i].cast<double>();
      const auto nearest = target.tree->nearest_within(q.cast<float>(), match_distance_m);
      if (!nearest) continue;
      sums.distances_m.push_back(std::sqrt(static_cast<double>(nearest->squared_distance_m2)));
      const SurfaceNormal& normal = target.normals[nearest->index];
      if (!normal.planar || !source.normals[i].planar) continue;
      const Eigen::Vector3d n = normal.direction.cast<double>();
      // Two faces of one wall, or a corner: not the same surface.
      if (n.dot(target_from_source.linear() * source.normals[i].direction.cast<double>()) < 0.7) continue;
      const double residual = n.dot(q - target.points[nearest->index].cast<double>());
      sums.residuals_m.push_back(residual);
      const double weight = tukey_weight(residual, tukey_m);
      if (weight > 0.0) add_match(sums, q - origin, normal, residual, weight);
    }
    return sums;
  });
}

}  // namespace adit
