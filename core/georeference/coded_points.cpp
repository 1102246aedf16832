#include "core/georeference/coded_points.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/georeference/target_adjustment.h"

namespace adit {
namespace {

/// Place on the plane from the centre that the picture gave [m], x and y as the pattern's, and what the point shows.
struct PointGrey {
  Eigen::Vector2d at_m;
  double grey;
};

/// The pattern's axes on the plane, at the centre that the picture gave.
struct PlaneFrame {
  Eigen::Vector3d origin, x, y;
};

PlaneFrame frame_of(const ScanView& view, const TargetPlane& plane, const TargetPlace& place) {
  PlaneFrame frame;
  frame.origin = plane.met_by(view.direction(place.center));
  const Eigen::Vector3d rim = plane.met_by(view.direction(place.pixel({1.0, 0.0})));
  frame.x = (rim - frame.origin).normalized();
  frame.y = plane.normal.cross(frame.x);
  return frame;
}

std::vector<PointGrey> points_within(const ScanView& view, const TargetPlane& plane, const PlaneFrame& frame,
                                     double radius_m, double reach_px) {
  constexpr double least_limit_m = 0.003;
  const double limit_m = std::max(least_limit_m, 4.0 * plane.rms_m);
  const auto center = view.pixel_of(frame.origin);
  if (!center) return {};
  const auto from = [&](double at) { return std::max(0, static_cast<int>(at - reach_px)); };
  const auto to = [&](double at) { return std::min(view.grey.width - 1, static_cast<int>(at + reach_px) + 1); };
  std::vector<PointGrey> points;
  for (int v = from(center->y()); v <= to(center->y()); ++v)
    for (int u = from(center->x()); u <= to(center->x()); ++u) {
      if (!view.has_point(u, v)) continue;
      const Eigen::Vector3d point = view.point(u, v);
      if (std::abs(plane.normal.dot(point - plane.middle)) > limit_m) continue;
      const Eigen::Vector3d off = plane.met_by(point) - frame.origin;  // the ray is exact, the range is not
      const Eigen::Vector2d at_m(frame.x.dot(off), frame.y.dot(off));
      if (at_m.norm() < radius_m) points.push_back({at_m, static_cast<double>(view.point_grey.at(u, v))});
    }
  return points;
}

constexpr int fitted = 8;  // centre 2 [m], turn, log radius, log blur, white, black, bleeding
using Look = Eigen::Matrix<double, fitted, 1>;
using LookMatrix = Eigen::Matrix<double, fitted, fitted>;

/// What does not change while the pattern is adjusted.
struct Pattern {
  Blackness blackness{};
  Eigen::Matrix2d shape;  ///< pixels for one outer radius: as the picture's blur is seen on the plane
};

/// What a point shows of a pattern that looks so.
double grey_at(const Pattern& pattern, const Look& look, const Eigen::Vector2d& at_m) {
  const Eigen::Vector2d off = at_m - look.head<2>();
  const double c = std::cos(look(2)), s = std::sin(look(2)), radius_m = std::exp(look(3));
  const PatternPlace place(Eigen::Vector2d(c * off.x() + s * off.y(), c * off.y() - s * off.x()) / radius_m);
  return look(5) -
         look(6) * shade_of(pattern.blackness, place, TargetBlur(std::exp(look(4)), look(7), pattern.shape)).value;
}

struct Normals {
  LookMatrix normal = LookMatrix::Zero();
  Look right = Look::Zero();
  double squares = 0.0, weights = 0.0;
};

Normals normals_of(const std::vector<PointGrey>& points, const Pattern& pattern, const Look& look) {
  constexpr double outlier_share = 0.15;  // of what black takes away
  const double limit = outlier_share * std::abs(look(6));
  Look step;
  step << 1e-5, 1e-5, 1e-4, 1e-4, 1e-3, 1.0, 1.0, 1e-3;
  Normals sums;
  for (const PointGrey& point : points) {
    const double off = point.grey - grey_at(pattern, look, point.at_m);
    Look row;
    for (int k = 0; k < fitted; ++k) {
      Look more = look, less = look;
      more(k) += step(k);
      less(k) -= step(k);
      row(k) = (grey_at(pattern, more, point.at_m) - grey_at(pattern, less, point.at_m)) / (2.0 * step(k));
    }
    const double weight = std::abs(off) <= limit ? 1.0 : limit / std::abs(off);
    sums.normal += weight * row * row.transpose();
    sums.right += weight * off * row;
    sums.squares += weight * off * off;
    sums.weights += weight;
  }
  return sums;
}

struct AdjustedLook {
  Look look;
  Eigen::Matrix2d center_covariance_m2;
};

/// Nothing where it moves or grows by more than the picture may be wrong.
std::optional<AdjustedLook> adjusted(const std::vector<PointGrey>& points, const Pattern& pattern, const Look& first) {
  constexpr int rounds = 10;
  constexpr double farthest = 0.3, farthest_log_radius = 0.2, least_blur_px = 0.2, most_blur_px = 3.0, most_bleed = 1.5;
  AdjustedLook result{first, {}};
  Look& look = result.look;
  for (int round = 0; round < rounds; ++round) {
    Normals sums = normals_of(points, pattern, look);
    sums.normal(4, 4) += 1.0;  // blur and bleeding, held loosely
    sums.normal(7, 7) += 1.0;
    sums.right(7) -= look(7);
    const Eigen::LDLT<LookMatrix> solver(sums.normal);
    const Look step = solver.solve(sums.right);
    if (!step.allFinite()) return std::nullopt;
    look += step;
    look(4) = std::clamp(look(4), std::log(least_blur_px), std::log(most_blur_px));
    look(7) = std::clamp(look(7), -most_bleed, most_bleed);
    if (look.head<2>().norm() > farthest * std::exp(first(3)) || std::abs(look(3) - first(3)) > farthest_log_radius)
      return std::nullopt;
    const double variance = sums.squares / std::max(1.0, sums.weights - fitted);
    result.center_covariance_m2 = variance * LookMatrix(solver.solve(LookMatrix::Identity())).topLeftCorner<2, 2>();
  }
  return result;
}

}  // namespace

std::optional<CodedOnPlane> coded_on_plane(const ScanView& view, const TargetPlane& plane,
                                           const DetectedTarget& found) {
  const TargetReading& reading = found.reading;
  const PlaneFrame frame = frame_of(view, plane, reading.place);
  const double radius_m = (plane.met_by(view.direction(reading.place.pixel({1.0, 0.0}))) - frame.origin).norm();
  const std::vector<PointGrey> points =
      points_within(view, plane, frame, whole_radius * radius_m, whole_radius * found.diameter_px);
  if (points.size() < 5 * fitted) return std::nullopt;
  Pattern pattern{{}, reading.place.shape};
  for (int k = 0; k < coded_pattern::segments; ++k)
    pattern.blackness[static_cast<std::size_t>(k)] = is_black(reading.code, k) ? 1.0 : 0.0;
  const auto [least, most] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.grey < b.grey; });
  Look first;
  first << 0.0, 0.0, 0.0, std::log(radius_m), std::log(usual_blur_px), most->grey, most->grey - least->grey, 0.0;
  const std::optional<AdjustedLook> fit = adjusted(points, pattern, first);
  if (!fit) return std::nullopt;
  Eigen::Matrix<double, 3, 2> axes;
  axes << frame.x, frame.y;
  CodedOnPlane coded;
  coded.center = frame.origin + axes * fit->look.head<2>();
  const Eigen::Vector3d sight = coded.center.normalized();
  const double along_m = plane.sigma_along_m(sight);
  const Eigen::Matrix3d covariance =
      axes * fit->center_covariance_m2 * axes.transpose() + along_m * along_m * sight * sight.transpose();
  coded.sigma_m = std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(2)));
  coded.diameter_m = 2.0 * std::exp(fit->look(3));
  return coded;
}

}  // namespace adit
