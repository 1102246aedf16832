#include "core/profiling/ring_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"

namespace adit {
namespace {

constexpr int most_steps = 60;
constexpr double last_step_m = 1e-10;
constexpr double largest_radius_m = 1000.0;
constexpr double least_covered_deg = 210.0;  // of less, an ellipse is anything

using Flat = std::vector<Eigen::Vector2d>;

/// The ring's plane with two directions in it.
struct Plane {
  Eigen::Vector3d origin, normal, u, v;
  Eigen::Vector3d place(const Eigen::Vector2d& p) const { return origin + p.x() * u + p.y() * v; }
};

Plane plane_square_to(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d other = std::abs(normal.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d u = normal.cross(other).normalized();
  return {origin, normal, u, normal.cross(u)};
}

Plane plane_of(const std::vector<RingPlace>& places, const Eigen::Vector3d& along) {
  constexpr double flat = 0.2;  // thickness over width within the plane
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const RingPlace& place : places) middle += place.position / static_cast<double>(places.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const RingPlace& place : places) spread += (place.position - middle) * (place.position - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> own(spread);
  const Eigen::Vector3d width = own.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  constexpr double line = 1e-3;
  if (width(1) <= line * width(2)) throw Error("its points lie on one line", {}, "measure points all around the ring");
  const bool told = places.size() > 3 && width(0) < flat * width(1);
  return plane_square_to(middle, told ? Eigen::Vector3d(own.eigenvectors().col(0)) : along.normalized());
}

/// Algebraic fit (Kasa 1976): the start of the iteration.
Eigen::Vector3d first_circle(const Flat& points) {
  Eigen::MatrixXd a(points.size(), 3);
  Eigen::VectorXd b(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    a.row(row) << 2.0 * points[i].x(), 2.0 * points[i].y(), 1.0;
    b(row) = points[i].squaredNorm();
  }
  const Eigen::Vector3d x = a.colPivHouseholderQr().solve(b);
  return {x(0), x(1), std::sqrt(std::max(0.0, x(2) + x.head<2>().squaredNorm()))};
}

/// Centre and radius; fills in residuals and the sigmas of both.
Eigen::Vector2d fit_circle(const Flat& points, const std::vector<double>& offsets_m, RingFit& fit) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::Vector3d circle = first_circle(points);
  Eigen::MatrixXd jacobian(n, 3);
  Eigen::VectorXd residual(n);
  const auto linearise = [&] {
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Vector2d out = points[k] - circle.head<2>();
      const double distance = std::max(out.norm(), 1e-9);
      residual(i) = distance + offsets_m[k] - circle(2);
      jacobian.row(i) << -out.x() / distance, -out.y() / distance, -1.0;
    }
  };
  for (int step = 0; step < most_steps; ++step) {
    linearise();
    const Eigen::Vector3d change = jacobian.colPivHouseholderQr().solve(-residual);
    circle += change;
    if (change.norm() < last_step_m) break;
  }
  linearise();
  if (!circle.allFinite() || circle(2) > largest_radius_m || circle(2) <= 0.0)
    throw Error("its points do not tell a circle", {}, "measure points all around the ring");
  fit.radius_m = circle(2);
  fit.rms_m = std::sqrt(residual.squaredNorm() / static_cast<double>(n));
  fit.residuals_m.assign(residual.data(), residual.data() + n);
  if (n > 3) {
    const double variance = residual.squaredNorm() / static_cast<double>(n - 3);
    const Eigen::Matrix3d covariance = variance * (jacobian.transpose() * jacobian).inverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> worst(covariance.topLeftCorner<2, 2>());
    fit.sigma_center_m = std::sqrt(std::max(0.0, worst.eigenvalues()(1)));
    fit.sigma_radius_m = std::sqrt(std::max(0.0, covariance(2, 2)));
  }
  return circle.head<2>();
}

/// Signed distance of a point from an ellipse about the origin with half axes a (along x) and b, outside positive: the
/// foot by bisection (Eberly, Distance from a point to an ellipse, 2013).
double distance_to_ellipse(const Eigen::Vector2d& point, double a, double b) {
  const double x = std::abs(point.x()), y = std::abs(point.y());
  if (b > a) return distance_to_ellipse({point.y(), point.x()}, b, a);
  const double inside = (x / a) * (x / a) + (y / b) * (y / b) - 1.0;
  double low = -b * b + b * y, high = -b * b + std::hypot(a * x, b * y);
  for (int n = 0; n < 100 && low < high; ++n) {
    const double t = 0.5 * (low + high);
    if (t == low || t == high) break;
    const double p = a * x / (t + a * a), q = b * y / (t + b * b);
    (p * p + q * q > 1.0 ? low : high) = t;
  }
  const double t = 0.5 * (low + high);
  const Eigen::Vector2d foot(a * a * x / (t + a * a), t + b * b > 0.0 ? b * b * y / (t + b * b) : b);
  return std::copysign((Eigen::Vector2d(x, y) - foot).norm(), inside);
}

double covered_deg(const Flat& points, const Eigen::Vector2d& center) {
  std::vector<double> angles;
  for (const Eigen::Vector2d& point : points)
    angles.push_back(deg_from_rad(std::atan2(point.y() - center.y(), point.x() - center.x())));
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 360.0 - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return 360.0 - widest;
}

struct Ellipse {
  Eigen::Vector2d center;
  double a, b, turn_rad;
};

/// From the circle and the second harmonic of its residuals; derivatives are taken numerically: five unknowns.
Ellipse fit_ellipse(const Flat& points, const std::vector<double>& offsets_m, const Eigen::Vector2d& center,
                    const RingFit& circle) {
  using Unknowns = Eigen::Matrix<double, 5, 1>;  // centre, mean half axis, half the difference times cos and sin 2 turn
  const auto n = static_cast<Eigen::Index>(points.size());
  const auto ellipse_of = [](const Unknowns& x) {
    const double half = std::hypot(x(3), x(4));
    return Ellipse{x.head<2>(), x(2) + half, x(2) - half, 0.5 * std::atan2(x(4), x(3))};
  };
  const auto residuals = [&](const Unknowns& x) {
    const Ellipse ellipse = ellipse_of(x);
    const Eigen::Rotation2Dd back(-ellipse.turn_rad);
    Eigen::VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      r(i) = distance_to_ellipse(back * (points[k] - ellipse.center), ellipse.a, ellipse.b) + offsets_m[k];
    }
    return r;
  };
  Unknowns x;
  x << center, circle.radius_m, 0.0, 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector2d out = points[k] - center;
    const double angle = std::atan2(out.y(), out.x());
    x(3) += 2.0 * circle.residuals_m[k] * std::cos(2.0 * angle) / static_cast<double>(n);
    x(4) += 2.0 * circle.residuals_m[k] * std::sin(2.0 * angle) / static_cast<double>(n);
  }
  if (std::hypot(x(3), x(4)) < 1e-7) x(3) = 1e-7;  // a circle has no direction to start from
  constexpr double nudge = 1e-6;
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd here = residuals(x);
    Eigen::MatrixXd jacobian(n, 5);
    for (int j = 0; j < 5; ++j) {
      Unknowns moved = x;
      moved(j) += nudge;
      jacobian.col(j) = (residuals(moved) - here) / nudge;
    }
    const Unknowns change = jacobian.colPivHouseholderQr().solve(-here);
    x += change;
    if (change.norm() < 1e-9) break;
  }
  return ellipse_of(x);
}

}  // namespace

