#include "core/profiling/section.h"

#include <algorithm>
#include <cmath>

#include "core/profiling/outline.h"
#include "core/profiling/overbreak.h"
#include "core/profiling/profiling.h"
#include "core/profiling/section_circle.h"

namespace adit {
namespace {

/// Cells at a chainage: of the row it lies in, or the mean of two rows when it lies on their border.
std::vector<MapCell> cells_at(const DeviationMap& map, double chainage_m) {
  const double place = (chainage_m - map.from_m) / map.step_s_m;
  const auto last = static_cast<double>(map.rows - 1);
  const bool border = std::abs(place - std::round(place)) < 1e-6;
  const auto upper = static_cast<std::size_t>(std::clamp(border ? std::round(place) : std::floor(place), 0.0, last));
  const auto lower =
      static_cast<std::size_t>(std::clamp(border ? std::round(place) - 1.0 : std::floor(place), 0.0, last));
  std::vector<MapCell> cells(map.columns);
  for (std::size_t c = 0; c < map.columns; ++c) {
    const MapCell& a = map.cell(lower, c);
    const MapCell& b = map.cell(upper, c);
    cells[c] = a.kind == CellKind::measured ? a : b;
    if (a.kind == CellKind::measured && b.kind == CellKind::measured && lower != upper) {
      cells[c].deviation_m = 0.5F * (a.deviation_m + b.deviation_m);
      cells[c].spread_m = std::max(a.spread_m, b.spread_m);
      cells[c].count = a.count + b.count;
    }
  }
  return cells;
}

/// Runs of open points, clockwise; the outline is closed.
std::vector<LineOpening> openings_of(const std::vector<OutlinePoint>& points) {
  const std::size_t n = points.size();
  const auto open = [&](std::size_t i) { return points[i % n].kind == CellKind::opening; };
  std::vector<LineOpening> openings;
  for (std::size_t i = 0; i < n; ++i) {
    if (!open(i) || open(i + n - 1)) continue;
    std::size_t end = i;
    while (end + 1 < i + n && open(end + 1)) ++end;
    openings.push_back({points[i].p_m, points[end % n].p_m});
  }
  return openings;
}

}  // namespace

Section cut_section(const DeviationMap& map, const DesignTunnel& design, double chainage_m,
                    const ProfilingOptions& options) {
  Section section;
  section.plane = design.plane();
  section.chainage_m = chainage_m;
  section.station_m = design.alignment().stations().displayed_m(chainage_m);
  section.axis_site = design.alignment().to_site({chainage_m, 0.0, 0.0});
  const Profile& profile = design.profile_at(chainage_m);
  const ProfileStretch stretch(profile);
  Outline outline = outline_of(cells_at(map, chainage_m), stretch, map.step_q_m, options.gap_m);
  for (const DesignLine& line : design.lines())
    if (!line.clearance)
      section.lines.push_back(
          section_areas(outline, stretch, map.step_q_m, line_polygon(profile, design.line_at(line, chainage_m))));
  section.openings = openings_of(outline.points);
  if (const auto circle = circle_of(profile)) section.circle = best_circle(outline.points, *circle);
  section.outline = std::move(outline.points);
  return section;
}

std::vector<double> section_chainages(double from_m, double to_m, double interval_m) {
  std::vector<double> chainages;
  const auto count = static_cast<std::size_t>(std::floor((to_m - from_m) / interval_m + 1e-9));
  for (std::size_t i = 0; i <= count; ++i) chainages.push_back(from_m + static_cast<double>(i) * interval_m);
  if (to_m - chainages.back() > 1e-6) chainages.push_back(to_m);
  return chainages;
}

}  // namespace adit
