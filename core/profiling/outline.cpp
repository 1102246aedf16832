#include "core/profiling/outline.h"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double point_spacing_m = 0.02;

struct Row {
  const ProfileStretch& stretch;
  double step_m;
  std::vector<MapCell> cells;

  std::size_t size() const { return cells.size(); }
  double begin_q(std::size_t column) const { return static_cast<double>(column) * step_m; }
  double end_q(std::size_t column) const { return std::min(begin_q(column) + step_m, stretch.length_m()); }
  double centre_q(std::size_t column) const { return 0.5 * (begin_q(column) + end_q(column)); }
  double line_m(std::size_t column) const { return stretch.line_length_m(begin_q(column), end_q(column)); }
  Eigen::Vector2d position(std::size_t column) const {
    const ProfilePoint at = stretch.at(centre_q(column));
    return at.position + static_cast<double>(cells[column].deviation_m) * at.normal;
  }
};

/// Closes a gap of `count` columns after `before` (cyclic): the deviation is interpolated along the line, around its
/// corners, too. A straight chord across a corner would invent underbreak that nobody has seen.
void fill_gap(Row& row, std::size_t before, std::size_t count) {
  const std::size_t n = row.size();
  const double d0 = static_cast<double>(row.cells[before].deviation_m);
  const double d1 = static_cast<double>(row.cells[(before + count + 1) % n].deviation_m);
  const float incidence = 0.5F * (row.cells[before].incidence + row.cells[(before + count + 1) % n].incidence);
  for (std::size_t k = 1; k <= count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count + 1);
    MapCell& cell = row.cells[(before + k) % n];
    cell.kind = CellKind::interpolated;
    cell.deviation_m = static_cast<float>(d0 + share * (d1 - d0));
    cell.incidence = incidence;
  }
}

void fill_gaps(Row& row, double gap_m) {
  const std::size_t n = row.size();
  std::vector<std::size_t> measured;
  for (std::size_t c = 0; c < n; ++c)
    if (row.cells[c].kind == CellKind::measured) measured.push_back(c);
  if (measured.size() < 3) return;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::size_t before = measured[i];
    const std::size_t after = measured[(i + 1) % measured.size()];
    const std::size_t count = (after > before ? after : after + n) - before - 1;
    if (count == 0) continue;
    double length = 0.0;
    for (std::size_t k = 1; k <= count; ++k) length += row.line_m((before + k) % n);
    std::size_t open = 0;
    for (std::size_t k = 1; k <= count; ++k) open += row.cells[(before + k) % n].kind == CellKind::opening ? 1 : 0;
    if (2 * open >= count) continue;
    // Around a corner the line has no length, and far outside it the rock has: both must be bridged.
    const double across = (row.position(after) - row.position(before)).norm() - row.step_m;
    if (std::max(length, across) <= gap_m + 1e-9) fill_gap(row, before, count);
  }
}

OutlinePoint outline_point(const ProfilePoint& at, double deviation_m, CellKind kind) {
  return {at.position + deviation_m * at.normal, at.p_m, deviation_m, kind, at.normal};
}

}  // namespace

Outline outline_of(const std::vector<MapCell>& cells, const ProfileStretch& stretch, double step_q_m, double gap_m) {
  Row row{stretch, step_q_m, {cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(stretch.columns(step_q_m))}};
  for (MapCell& cell : row.cells)
    if (cell.kind == CellKind::interpolated) cell = MapCell{};  // of an earlier filling
  fill_gaps(row, gap_m);
  Outline outline;
  const std::size_t n = row.size();
  for (std::size_t c = 0; c < n; ++c) {
    const double length = row.line_m(c);
    if (row.cells[c].kind == CellKind::measured) outline.measured_m += length;
    if (row.cells[c].kind == CellKind::interpolated) outline.interpolated_m += length;
    if (row.cells[c].kind == CellKind::unseen) outline.unseen_m += length;
    if (row.cells[c].kind == CellKind::opening) outline.opening_m += length;
  }
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t next = (c + 1) % n;
    const MapCell& here = row.cells[c];
    const MapCell& there = row.cells[next];
    const bool rock = has_rock(here.kind);
    const double d0 = rock ? static_cast<double>(here.deviation_m) : 0.0;
    outline.points.push_back(outline_point(stretch.at(row.centre_q(c)), d0, here.kind));
    if (rock != has_rock(there.kind)) continue;
    const double d1 = rock ? static_cast<double>(there.deviation_m) : 0.0;
    const double span =
        next > c ? row.centre_q(next) - row.centre_q(c) : row.centre_q(next) + stretch.length_m() - row.centre_q(c);
    const auto pieces = static_cast<std::size_t>(std::ceil(span / point_spacing_m));
    for (std::size_t k = 1; k < pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      const double q = std::fmod(row.centre_q(c) + share * span, stretch.length_m());
      outline.points.push_back(
          outline_point(stretch.at(q), d0 + share * (d1 - d0), share < 0.5 ? here.kind : there.kind));
    }
  }
  outline.cells = std::move(row.cells);
  return outline;
}

Polygon polygon_of(const std::vector<OutlinePoint>& points, double line_offset_m) {
  Polygon polygon;
  polygon.reserve(points.size());
  for (const OutlinePoint& point : points) {
    const double shift = has_rock(point.kind) ? 0.0 : line_offset_m;
    polygon.push_back(point.position + shift * point.normal);
  }
  return polygon;
}

}  // namespace adit
