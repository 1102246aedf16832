#pragma once
// Is a pair laid together rightly? Asked of surfaces that nobody fitted to each other, and of free space.

#include "core/geometry/pose.h"
#include "core/registration/prepared_scan.h"

namespace adit {

/// Both scans of a pair against each other.
struct FitCheck {
  double compared = 0.0;      ///< points of either scan where the other has a surface near or has seen through
  double agreeing = 0.0;      ///< share of them on the other's surface
  double seen_through = 0.0;  ///< share of them where the other scanner saw through

  /// Most is best. Smooth walls agree in many places, but a wrong one is soon seen through: that weighs three times.
  double worth() const { return agreeing - 3.0 * seen_through; }

  /// Too little to tell, or a wrong place: right ones have 0.5 to 0.95 agreeing, wrong ones in rock 0.2 to 0.45.
  bool is_enough() const { return compared >= 400.0; }
  bool agrees() const { return agreeing >= 0.5 && seen_through <= 0.05; }
};

/// Pairs of which less agrees do not fit each other everywhere: a scanner bends walls, something moved, or the place is
/// a wrong one. Right pairs of simulated rock have 0.75 to 0.95, those of a real room 0.63, of a real corridor 0.50 to
/// 0.60.
inline constexpr double well_agreeing = 0.7;

/// Surfaces that met elsewhere do not meet where so much less agrees. Smooth walls agree everywhere alike.
inline constexpr double clearly_less_agreeing = 0.1;

/// near_m: how far a point may be off the other's surface (or three times the thickness found there); more for poses
/// that are not refined yet.
FitCheck check_fit(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                   double near_m = 0.02);

}  // namespace adit
