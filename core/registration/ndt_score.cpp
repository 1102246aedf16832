#include "core/registration/ndt_score.h"

#include <Eigen/LU>

#include <cmath>

#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"

namespace adit {
namespace {

using Jacobian = Eigen::Matrix<double, 3, 6>;

/// Second derivatives of a . exp([phi]x) b by phi at phi = 0.
Eigen::Matrix3d rotation_curvature(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return 0.5 * (a * b.transpose() + b * a.transpose()) - a.dot(b) * Eigen::Matrix3d::Identity();
}

/// Exponent factor d2 of the Gaussian that stands for -log(c1 exp(-x^2/2) + c2): as high at 0, 1 sigma and far away.
double mixture_d2(double outlier_share) {
  const double c1 = 10.0 * (1.0 - outlier_share);
  const double c2 = outlier_share;
  const double d3 = -std::log(c2);
  const double d1 = -std::log(c1 + c2) - d3;
  return -2.0 * std::log((-std::log(c1 * std::exp(-0.5) + c2) - d3) / d1);
}

/// A source where the pose puts it.
struct MovedSource {
  Eigen::Vector3d arm;         ///< from the source's origin, target's axes
  Eigen::Vector3d place;       ///< target's frame
  Eigen::Matrix3d covariance;  ///< target's axes
};

/// The part of one source and one target distribution.
class Overlay {
 public:
  Overlay(const MovedSource& source, const NormalDistribution& target, double d2, double reach_m)
      : source_(source), q_(source.place - target.mean), d2_(d2), reach2_(reach_m * reach_m) {
    u_ = q_.squaredNorm() / reach2_;
    if (is_out_of_reach()) return;
    inverse_ = (target.covariance + source.covariance).inverse();
    v_ = inverse_ * q_;
    density_ = std::exp(-0.5 * d2_ * q_.dot(v_));
    const double left = 1.0 - u_;
    window_ = left * left * left;
  }

  bool is_out_of_reach() const { return u_ >= 1.0; }
  double score() const { return -density_ * window_; }

  void add_derivatives(RotationForm form, NdtScore& to) const {
    const bool full = form == RotationForm::full;
    Jacobian j;
    j << -cross_matrix(source_.arm), Eigen::Matrix3d::Identity();
    // The squared distance L = q^T B q with B = (C_t + C')^-1, C' = R C_s R^T and w = C' v.
    const Eigen::Vector3d w = source_.covariance * v_;
    Vector6d l = 2.0 * j.transpose() * v_;
    l.head<3>() -= 2.0 * w.cross(v_);
    Jacobian a = j;
    a.leftCols<3>() -= source_.covariance * cross_matrix(v_) - cross_matrix(w);
    const Jacobian weighted = 2.0 * inverse_ * a;
    Matrix6d ll;
    ll.noalias() = a.transpose() * weighted;
    const Eigen::Matrix3d turn = cross_matrix(v_);
    ll.topLeftCorner<3, 3>() -= 2.0 * turn.transpose() * source_.covariance * turn;
    if (full) ll.topLeftCorner<3, 3>() += 2.0 * rotation_curvature(v_, source_.arm) - 2.0 * rotation_curvature(v_, w);
    // The window of u = |q|^2 / reach^2.
    const double left = 1.0 - u_;
    const double w1 = -3.0 * left * left;
    const double w2 = 6.0 * left;
    const Vector6d u = (2.0 / reach2_) * j.transpose() * q_;
    Matrix6d uu = (2.0 / reach2_) * j.transpose() * j;
    if (full) uu.topLeftCorner<3, 3>() += (2.0 / reach2_) * rotation_curvature(q_, source_.arm);
    const Vector6d e = -0.5 * d2_ * l;  // of log density
    to.gradient -= density_ * (window_ * e + w1 * u);
    to.hessian -= density_ * (window_ * (e * e.transpose() - 0.5 * d2_ * ll) +
                              w1 * (e * u.transpose() + u * e.transpose() + uu) + w2 * u * u.transpose());
  }

 private:
  const MovedSource& source_;
  Eigen::Vector3d q_;
  double d2_;
  double reach2_;
  double u_ = 0.0;
  Eigen::Matrix3d inverse_;
  Eigen::Vector3d v_;
  double density_ = 0.0;
  double window_ = 0.0;
};

}  // namespace

NdtScore& NdtScore::operator+=(const NdtScore& other) {
  score += other.score;
  gradient += other.gradient;
  hessian += other.hessian;
  weight += other.weight;
  return *this;
}

NdtScore ndt_score(const DistributionMap& target, std::span<const NormalDistribution> source,
                   const Pose& target_from_source, const NdtScoreOptions& options, Progress& progress) {
  const Eigen::Matrix3d turn = target_from_source.linear();
  const double d2 = mixture_d2(options.outlier_share);
  return parallel_ordered_sum(source.size(), 256, NdtScore{}, [&](std::size_t begin, std::size_t end) {
    progress.check();
    NdtScore sums;
    for (std::size_t i = begin; i < end; ++i) {
      MovedSource moved;
      moved.arm = turn * source[i].mean;
      moved.place = moved.arm + target_from_source.translation();
      moved.covariance = turn * source[i].covariance * turn.transpose();
      sums.weight += 1.0;
      target.visit_near(moved.place, [&](const NormalDistribution& distribution) {
        const Overlay overlay(moved, distribution, d2, target.cell_m());
        if (overlay.is_out_of_reach()) return;
        sums.score += overlay.score();
        overlay.add_derivatives(options.rotation, sums);
      });
    }
    return sums;
  });
}

}  // namespace adit
