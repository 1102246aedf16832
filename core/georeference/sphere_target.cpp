#include "core/georeference/sphere_target.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr int least_pixels = 40;
constexpr double least_radius_px = 4.0;

/// How far a sphere stands out of the plane through its rim at a share of its radius from the middle.
constexpr double probe_share = 0.6, probe_height = 0.2;  // 1 - sqrt(1 - 0.36)

/// Pixels for a metre across at a point: more to the corners of a view than in its middle.
double pixels_per_m(const ScanView& view, const Eigen::Vector3d& point) {
  const double ahead = (view.scan_from_view.transpose() * point).z() / point.norm();
  return view.focal_px / (point.norm() * std::pow(std::max(ahead, 0.3), 1.5));
}

/// A quick look: on four lines through the pixel the middle stands nearer than both ends by a sphere's height. The mean
/// of both ends, so that it need not be hit in its very middle.
bool may_be_cap(const ScanView& view, int u, int v, double radius_m) {
  const double range_m = view.point(u, v).norm();
  const double reach_px =
      probe_share * radius_m * pixels_per_m(view, view.point(u, v)) * range_m / (range_m + radius_m);
  if (reach_px < probe_share * least_radius_px) return false;
  const double wanted = probe_height * radius_m, loose = 0.6 * wanted;
  for (int k = 0; k < 4; ++k) {
    const double angle = 0.25 * pi * k;
    const int a = static_cast<int>(std::lround(reach_px * std::cos(angle)));
    const int b = static_cast<int>(std::lround(reach_px * std::sin(angle)));
    if (u - std::abs(a) < 0 || v - std::abs(b) < 0 || u + std::abs(a) >= view.grey.width ||
        v + std::abs(b) >= view.grey.height)
      return false;
    if (!view.has_point(u + a, v + b) || !view.has_point(u - a, v - b)) return false;
    const double ends_m = 0.5 * (view.point(u + a, v + b).norm() + view.point(u - a, v - b).norm());
    if (std::abs(ends_m - range_m - wanted) > loose) return false;
  }
  return true;
}

/// Calls visit(point) for what the view shows of a ball.
template <typename Visit>
void for_each_near(const ScanView& view, const Eigen::Vector3d& center, double reach_m, const Visit& visit) {
  const auto middle = view.pixel_of(center);
  if (!middle) return;
  const double reach_px = 1.3 * reach_m * pixels_per_m(view, center);
  const auto from = [&](double at) { return std::max(0, static_cast<int>(at - reach_px)); };
  const auto to = [&](double at) { return std::min(view.grey.width - 1, static_cast<int>(at + reach_px) + 1); };
  for (int v = from(middle->y()); v <= to(middle->y()); ++v)
    for (int u = from(middle->x()); u <= to(middle->x()); ++u)
      if (view.has_point(u, v)) visit(view.point(u, v));
}

/// How far a line of sight passes beside a centre.
double beside_m(const Eigen::Vector3d& point, const Eigen::Vector3d& center) {
  return point.normalized().cross(center).norm();
}

struct SphereFit {
  Eigen::Vector3d center;
  double radius_m;
  double rms_m = 0.0;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< centre and radius
  int points = 0;
};

/// Gauss-Newton on the distances of the points that face the scanner: what grazes the rim lies between sphere and wall.
std::optional<SphereFit> adjusted_sphere(const std::vector<Eigen::Vector3d>& points, SphereFit fit, bool free_radius) {
  constexpr int rounds = 12;
  constexpr double facing = 0.45, huber_m = 0.003, held = 1e12;
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0.0, weights = 0.0;
    fit.points = 0;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d out = point - fit.center;
      const double distance = out.norm();
      if (distance <= 0.0 || -out.dot(point.normalized()) < facing * distance) continue;
      const double off = distance - fit.radius_m;
      const double weight = std::abs(off) > huber_m ? huber_m / std::abs(off) : 1.0;
      Eigen::Vector4d row;
      row << -out / distance, -1.0;
      normal += weight * row * row.transpose();
      right -= weight * off * row;
      squares += weight * off * off;
      weights += weight;
      ++fit.points;
    }
    if (fit.points < least_pixels / 2 || weights < 8.0) return std::nullopt;
    if (!free_radius) normal(3, 3) += held;
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    const Eigen::Vector4d step = solver.solve(right);
    if (!step.allFinite() || step.head<3>().norm() > fit.radius_m) return std::nullopt;
    fit.center += step.head<3>();
    fit.radius_m += step(3);
    fit.rms_m = std::sqrt(squares / std::max(1.0, weights - 4.0));
    fit.covariance = fit.rms_m * fit.rms_m * solver.solve(Eigen::Matrix4d::Identity());
  }
  return fit;
}

