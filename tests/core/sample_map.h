#pragma once
// A deviation map of a formula.

#include <algorithm>

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"

namespace adit::tests {

/// A measured map of chainage 20 to 28 in rows of 0.1 m: deviation(chainage, place of the line) in every cell.
template <typename Deviation>
DeviationMap map_of(const DesignTunnel& design, const Deviation& deviation) {
  DeviationMap map;
  map.from_m = 20;
  map.to_m = 28;
  map.rows = 80;
  const ProfileStretch stretch(design.profile_at(24));
  map.columns = stretch.columns(map.step_q_m);
  map.cells.resize(map.rows * map.columns);
  for (std::size_t r = 0; r < map.rows; ++r)
    for (std::size_t c = 0; c < map.columns; ++c) {
      const double q = std::min((static_cast<double>(c) + 0.5) * map.step_q_m, stretch.length_m());
      MapCell& cell = map.cell(r, c);
      cell.kind = CellKind::measured;
      cell.count = 9;
      cell.deviation_m = static_cast<float>(deviation(map.row_chainage(r), stretch.at(q)));
    }
  return map;
}

}  // namespace adit::tests
