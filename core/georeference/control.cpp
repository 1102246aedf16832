#include "core/georeference/control.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>

#include "core/foundation/error.h"

namespace adit {
namespace {

constexpr double on_one_line_m = 0.01;

Eigen::Vector3d mean(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points) sum += p - points.front();
  return points.front() + sum / static_cast<double>(points.size());
}

/// Largest distance of a point from the line that fits the points best.
double width_m(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& centre) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - centre) * (p - centre).transpose();
  const Eigen::Vector3d line = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  double width = 0.0;
  for (const auto& p : points) width = std::max(width, (p - centre).cross(line).norm());
  return width;
}

}  // namespace

std::optional<Pose> fit_rigid(const std::vector<Eigen::Vector3d>& source, const std::vector<Eigen::Vector3d>& target) {
  if (source.size() != target.size()) throw Error("a rigid fit needs as many source points as target points");
  if (source.size() < 3) return std::nullopt;
  const Eigen::Vector3d from = mean(source);
  const Eigen::Vector3d to = mean(target);
  if (width_m(source, from) < on_one_line_m || width_m(target, to) < on_one_line_m) return std::nullopt;
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) product += (target[i] - to) * (source[i] - from).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;  // never a mirror image
  Pose target_from_source = Pose::Identity();
  target_from_source.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  target_from_source.translation() = to - target_from_source.linear() * from;
  return target_from_source;
}

}  // namespace adit
