#pragma once
// Options of the surface step.

namespace adit {

struct SurfaceOptions {
  double spacing_m = 0.15;      ///< even spacing of the points that become mesh points
  double longest_edge_m = 0.9;  ///< no triangle has a longer edge; wider gaps stay open
};

template <typename Visitor>
void describe(Visitor& v, SurfaceOptions& o) {
  v.number("spacing_m", o.spacing_m, "m", 0.02, 1.0, "even spacing of the points that become mesh points");
  v.number("longest_edge_m", o.longest_edge_m, "m", 0.05, 5.0, "no triangle has a longer edge; wider gaps stay open");
}

}  // namespace adit
