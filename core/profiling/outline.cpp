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
  std::vector<char> chord;  ///< cells passed by a straight chord

  std::size_t size() const { return cells.size(); }
  double begin_q(std::size_t column) const { return static_cast<double>(column) * step_m; }
  double end_q(std::size_t column) const { return std::min(begin_q(column) + step_m, stretch.length_m()); }
  double centre_q(std::size_t column) const { return 0.5 * (begin_q(column) + end_q(column)); }
  double line_m(std::size_t column) const { return stretch.line_length_m(begin_q(column), end_q(column)); }

  /// True when a convex corner lies within the columns after `before`.
  bool has_wedge(std::size_t before, std::size_t count) const {
    for (std::size_t k = 0; k <= count + 1; ++k) {
      const std::size_t c = (before + k) % size();
      if (line_m(c) < end_q(c) - begin_q(c) - 1e-9) return true;
    }
    return false;
  }

  Eigen::Vector2d position(std::size_t column) const {
    const ProfilePoint at = stretch.at(centre_q(column));
    return at.position + static_cast<double>(cells[column].deviation_m) * at.normal;
  }
};

/// Closes a gap of `count` columns after `before` (cyclic). Along a smooth line the deviation is interpolated; across a
/// corner, where the line turns and rock or muck does not, the gap is closed by a straight chord.
void fill_gap(Row& row, std::size_t before, std::size_t count) {
  const std::size_t n = row.size();
  const std::size_t after = (before + count + 1) % n;
  const Eigen::Vector2d a = row.position(before);
  const Eigen::Vector2d b = row.position(after);
  const double d0 = static_cast<double>(row.cells[before].deviation_m);
  const double d1 = static_cast<double>(row.cells[after].deviation_m);
  const bool corner = row.has_wedge(before, count);
  for (std::size_t k = 1; k <= count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count + 1);
    MapCell& cell = row.cells[(before + k) % n];
    cell.kind = CellKind::interpolated;
    if (!corner) {
      cell.deviation_m = static_cast<float>(d0 + share * (d1 - d0));
      continue;
    }
    row.chord[(before + k) % n] = 1;
    const ProfilePoint at = row.stretch.at(row.centre_q((before + k) % n));
    const Eigen::Vector2d on_chord = a + share * (b - a);
    cell.deviation_m = static_cast<float>((on_chord - at.position).dot(at.normal));
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
    const std::size_t count = (after + n - before - 1) % n;
    if (count == 0) continue;
    double length = 0.0;
    for (std::size_t k = 1; k <= count; ++k) length += row.line_m((before + k) % n);
    if (length <= gap_m + 1e-9) fill_gap(row, before, count);
  }
}

/// Cells of a chord are not points of the outline: the chord runs straight past them.
bool inside_chord(const Row& row, std::size_t column) {
  return row.chord[column] != 0;
}

OutlinePoint outline_point(const ProfilePoint& at, double deviation_m, CellKind kind) {
  return {at.position + deviation_m * at.normal, at.p_m, deviation_m, kind, at.normal};
}

}  // namespace

Outline outline_of(const std::vector<MapCell>& cells, const ProfileStretch& stretch, double step_q_m, double gap_m) {
  Row row{
      stretch, step_q_m, {cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(stretch.columns(step_q_m))}, {}};
  row.chord.assign(row.size(), 0);
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
  }
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t next = (c + 1) % n;
    const MapCell& here = row.cells[c];
    const MapCell& there = row.cells[next];
    const bool unseen = here.kind == CellKind::unseen;
    const double d0 = unseen ? 0.0 : static_cast<double>(here.deviation_m);
    if (!inside_chord(row, c)) outline.points.push_back(outline_point(stretch.at(row.centre_q(c)), d0, here.kind));
    const bool chord = inside_chord(row, c) || inside_chord(row, next);
    const bool both_unseen = unseen && there.kind == CellKind::unseen;
    if (chord || (!both_unseen && (unseen || there.kind == CellKind::unseen))) continue;
    const double d1 = both_unseen ? 0.0 : static_cast<double>(there.deviation_m);
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
    const double shift = point.kind == CellKind::unseen ? line_offset_m : 0.0;
    polygon.push_back(point.position + shift * point.normal);
  }
  return polygon;
}

}  // namespace adit
