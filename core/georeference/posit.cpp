#include "core/georeference/posit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <utility>

namespace adit {
namespace {

constexpr int most_iterations = 200;
constexpr double same_depth = 1e-10;

/// The points' differences from the first one, and their pseudoinverse.
struct ObjectMatrix {
  Eigen::MatrixX3d differences;
  Eigen::Matrix3Xd inverse;
  Eigen::Vector3d normal;  ///< of the plane the points lie in best
  bool flat = false;

  ObjectMatrix(const std::vector<Eigen::Vector3d>& points, bool in_plane)
      : differences(static_cast<Eigen::Index>(points.size()) - 1, 3), flat(in_plane) {
    for (Eigen::Index i = 0; i < differences.rows(); ++i)
      differences.row(i) = (points[static_cast<std::size_t>(i) + 1] - points[0]).transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(differences, Eigen::ComputeThinU | Eigen::ComputeThinV);
    normal = svd.matrixV().col(2);
    Eigen::Vector3d over = svd.singularValues().cwiseInverse();
    if (flat) over(2) = 0.0;
    inverse = svd.matrixV() * over.asDiagonal() * svd.matrixU().transpose();
  }
};

/// A pose from scaled vectors along the camera's x and y axes, in the points' frame.
std::optional<Pose> pose_of(const Eigen::Vector3d& x_axis, const Eigen::Vector3d& y_axis, const Eigen::Vector3d& first,
                            const Eigen::Vector2d& place) {
  const double scale = std::sqrt(x_axis.norm() * y_axis.norm());
  if (!(scale > 1e-12) || !std::isfinite(scale)) return std::nullopt;
  const Eigen::Vector3d r1 = x_axis.normalized();
  const Eigen::Vector3d r3 = r1.cross(y_axis.normalized()).normalized();
  const Eigen::Vector3d r2 = r3.cross(r1);
  Pose pose = Pose::Identity();
  pose.linear() << r1.transpose(), r2.transpose(), r3.transpose();
  const double depth = 1.0 / scale;  // of the first point
  pose.translation() = Eigen::Vector3d(place.x() * depth, place.y() * depth, depth) - pose.linear() * first;
  return pose.linear().allFinite() ? std::optional(pose) : std::nullopt;
}

double rms_of(const Pose& pose, const std::vector<Eigen::Vector3d>& points,
              const std::vector<Eigen::Vector2d>& places) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d at = pose * points[i];
    if (at.z() <= 1e-9) return std::numeric_limits<double>::infinity();
    sum += (at.head<2>() / at.z() - places[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Both vectors for points in a plane: what the picture says in the plane, and along its normal what makes the axes
/// equally long and square to one another.
std::array<std::pair<Eigen::Vector3d, Eigen::Vector3d>, 2> with_normal(const Eigen::Vector3d& x0,
                                                                       const Eigen::Vector3d& y0,
                                                                       const Eigen::Vector3d& normal) {
  const std::complex<double> root =
      std::sqrt(std::complex<double>(y0.squaredNorm() - x0.squaredNorm(), -2.0 * x0.dot(y0)));
  const Eigen::Vector3d x = root.real() * normal, y = root.imag() * normal;
  return {std::pair{Eigen::Vector3d(x0 + x), Eigen::Vector3d(y0 + y)},
          std::pair{Eigen::Vector3d(x0 - x), Eigen::Vector3d(y0 - y)}};
}

/// The iteration; `branch`: which of the two poses of a plane is taken first, the better one after.
std::optional<PositPose> iterated(const ObjectMatrix& object, const std::vector<Eigen::Vector3d>& points,
                                  const std::vector<Eigen::Vector2d>& places, int branch) {
  const Eigen::Index n = object.differences.rows();
  Eigen::VectorXd depths = Eigen::VectorXd::Ones(n);  // of each point, over the first one's
  PositPose found;
  for (int i = 0; i < most_iterations; ++i) {
    Eigen::VectorXd x(n), y(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Vector2d& place = places[static_cast<std::size_t>(k) + 1];
      x(k) = depths(k) * place.x() - places[0].x();
      y(k) = depths(k) * place.y() - places[0].y();
    }
    const Eigen::Vector3d x0 = object.inverse * x, y0 = object.inverse * y;
    std::optional<Pose> pose;
    if (object.flat) {
      const auto both = with_normal(x0, y0, object.normal);
      const auto a = pose_of(both[0].first, both[0].second, points[0], places[0]);
      const auto b = pose_of(both[1].first, both[1].second, points[0], places[0]);
      const bool first = i == 0 ? branch == 0 : a && (!b || rms_of(*a, points, places) <= rms_of(*b, points, places));
      pose = first ? a : b;
    } else {
      pose = pose_of(x0, y0, points[0], places[0]);
    }
    if (!pose) return std::nullopt;
    found.camera_from_site = *pose;
    found.iterations = i + 1;
    const Eigen::VectorXd before = depths;
    const double first_depth = (*pose * points[0]).z();
    for (Eigen::Index k = 0; k < n; ++k)
      depths(k) = (*pose * points[static_cast<std::size_t>(k) + 1]).z() / first_depth;
    if (!depths.allFinite() || depths.minCoeff() <= 0.0) return std::nullopt;
    if ((depths - before).cwiseAbs().maxCoeff() < same_depth) break;
  }
  found.rms = rms_of(found.camera_from_site, points, places);
  return std::isfinite(found.rms) ? std::optional(found) : std::nullopt;
}

Eigen::Vector3d spreads(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point / static_cast<double>(points.size());
  Eigen::MatrixX3d centred(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    centred.row(static_cast<Eigen::Index>(i)) = (points[i] - mean).transpose();
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues();
  spread.head(values.size()) = values;
  return spread / std::sqrt(static_cast<double>(points.size()));
}

}  // namespace

double flatness(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d spread = spreads(points);
  return spread(0) > 0.0 ? spread(2) / spread(0) : 0.0;
}

std::vector<PositPose> posit(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector2d>& places) {
  constexpr std::size_t least_points = 4;
  constexpr double on_a_line = 0.01;
  std::vector<PositPose> poses;
  if (points.size() < least_points || points.size() != places.size()) return poses;
  const Eigen::Vector3d spread = spreads(points);
  if (spread(1) <= on_a_line * spread(0)) return poses;
  const ObjectMatrix object(points, spread(2) < flat_points * spread(0));
  for (int branch = 0; branch < (object.flat ? 2 : 1); ++branch)
    if (const auto found = iterated(object, points, places, branch)) poses.push_back(*found);
  std::stable_sort(poses.begin(), poses.end(), [](const PositPose& a, const PositPose& b) { return a.rms < b.rms; });
  if (poses.size() == 2 && distance_between_m(poses[0].camera_from_site, poses[1].camera_from_site) < 1e-6)
    poses.pop_back();
  return poses;
}

}  // namespace adit