RingFit fit_ring(const std::vector<RingPlace>& places, const Eigen::Vector3d& along) {
  if (places.size() < 3)
    throw Error("it has " + std::to_string(places.size()) + " points, three are needed", {}, "measure more points");
  const Plane plane = plane_of(places, along);
  Flat flat;
  std::vector<double> offsets_m;
  RingFit fit;
  for (const RingPlace& place : places) {
    const Eigen::Vector3d from = place.position - plane.origin;
    flat.emplace_back(from.dot(plane.u), from.dot(plane.v));
    offsets_m.push_back(place.target_offset_m);
    fit.out_of_plane_m += from.dot(plane.normal) * from.dot(plane.normal) / static_cast<double>(places.size());
  }
  fit.out_of_plane_m = std::sqrt(fit.out_of_plane_m);
  fit.normal = plane.normal;
  const Eigen::Vector2d center = fit_circle(flat, offsets_m, fit);
  fit.center = plane.place(center);
  fit.covered_deg = covered_deg(flat, center);
  if (places.size() < 6 || fit.covered_deg < least_covered_deg) return fit;
  const Ellipse ellipse = fit_ellipse(flat, offsets_m, center, fit);
  const double most = 0.5 * fit.radius_m;
  if (!std::isfinite(ellipse.a) || std::abs(ellipse.a - fit.radius_m) > most ||
      std::abs(ellipse.b - fit.radius_m) > most)
    return fit;  // the points do not tell an ellipse
  fit.semi_major_m = ellipse.a;
  fit.semi_minor_m = ellipse.b;
  fit.major_direction = std::cos(ellipse.turn_rad) * plane.u + std::sin(ellipse.turn_rad) * plane.v;
  fit.ovality_m = 2.0 * (ellipse.a - ellipse.b);
  return fit;
}

}  // namespace adit