/// Whether the view bears a sphere out: what should lie on it does, and little beside it lies as near.
bool stands_free(const std::vector<Eigen::Vector3d>& points, const SphereFit& fit) {
  constexpr double least_on = 0.8, most_about = 0.35;  // the foot it stands on is about
  const double near_m = std::max(0.004, 4.0 * fit.rms_m);
  int inside = 0, on = 0, ring = 0, about = 0;
  for (const Eigen::Vector3d& point : points) {
    const double beside = beside_m(point, fit.center) / fit.radius_m, off = (point - fit.center).norm();
    if (beside < 0.85) {
      ++inside;
      on += std::abs(off - fit.radius_m) < near_m ? 1 : 0;
    } else if (beside > 1.1 && beside < 1.4) {
      ++ring;
      about += off < 1.7 * fit.radius_m ? 1 : 0;
    }
  }
  return inside >= least_pixels && on >= least_on * inside && about <= most_about * std::max(ring, 1);
}

std::optional<FoundSphere> sphere_at(const ScanView& view, const Eigen::Vector3d& nearest, double radius_m) {
  const Eigen::Vector3d start = nearest * (1.0 + radius_m / nearest.norm());
  std::vector<Eigen::Vector3d> near, all;
  for_each_near(view, start, 1.6 * radius_m, [&](const Eigen::Vector3d& point) {
    all.push_back(point);
    if ((point - start).norm() < 1.3 * radius_m) near.push_back(point);
  });
  if (near.size() < least_pixels) return std::nullopt;
  auto fit = adjusted_sphere(near, {start, radius_m, 0.0, {}, 0}, false);
  if (!fit || (fit->center - start).norm() > 0.5 * radius_m) return std::nullopt;
  const double most_rms_m = std::max(0.005, 0.03 * radius_m);
  if (fit->rms_m > most_rms_m || !stands_free(all, *fit)) return std::nullopt;
  const auto loose = adjusted_sphere(near, *fit, true);
  if (!loose) return std::nullopt;
  const double off_m = std::abs(loose->radius_m - radius_m), sigma_m = std::sqrt(loose->covariance(3, 3));
  if (off_m > std::max(0.05 * radius_m, 3.0 * sigma_m) || off_m > 0.2 * radius_m) return std::nullopt;
  const Eigen::Matrix3d covariance = fit->covariance.topLeftCorner<3, 3>();
  const double worst = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(2);
  return FoundSphere{fit->center, std::sqrt(std::max(0.0, worst)), fit->rms_m, loose->radius_m, sigma_m, fit->points};
}

}  // namespace

std::vector<FoundSphere> find_spheres(const ScanView& view, double radius_m, Progress& progress) {
  constexpr int stride = 2;
  struct Start {
    double range_m;
    Eigen::Vector3d point;
  };
  const auto rows = static_cast<std::size_t>((view.grey.height + stride - 1) / stride);
  const auto starts_of = [&](std::size_t begin, std::size_t end) {
    std::vector<Start> starts;
    progress.check();
    for (std::size_t row = begin; row < end; ++row)
      for (int u = 0; u < view.grey.width; u += stride) {
        const int v = static_cast<int>(row) * stride;
        if (view.has_point(u, v) && may_be_cap(view, u, v, radius_m))
          starts.push_back({view.point(u, v).norm(), view.point(u, v)});
      }
    return starts;
  };
  std::vector<Start> starts = parallel_ordered_list(rows, 16, starts_of);
  // The nearest point of a sphere looks at the scanner: its neighbours lead to the same one.
  std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.range_m < b.range_m; });
  std::vector<FoundSphere> spheres;
  std::set<std::array<int, 3>> tried;  // cells of a sixth of the radius
  for (const Start& start : starts) {
    const Eigen::Vector3i cell = (start.point * (6.0 / radius_m)).array().floor().cast<int>();
    const auto on = [&](const FoundSphere& other) { return (other.center - start.point).norm() < 1.2 * radius_m; };
    if (std::any_of(spheres.begin(), spheres.end(), on) || !tried.insert({cell.x(), cell.y(), cell.z()}).second)
      continue;
    progress.check();
    if (const auto sphere = sphere_at(view, start.point, radius_m)) spheres.push_back(*sphere);
  }
  return spheres;
}

}  // namespace adit
