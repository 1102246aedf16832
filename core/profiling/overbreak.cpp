#include "core/profiling/overbreak.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

AreaMoment positive(AreaMoment amount) {
  if (amount.area_m2 >= 0.0) return amount;
  return {-amount.area_m2, -amount.moment_m3, -amount.moment_z_m3};
}

}  // namespace

LinePolygon line_polygon(const Profile& profile, const DesignLine& line) {
  LinePolygon result;
  result.line = line;
  result.ring = profile.flattened();
  if (line.offset_m != 0.0) {
    auto rings = offset_ring(result.ring, line.offset_m);
    if (rings.size() != 1)
      throw Error("the line \"" + line.name + "\" at an offset of " + short_number(line.offset_m) +
                      " m from the profile is not one closed line",
                  "lines", "use a smaller offset");
    result.ring = std::move(rings.front());
  }
  if (area_moment(result.ring).area_m2 < 0.0) std::reverse(result.ring.begin(), result.ring.end());
  result.design = area_moment(result.ring);
  return result;
}

SliceAmounts slice_amounts(const std::vector<OutlinePoint>& outline, const LinePolygon& line) {
  const Polygon as_built = polygon_of(outline, line.line.offset_m);
  SliceAmounts amounts;
  amounts.area = positive(area_moment(difference(as_built, {})));  // the union: an outline that folds counts once
  amounts.over = positive(area_moment(difference(as_built, line.ring)));
  amounts.under = positive(area_moment(difference(line.ring, as_built)));
  return amounts;
}

SectionAreas section_areas(const Outline& outline, const ProfileStretch& stretch, double step_q_m,
                           const LinePolygon& line) {
  SectionAreas areas;
  areas.line = line.line.name;
  areas.line_offset_m = line.line.offset_m;
  const SliceAmounts amounts = slice_amounts(outline.points, line);
  areas.design_area_m2 = line.design.area_m2;
  areas.area_m2 = amounts.area.area_m2;
  areas.overbreak_m2 = amounts.over.area_m2;
  areas.underbreak_m2 = amounts.under.area_m2;
  for (std::size_t c = 0; c < outline.cells.size(); ++c) {
    if (outline.cells[c].kind != CellKind::measured) continue;
    const double over = static_cast<double>(outline.cells[c].deviation_m) - line.line.offset_m;
    const double q = std::min((static_cast<double>(c) + 0.5) * step_q_m, stretch.length_m());
    if (over > areas.max_overbreak_m) {
      areas.max_overbreak_m = over;
      areas.max_overbreak_p_m = stretch.at(q).p_m;
    }
    if (-over > areas.max_underbreak_m) {
      areas.max_underbreak_m = -over;
      areas.max_underbreak_p_m = stretch.at(q).p_m;
    }
  }
  const double whole = std::max(1e-12, outline.measured_m + outline.interpolated_m + outline.unseen_m);
  areas.coverage = outline.measured_m / whole;
  areas.interpolated = outline.interpolated_m / whole;
  return areas;
}

}  // namespace adit
