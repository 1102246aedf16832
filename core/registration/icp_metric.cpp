#include "core/registration/icp_metric.h"

#include <Eigen/Dense>

#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"

namespace adit {
namespace {

constexpr std::size_t block = 4096;

/// Weighted least squares J^T M J step = -J^T M r, summed up.
struct Equations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  Equations& operator+=(const Equations& more) {
    hessian += more.hessian;
    gradient += more.gradient;
    return *this;
  }
};

template <typename Add>
Vector6d gauss_newton(std::span<const IcpMatch> matches, const Add& add) {
  const Equations sums =
      parallel_ordered_sum(matches.size(), block, Equations{}, [&](std::size_t begin, std::size_t end) {
        Equations part;
        for (const IcpMatch& match : matches.subspan(begin, end - begin)) add(part, match);
        return part;
      });
  // Where nothing holds a direction it is left alone.
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(sums.hessian);
  const double least = 1e-9 * axes.eigenvalues()[5];
  const Vector6d inverse = axes.eigenvalues().unaryExpr([&](double x) { return x > least ? 1.0 / x : 0.0; });
  return -(axes.eigenvectors() * inverse.asDiagonal() * axes.eigenvectors().transpose() * sums.gradient);
}

Vector6d to_plane(std::span<const IcpMatch> matches, const Eigen::Vector3d& origin) {
  return gauss_newton(matches, [&](Equations& sums, const IcpMatch& match) {
    Vector6d j;
    j << (match.place - origin).cross(match.target_normal), match.target_normal;
    sums.hessian.noalias() += match.weight * j * j.transpose();
    sums.gradient += match.weight * match.target_normal.dot(match.place - match.target) * j;
  });
}

Vector6d plane_to_plane(std::span<const IcpMatch> matches, const Eigen::Vector3d& origin) {
  constexpr double thickness2 = 1e-3;  // of the flat distributions against their width (Segal et al. 2009)
  const auto flat = [&](const Eigen::Vector3d& n) {
    return Eigen::Matrix3d(Eigen::Matrix3d::Identity() - (1.0 - thickness2) * n * n.transpose());
  };
  return gauss_newton(matches, [&](Equations& sums, const IcpMatch& match) {
    const Eigen::Matrix3d weight = match.weight * (flat(match.normal) + flat(match.target_normal)).inverse();
    Eigen::Matrix<double, 3, 6> j;
    j << -cross_matrix(match.place - origin), Eigen::Matrix3d::Identity();
    sums.hessian.noalias() += j.transpose() * weight * j;
    sums.gradient += j.transpose() * (weight * (match.place - match.target));
  });
}

struct Moments {
  double weight = 0.0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
  Moments& operator+=(const Moments& more) {
    weight += more.weight;
    place += more.place;
    target += more.target;
    product += more.product;
    return *this;
  }
};

Vector6d to_points(std::span<const IcpMatch> matches, const Eigen::Vector3d& origin) {
  const Moments sums = parallel_ordered_sum(matches.size(), block, Moments{}, [&](std::size_t begin, std::size_t end) {
    Moments part;
    for (const IcpMatch& match : matches.subspan(begin, end - begin)) {
      const Eigen::Vector3d from = match.place - origin;
      const Eigen::Vector3d to = match.target - origin;
      part += {match.weight, match.weight * from, match.weight * to, match.weight * to * from.transpose()};
    }
    return part;
  });
  const Eigen::Vector3d from = sums.place / sums.weight;
  const Eigen::Vector3d to = sums.target / sums.weight;
  const Eigen::Matrix3d spread = sums.product / sums.weight - to * from.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handed = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::Matrix3d turn =
      svd.matrixU() * Eigen::Vector3d(1.0, 1.0, handed).asDiagonal() * svd.matrixV().transpose();
  Vector6d step;
  step << rotation_vector(turn), to - turn * from;
  return step;
}

}  // namespace

Vector6d icp_step(std::span<const IcpMatch> matches, const Eigen::Vector3d& origin, IcpMetric metric) {
  if (metric == IcpMetric::point_to_point) return to_points(matches, origin);
  if (metric == IcpMetric::point_to_plane) return to_plane(matches, origin);
  return plane_to_plane(matches, origin);
}

}  // namespace adit
