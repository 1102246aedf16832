#pragma once
// Cells of a deviation map that show equipment in front of the rock.

#include "core/profiling/deviation_map.h"

namespace adit {

struct ObjectCells {
  std::size_t cells = 0;
  double from_m = 0.0;
  double to_m = 0.0;
};

/// Marks measured cells unseen that lie more than 0.20 m inside the median of their surroundings (1.2 m to both sides
/// along the line, 0.5 m along the chainage): ducts, cables, parts of machines that hide the rock behind them.
ObjectCells remove_object_cells(DeviationMap& map);

}  // namespace adit
