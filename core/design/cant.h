#pragma once
// Cant of a track or superelevation of a road: how the cross-section turns along the axis.

#include <vector>

#include "core/design/horizontal_element.h"

namespace adit {

/// How far both edges of the base stand above the grade line. Their difference is the cant, positive where the left one
/// is higher, as in a right-hand curve. An edge that stays at zero is the pivot; half up and half down: the axis is.
struct CantStation {
  double chainage_m = 0.0;
  double left_m = 0.0;
  double right_m = 0.0;
  HorizontalKind transition = HorizontalKind::clothoid;  ///< to the next station; clothoid: linear
};

/// The cross-section at a place: turned clockwise (looking up-chainage) about a point of the axis that stands rise_m
/// above the grade line.
struct CantAt {
  double cant_m = 0.0;
  double rise_m = 0.0;
  double turn_rad = 0.0;
};

/// Empty when made without stations: no cant anywhere.
class Cant {
 public:
  Cant() = default;
  /// `base_m` is the distance between the edges (rail to rail; 1 for a slope). Throws Error, naming the station, when
  /// chainages do not advance, an edge is raised by more than half the base, the base is not positive or a number is
  /// not finite.
  Cant(std::vector<CantStation> stations, double base_m);

  bool empty() const { return stations_.empty(); }
  const std::vector<CantStation>& stations() const { return stations_; }
  double base_m() const { return base_m_; }
  /// Before the first and behind the last station: as there.
  CantAt at(double chainage_m) const;
  /// Greatest cant to either side within a stretch, sign left out.
  double strongest_m(double from_m, double to_m) const;

 private:
  std::vector<CantStation> stations_;
  double base_m_ = 1.0;
};

}  // namespace adit
