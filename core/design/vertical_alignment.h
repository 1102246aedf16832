#pragma once
// Elevation and grade along an axis: grades, parabolas and circular curves between points of vertical intersection.

#include <string>
#include <vector>

namespace adit {

enum class VerticalCurveKind { none, parabola, unsymmetrical_parabola, circle };

/// A point of vertical intersection. parabola: curve_length_m, centred on the point (LandXML ParaCurve).
/// unsymmetrical_parabola: length_in_m before the point and the rest of curve_length_m behind it, two parabolas that
/// meet at the point with one grade (UnsymParaCurve). circle: curve_length_m (horizontal) and radius_m as LandXML
/// CircCurve gives them; the radius leads, the length is a check.
struct VerticalPoint {
  double chainage_m = 0.0;
  double elevation_m = 0.0;
  VerticalCurveKind curve = VerticalCurveKind::none;
  double curve_length_m = 0.0;
  double radius_m = 0.0;
  double length_in_m = 0.0;
};

struct VerticalPosition {
  double elevation_m = 0.0;
  double grade = 0.0;  ///< rise over plan length, up-chainage positive
};

/// The grade line; empty when made without points.
class VerticalAlignment {
 public:
  VerticalAlignment() = default;
  /// Throws Error, naming the chainage, when there are fewer than two points, points do not advance, the first or last
  /// one carries a curve, curves overlap each other or the ends by more than 1 mm, or a number is not finite.
  explicit VerticalAlignment(std::vector<VerticalPoint> points);

  bool empty() const { return points_.empty(); }
  const std::vector<VerticalPoint>& points() const { return points_; }
  double from_m() const { return points_.front().chainage_m; }
  double to_m() const { return points_.back().chainage_m; }

  /// Throws Error outside [from, to] (1 mm tolerance).
  VerticalPosition at(double chainage_m) const;

  /// Lengths between tangent points: start and end chainage of the curve at point i (both the point itself for none).
  struct CurveExtent {
    double from_m;
    double to_m;
  };
  CurveExtent curve_extent(std::size_t i) const { return extents_[i]; }

  VerticalAlignment relative_to(double origin_elevation_m) const;

 private:
  struct Piece {  ///< a grade or a curve, from its start up to the start of the next piece
    double from_m;
    double elevation_m;
    double grade;
    double grade_rate_per_m;  ///< parabola
    double sine;              ///< circle: sine of the slope at the start
    double sine_rate_per_m;   ///< circle: +-1 / radius, zero for none
  };
  void lay_pieces();

  std::vector<VerticalPoint> points_;
  std::vector<CurveExtent> extents_;
  std::vector<Piece> pieces_;
};

}  // namespace adit
