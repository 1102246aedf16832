#include "core/profiling/section_circle.h"

#include <gtest/gtest.h>

#include "core/profiling/profiling.h"
#include "tests/core/sample_map.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

constexpr double radius_m = 4.0;

TEST(SectionCircle, AShiftedOvalTunnelIsFoundInEverySection) {
  const DesignTunnel design = tests::sample_design(tests::circle_profile(radius_m), 60.0);
  // A circle 3 cm wider, its centre 2 cm to the right and 1 cm down, pressed by 6 mm along the horizontal.
  const DeviationMap map = tests::map_of(design, [](double, const ProfilePoint& at) {
    const Eigen::Vector2d n = at.normal;
    return 0.03 + 0.02 * n.x() - 0.01 * n.y() + 0.003 * (n.x() * n.x() - n.y() * n.y());
  });
  const SectionCircle circle = cut_section(map, design, 23.05, {}).circle;
  ASSERT_TRUE(circle.there);
  EXPECT_NEAR(circle.deviation_m.x(), 0.02, 3e-4);
  EXPECT_NEAR(circle.deviation_m.y(), -0.01, 3e-4);
  EXPECT_NEAR(circle.radius_m, radius_m + 0.03, 3e-4);
  EXPECT_NEAR(circle.design_radius_m, radius_m, 1e-9);
  EXPECT_NEAR(circle.ovality_m, 0.012, 3e-4);
  EXPECT_NEAR(circle.major_clock_deg, 90.0, 1.0);
  EXPECT_GT(circle.covered_deg, 355.0);
  const DesignTunnel arch = tests::sample_design(tests::arch_profile());
  const DeviationMap other = tests::map_of(arch, [](double, const ProfilePoint&) { return 0.1; });
  EXPECT_FALSE(cut_section(other, arch, 23.05, {}).circle.there) << "an arch has none";
}

}  // namespace
}  // namespace adit
