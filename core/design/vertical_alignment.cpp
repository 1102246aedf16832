#include "core/design/vertical_alignment.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

constexpr double tolerance_m = 1e-3;

std::string metres(double value) {
  return short_number(std::round(value * 1000.0) / 1000.0);
}

std::string point_at(const VerticalPoint& point) {
  return "the grade line's point at chainage " + metres(point.chainage_m);
}

void check(const VerticalPoint& point) {
  const bool finite = std::isfinite(point.chainage_m) && std::isfinite(point.elevation_m) &&
                      std::isfinite(point.curve_length_m) && std::isfinite(point.radius_m) &&
                      std::isfinite(point.length_in_m);
  if (!finite) throw Error("a point of the grade line holds a number that is not finite");
  constexpr double highest_m = 1e5;
  if (std::abs(point.elevation_m) > highest_m)
    throw Error(point_at(point) + " lies higher or lower than 100 km", {}, "write station and elevation in metres");
  if (point.curve == VerticalCurveKind::parabola && point.curve_length_m < 0.0) {
    throw Error(point_at(point) + " has a curve of negative length", {}, "write its length without a sign");
  }
  if (point.curve == VerticalCurveKind::unsymmetrical_parabola &&
      !(point.length_in_m > 0.0 && point.curve_length_m > point.length_in_m)) {
    throw Error(point_at(point) + " has an unsymmetrical curve without a length on one side", {},
                "write both lengths, without a sign");
  }
}

/// A curve without length or radius is no curve.
void drop_empty_curve(VerticalPoint& point) {
  const bool parabola = point.curve == VerticalCurveKind::parabola && point.curve_length_m > 0.0;
  const bool circle = point.curve == VerticalCurveKind::circle && point.radius_m != 0.0;
  const bool unsymmetrical = point.curve == VerticalCurveKind::unsymmetrical_parabola;
  if (!parabola && !circle && !unsymmetrical) point.curve = VerticalCurveKind::none;
}

double grade_between(const VerticalPoint& a, const VerticalPoint& b) {
  return (b.elevation_m - a.elevation_m) / (b.chainage_m - a.chainage_m);
}

/// Plan extent of the curve at b. A circle touches both grades at the same distance from b along each grade,
/// R tan(half the turn): in plan that is longer on the flatter side.
VerticalAlignment::CurveExtent extent(const VerticalPoint& a, const VerticalPoint& b, const VerticalPoint& c) {
  if (b.curve == VerticalCurveKind::none) return {b.chainage_m, b.chainage_m};
  if (b.curve == VerticalCurveKind::parabola) {
    return {b.chainage_m - 0.5 * b.curve_length_m, b.chainage_m + 0.5 * b.curve_length_m};
  }
  if (b.curve == VerticalCurveKind::unsymmetrical_parabola) {
    return {b.chainage_m - b.length_in_m, b.chainage_m + b.curve_length_m - b.length_in_m};
  }
  const double slope_in = std::atan(grade_between(a, b));
  const double slope_out = std::atan(grade_between(b, c));
  const double tangent = std::abs(b.radius_m) * std::tan(0.5 * std::abs(slope_out - slope_in));
  return {b.chainage_m - tangent * std::cos(slope_in), b.chainage_m + tangent * std::cos(slope_out)};
}

void check_order(const std::vector<VerticalPoint>& points) {
  if (points.size() < 2) throw Error("the grade line needs at least two points", {}, "export the whole grade line");
  for (const VerticalPoint& point : points) check(point);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].chainage_m <= points[i - 1].chainage_m) {
      throw Error(
          point_at(points[i]) + " does not advance: the one before it lies at " + metres(points[i - 1].chainage_m), {},
          "list the points in order of chainage");
    }
  }
}

void check_overlap(const std::vector<VerticalPoint>& points,
                   const std::vector<VerticalAlignment::CurveExtent>& extents) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (extents[i].to_m <= extents[i + 1].from_m + tolerance_m) continue;
    throw Error("the vertical curves at chainage " + metres(points[i].chainage_m) + " and " +
                    metres(points[i + 1].chainage_m) + " overlap by " +
                    metres(extents[i].to_m - extents[i + 1].from_m) + " m",
                {}, "shorten one of them or move the points apart");
  }
}

}  // namespace

