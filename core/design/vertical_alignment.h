#pragma once
// Elevation and grade along an axis: grades, parabolas and circular curves between points of vertical intersection.

#include <string>
#include <vector>

namespace adit {

enum class VerticalCurveKind { none, parabola, circle };

/// A point of vertical intersection. parabola: curve_length_m, centred on the point (LandXML ParaCurve). circle:
/// curve_length_m (horizontal) and radius_m as LandXML CircCurve gives them; the radius leads, the length is a check.
struct VerticalPoint {
  double chainage_m = 0.0;
  double elevation_m = 0.0;
  VerticalCurveKind curve = VerticalCurveKind::none;
  double curve_length_m = 0.0;
  double radius_m = 0.0;
};

struct VerticalPosition {
  double elevation_m = 0.0;
  double grade = 0.0;  ///< rise over plan length, up-chainage positive
};

/// The grade line. Throws Error when points do not advance or curves overlap (by more than 1 mm), naming the chainage.
class VerticalAlignment {
 public:
  VerticalAlignment() = default;
  explicit VerticalAlignment(std::vector<VerticalPoint> points);

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
  CurveExtent curve_extent(std::size_t i) const;

  VerticalAlignment relative_to(double origin_elevation_m) const;

 private:
  std::vector<VerticalPoint> points_;
  std::vector<CurveExtent> extents_;
};

}  // namespace adit
