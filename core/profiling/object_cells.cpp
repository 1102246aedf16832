#include "core/profiling/object_cells.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr double half_width_m = 1.2;
constexpr double half_length_m = 0.5;
constexpr double stand_out_m = 0.20;

std::vector<double> surroundings(const DeviationMap& map, std::size_t row, std::size_t column) {
  const auto across = static_cast<std::ptrdiff_t>(half_width_m / map.step_q_m);
  const auto along = static_cast<std::ptrdiff_t>(half_length_m / map.step_s_m);
  const auto columns = static_cast<std::ptrdiff_t>(map.columns);
  std::vector<double> values;
  for (std::ptrdiff_t r = static_cast<std::ptrdiff_t>(row) - along; r <= static_cast<std::ptrdiff_t>(row) + along;
       ++r) {
    if (r < 0 || r >= static_cast<std::ptrdiff_t>(map.rows)) continue;
    for (std::ptrdiff_t c = static_cast<std::ptrdiff_t>(column) - across;
         c <= static_cast<std::ptrdiff_t>(column) + across; ++c) {
      const MapCell& cell =
          map.cell(static_cast<std::size_t>(r), static_cast<std::size_t>(((c % columns) + columns) % columns));
      if (cell.kind == CellKind::measured) values.push_back(static_cast<double>(cell.deviation_m));
    }
  }
  return values;
}

}  // namespace

ObjectCells remove_object_cells(DeviationMap& map) {
  // Only cells well inside the line can be objects; most of a map needs no look at its surroundings.
  std::vector<char> object(map.cells.size(), 0);
  parallel_for_each_index(
      map.rows,
      [&](std::size_t row) {
        for (std::size_t column = 0; column < map.columns; ++column) {
          const MapCell& cell = map.cell(row, column);
          if (cell.kind != CellKind::measured || static_cast<double>(cell.deviation_m) > -0.5 * stand_out_m) continue;
          const double usual = median(surroundings(map, row, column));
          object[row * map.columns + column] = static_cast<double>(cell.deviation_m) < usual - stand_out_m;
        }
      },
      4);
  ObjectCells removed;
  for (std::size_t i = 0; i < object.size(); ++i) {
    if (object[i] == 0) continue;
    const double chainage = map.row_chainage(i / map.columns);
    removed.from_m = removed.cells == 0 ? chainage : std::min(removed.from_m, chainage);
    removed.to_m = removed.cells == 0 ? chainage : std::max(removed.to_m, chainage);
    ++removed.cells;
    map.cells[i] = MapCell{};
  }
  return removed;
}

}  // namespace adit