VerticalAlignment::VerticalAlignment(std::vector<VerticalPoint> points) : points_(std::move(points)) {
  check_order(points_);
  for (VerticalPoint& point : points_) drop_empty_curve(point);
  for (const VerticalPoint* end : {&points_.front(), &points_.back()}) {
    if (end->curve != VerticalCurveKind::none) {
      throw Error(point_at(*end) + " is the first or last and cannot carry a curve", {},
                  "add a point before or behind it");
    }
  }
  extents_.push_back({points_.front().chainage_m, points_.front().chainage_m});
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    extents_.push_back(extent(points_[i - 1], points_[i], points_[i + 1]));
  }
  extents_.push_back({points_.back().chainage_m, points_.back().chainage_m});
  check_overlap(points_, extents_);
  lay_pieces();
}

void VerticalAlignment::lay_pieces() {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const VerticalPoint& point = points_[i];
    const double grade_out = grade_between(point, points_[i + 1]);
    if (point.curve != VerticalCurveKind::none) {
      const double grade_in = grade_between(points_[i - 1], point);
      const double from = extents_[i].from_m;
      Piece curve{from, point.elevation_m - grade_in * (point.chainage_m - from), grade_in, 0.0, 0.0, 0.0};
      if (point.curve == VerticalCurveKind::parabola) {
        curve.grade_rate_per_m = (grade_out - grade_in) / point.curve_length_m;
      } else if (point.curve == VerticalCurveKind::unsymmetrical_parabola) {
        const double in_m = point.length_in_m, out_m = point.curve_length_m - in_m;
        const double bend = (grade_out - grade_in) / point.curve_length_m;
        curve.grade_rate_per_m = bend * out_m / in_m;
        pieces_.push_back(curve);
        curve = {point.chainage_m,
                 point.elevation_m + 0.5 * bend * in_m * out_m,
                 grade_in + bend * out_m,
                 bend * in_m / out_m,
                 0.0,
                 0.0};
      } else {
        curve.sine = std::sin(std::atan(grade_in));
        curve.sine_rate_per_m = std::copysign(1.0 / std::abs(point.radius_m), grade_out - grade_in);
      }
      pieces_.push_back(curve);
    }
    const double from = extents_[i].to_m;
    pieces_.push_back({from, point.elevation_m + grade_out * (from - point.chainage_m), grade_out, 0.0, 0.0, 0.0});
  }
}

VerticalPosition VerticalAlignment::at(double chainage_m) const {
  if (empty()) throw Error("the axis has no grade line");
  if (!(chainage_m >= from_m() - tolerance_m && chainage_m <= to_m() + tolerance_m)) {
    throw Error("chainage " + metres(chainage_m) + " lies outside the grade line, which runs from " + metres(from_m()) +
                " to " + metres(to_m()));
  }
  const double s = std::clamp(chainage_m, from_m(), to_m());
  const auto behind = std::upper_bound(pieces_.begin() + 1, pieces_.end(), s,
                                       [](double value, const Piece& piece) { return value < piece.from_m; });
  const Piece& piece = *(behind - 1);
  const double u = s - piece.from_m;
  if (piece.sine_rate_per_m == 0.0) {
    return {piece.elevation_m + u * (piece.grade + 0.5 * piece.grade_rate_per_m * u),
            piece.grade + piece.grade_rate_per_m * u};
  }
  // On a circle the sine of the slope is linear in plan length; written so that no large radius is subtracted.
  const double sine = piece.sine + piece.sine_rate_per_m * u;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double cosine_at_start = std::sqrt(1.0 - piece.sine * piece.sine);
  return {piece.elevation_m + u * (piece.sine + sine) / (cosine_at_start + cosine), sine / cosine};
}

VerticalAlignment VerticalAlignment::relative_to(double origin_elevation_m) const {
  VerticalAlignment moved = *this;
  for (VerticalPoint& point : moved.points_) point.elevation_m -= origin_elevation_m;
  for (Piece& piece : moved.pieces_) piece.elevation_m -= origin_elevation_m;
  return moved;
}

}  // namespace adit
