#include "core/profiling/openings.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double least_area_m2 = 0.5;
constexpr float side_wall_spread_m = 0.3F;

/// One for every cell that is marked open, and for those beside it that belong to it.
std::vector<char> open_cells(const DeviationMap& map) {
  constexpr std::ptrdiff_t reach = 3, enough = 3;
  const auto rows = static_cast<std::ptrdiff_t>(map.rows), columns = static_cast<std::ptrdiff_t>(map.columns);
  std::vector<std::uint8_t> marked_beside(map.cells.size(), 0);
  const auto index = [&](std::ptrdiff_t r, std::ptrdiff_t c) {
    return static_cast<std::size_t>(r * columns + ((c % columns) + columns) % columns);
  };
  for (std::ptrdiff_t i = 0; i < rows * columns; ++i) {
    if (map.cells[static_cast<std::size_t>(i)].kind != CellKind::opening) continue;
    const std::ptrdiff_t row = i / columns, column = i % columns;
    for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(0, row - reach); r <= std::min(rows - 1, row + reach); ++r)
      for (std::ptrdiff_t c = column - reach; c <= column + reach; ++c) ++marked_beside[index(r, c)];
  }
  std::vector<char> open(map.cells.size(), 0);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const MapCell& cell = map.cells[i];
    const bool no_surface = cell.kind == CellKind::unseen || cell.spread_m > side_wall_spread_m;
    open[i] = cell.kind == CellKind::opening || (no_surface && marked_beside[i] >= enough) ? 1 : 0;
  }
  return open;
}

/// Cells that hang together with one, over the left end of the line, too. They are taken out of `open`.
std::vector<std::size_t> patch_of(std::vector<char>& open, const DeviationMap& map, std::size_t cell) {
  std::vector<std::size_t> patch{cell};
  open[cell] = 0;
  const auto add = [&](std::size_t other) {
    if (open[other] == 0) return;
    open[other] = 0;
    patch.push_back(other);
  };
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const std::size_t row = patch[i] / map.columns, column = patch[i] % map.columns;
    const std::size_t begin = row * map.columns;
    add(begin + (column + 1) % map.columns);
    add(begin + (column + map.columns - 1) % map.columns);
    if (row > 0) add(patch[i] - map.columns);
    if (row + 1 < map.rows) add(patch[i] + map.columns);
  }
  return patch;
}

}  // namespace

std::vector<Opening> find_openings(DeviationMap& map, const std::vector<ProfileStretch>& stretches,
                                   const std::vector<std::size_t>& stretch_of_row) {
  std::vector<char> open = open_cells(map);
  std::vector<Opening> openings;
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (open[first] == 0) continue;
    const std::vector<std::size_t> patch = patch_of(open, map, first);
    Opening opening;
    std::size_t last_row = 0;
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
    for (const std::size_t cell : patch) {
      const std::size_t row = cell / map.columns, column = cell % map.columns;
      const ProfileStretch& stretch = stretches[stretch_of_row[row]];
      const double q0 = static_cast<double>(column) * map.step_q_m;
      const double q1 = std::min(q0 + map.step_q_m, stretch.length_m());
      opening.area_m2 += stretch.line_length_m(q0, q1) * map.step_s_m;
      normal += stretch.at(0.5 * (q0 + q1)).normal;
      last_row = std::max(last_row, row);
    }
    if (opening.area_m2 < least_area_m2) {
      for (const std::size_t cell : patch)
        if (map.cells[cell].kind == CellKind::opening) map.cells[cell] = MapCell{};
      continue;
    }
    for (const std::size_t cell : patch) map.cells[cell] = {.kind = CellKind::opening};
    opening.from_m = map.row_chainage(first / map.columns) - 0.5 * map.step_s_m;
    opening.to_m = map.row_chainage(last_row) + 0.5 * map.step_s_m;
    opening.clock_deg = deg_from_rad(std::atan2(normal.x(), normal.y()));
    openings.push_back(opening);
  }
  return openings;
}

}  // namespace adit
