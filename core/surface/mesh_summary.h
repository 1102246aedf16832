#pragma once
// What a mesh is, in numbers.

#include <cstddef>
#include <limits>

namespace adit {

struct MeshSummary {
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t boundary_loops = 0;  ///< the open ends of a tunnel and every hole
  std::size_t components = 0;
  double area_m2 = 0.0;
  double mean_edge_m = 0.0;
  double longest_loop_m = 0.0;
  double holes_m = 0.0;  ///< length of all boundary loops but the two longest
  /// Mean and spread of the points' deviation from the design line; NaN when there is no design.
  double mean_deviation_m = std::numeric_limits<double>::quiet_NaN();
  double sigma_deviation_m = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace adit
