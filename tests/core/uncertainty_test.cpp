#include "core/profiling/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/profiling/profiling.h"
#include "tests/core/sample_map.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

TEST(UncertaintyOfVolumes, AnUnseenFloorIsOffAsTheFloorIsNotAsTheWalls) {
  // Rock outside the line by 0.2 m on walls and roof, inside by 0.1 m on the floor, a third of which nobody saw: the
  // underbreak there is missing whole, and the overbreak is not touched.
  const DesignTunnel design = tests::sample_design(tests::arch_profile());
  const auto on_floor = [](const ProfilePoint& at) { return at.normal.y() < -0.5; };
  DeviationMap map = tests::map_of(design, [&](double, const ProfilePoint& at) { return on_floor(at) ? -0.1 : 0.2; });
  const DesignLine line{"line", 0.0};
  Progress progress;
  const Volume whole = compute_volume(map, design, line, 20.0, 28.0, 1.0, {}, {}, progress);
  const ProfileStretch stretch(design.profile_at(24.0));
  for (std::size_t r = map.rows / 3; r < 2 * map.rows / 3; ++r)
    for (std::size_t c = 0; c < map.columns; ++c)
      if (on_floor(stretch.at((static_cast<double>(c) + 0.5) * map.step_q_m)))
        map.cells[r * map.columns + c] = MapCell{};
  const Volume part = compute_volume(map, design, line, 20.0, 28.0, 1.0, {}, {}, progress);
  const double missing_m3 = whole.slices.underbreak_m3 - part.slices.underbreak_m3;
  EXPECT_NEAR(missing_m3, whole.slices.underbreak_m3 / 3.0, 0.1 * whole.slices.underbreak_m3);
  EXPECT_NEAR(part.sigma_underbreak_m3, missing_m3, 0.2 * missing_m3);
  EXPECT_LT(std::abs(whole.slices.overbreak_m3 - part.slices.overbreak_m3), 2.0 * part.sigma_overbreak_m3);
  EXPECT_LT(part.sigma_overbreak_m3, 0.05 * part.slices.overbreak_m3);
}

}  // namespace
}  // namespace adit
