#pragma once
// The deviation of the rock from the design line on a grid over (s, q).
//
// q is the arc length p along the design line, stretched at convex corners: outside a convex corner lies a wedge whose
// nearest point is the corner itself, and the wedge gets an own stretch of q so that what is measured there is kept.

#include <cstdint>
#include <limits>
#include <vector>

#include "core/design/profile.h"

namespace adit {

/// The stretched arc length of one profile.
class ProfileStretch {
 public:
  ProfileStretch() = default;
  /// wedge_m: stretch given to each radian of a convex corner.
  explicit ProfileStretch(const Profile& profile, double wedge_m = 0.15);

  double length_m() const { return length_m_; }
  /// q in [0, length): 0 is the left end of the line (p = -length/2), the crown lies in the middle.
  double q_of(const ProfileFoot& foot) const;
  /// The ray at q: foot on the line, outward direction, and p.
  ProfilePoint at(double q_m) const;
  /// Length of the line itself (wedges not counted) between two q, first <= last.
  double line_length_m(double first_q_m, double last_q_m) const;
  /// Columns of the given width that cover the line.
  std::size_t columns(double step_q_m) const;

 private:
  struct Wedge {
    double q_begin_m;
    double q_end_m;
    ProfileCorner corner;
  };
  Profile profile_;
  std::vector<Wedge> wedges_;         ///< in order of q
  std::vector<int> wedge_of_corner_;  ///< index into wedges_ or -1
  double length_m_ = 0.0;
};

/// How a cell came to its value.
enum class CellKind : std::uint8_t {
  unseen = 0,  ///< nobody looked here; carries no value
  measured = 1,
  interpolated = 2,  ///< between measured cells closer than the gap limit; counted apart
  opening = 3,       ///< no rock within reach, but points beyond it: a cross-cut or a deep niche; carries no value
};

/// True where a cell carries a deviation.
inline bool has_rock(CellKind kind) {
  return kind == CellKind::measured || kind == CellKind::interpolated;
}

struct MapCell {
  float deviation_m = std::numeric_limits<float>::quiet_NaN();  ///< from the profile itself (offset 0)
  float spread_m = 0.0F;                                        ///< robust sigma of the points about it
  std::uint32_t count = 0;                                      ///< points of the rock surface
  float incidence = 1.0F;  ///< mean cosine between their rays and the line's normal: 1 square, 0 grazing
  CellKind kind = CellKind::unseen;
};

/// Rows along the chainage, columns along q. Row r holds the slice of thickness step_s_m centred on row_chainage(r).
struct DeviationMap {
  double from_m = 0.0;
  double to_m = 0.0;
  double step_s_m = 0.1;
  double step_q_m = 0.1;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<MapCell> cells;  ///< row-major

  double row_chainage(std::size_t row) const { return from_m + (static_cast<double>(row) + 0.5) * step_s_m; }
  const MapCell& cell(std::size_t row, std::size_t column) const { return cells[row * columns + column]; }
  MapCell& cell(std::size_t row, std::size_t column) { return cells[row * columns + column]; }
};

}  // namespace adit
