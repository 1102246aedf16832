#include "core/profiling/mesh_volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/surface/mesh.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

constexpr double radius_m = 4.2, from_m = 18.0, to_m = 42.0, step_m = 0.1;
constexpr std::uint32_t around = 240;

/// A tube of triangles about an axis, without those for which `missing(chainage, angle)` holds.
template <typename Missing>
MeshArrays tube(const DesignTunnel& design, const Missing& missing) {
  MeshArrays mesh;
  const auto rings = static_cast<std::uint32_t>(std::lround((to_m - from_m) / step_m)) + 1;
  const auto angle = [](std::uint32_t i) { return 2.0 * pi * i / around; };
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t i = 0; i < around; ++i)
      mesh.points.push_back(design.alignment().to_site(
          {from_m + step_m * r, radius_m * std::sin(angle(i)), radius_m * std::cos(angle(i))}));
  for (std::uint32_t r = 0; r + 1 < rings; ++r)
    for (std::uint32_t i = 0; i < around; ++i) {
      if (missing(from_m + step_m * r, angle(i))) continue;
      const std::uint32_t a = r * around + i, b = r * around + (i + 1) % around, c = a + around, d = b + around;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

TEST(MeshVolume, ATorusSegmentWithHolesAndJaggedEndsIsThatOfGuldin) {
  for (const double curve_m : {0.0, 30.0}) {
    const DesignTunnel design = tests::sample_design(tests::circle_profile(), curve_m);
    const MeshArrays mesh = tube(design, [](double s, double angle) {
      const bool hole = s > 25.0 && s < 26.0 && angle > 1.0 && angle < 1.2;
      const bool bite = s < 20.5 && angle > 2.0 && angle < 2.3;  // out of the end
      return hole || bite;
    });
    const MeshInTunnel held(mesh, design);
    for (const auto& [first, last] : {std::pair(20.0, 40.0), std::pair(22.33, 31.27)}) {
      const MeshVolume volume = held.between(first, last);
      const double exact = pi * radius_m * radius_m * (last - first);
      ASSERT_TRUE(volume.closed);
      EXPECT_NEAR(volume.excavated_m3, exact, 4e-4 * exact) << "curve " << curve_m;
    }
    EXPECT_NEAR(held.between(24.0, 27.0).filled_m2, 1.0 * 0.2 * radius_m, 0.15);
    EXPECT_EQ(held.between(30.0, 35.0).filled_m2, 0.0);
    EXPECT_FALSE(held.between(17.0, 40.0).closed) << "the mesh ends at 18";
  }
}

TEST(MeshVolume, PlanesSquareToASteepCurvedAxisHoldTheSameSpace) {
  // A tube about an axis that climbs 12 %: between two square planes it holds area times length in space.
  const Alignment axis("CL", HorizontalAlignment({{HorizontalKind::line, "", {0, 0}, 0.3, 60}}, 0.0),
                       VerticalAlignment({{0, 10}, {60, 10 + 0.12 * 60}}));
  const DesignTunnel design =
      DesignTunnel(axis, {{0.0, tests::circle_profile()}}, {{"excavation", 0.0}}).standing(SectionPlane::square);
  MeshArrays mesh;
  const auto rings = static_cast<std::uint32_t>(std::lround((to_m - from_m) / step_m)) + 1;
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * pi * i / around;
      mesh.points.push_back(
          design.to_site({from_m + step_m * r, radius_m * std::sin(angle), radius_m * std::cos(angle)}));
    }
  for (std::uint32_t r = 0; r + 1 < rings; ++r)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = r * around + i, b = r * around + (i + 1) % around, c = a + around, d = b + around;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  const MeshVolume volume = MeshInTunnel(mesh, design).between(20.0, 40.0);
  const double exact = pi * radius_m * radius_m * 20.0 * std::hypot(1.0, 0.12);
  ASSERT_TRUE(volume.closed);
  EXPECT_NEAR(volume.excavated_m3, exact, 4e-4 * exact);
}

TEST(MeshVolume, WhatIsNoTunnelIsLeftOut) {
  const DesignTunnel design = tests::sample_design(tests::circle_profile());
  MeshArrays mesh = tube(design, [](double, double) { return false; });
  const double whole = MeshInTunnel(mesh, design).between(20.0, 40.0).excavated_m3;
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const auto& [s, x] : {std::pair(29.0, 1.0), std::pair(31.0, 1.0), std::pair(30.0, 2.5)})
    mesh.points.push_back(design.alignment().to_site({s, x, 0.5}));
  mesh.triangles.push_back({first, first + 1, first + 2});  // a sheet of a machine
  EXPECT_NEAR(MeshInTunnel(mesh, design).between(20.0, 40.0).excavated_m3, whole, 1e-9 * whole);
}

TEST(MeshVolume, WhatIsNotClosedHasNone) {
  const DesignTunnel design = tests::sample_design(tests::circle_profile());
  const MeshArrays torn = tube(design, [](double s, double) { return s > 29.0 && s < 30.0; });
  EXPECT_FALSE(MeshInTunnel(torn, design).between(20.0, 40.0).closed) << "two tubes with a gap between them";
  EXPECT_FALSE(MeshInTunnel(torn, design).between(20.0, 25.0).closed) << "which of them is meant?";

  MeshArrays branched = tube(design, [](double, double) { return false; });
  branched.points.push_back(design.alignment().to_site({30.0, 0.0, 0.0}));
  const auto& first = branched.triangles.front();
  branched.triangles.push_back({first[0], first[1], static_cast<std::uint32_t>(branched.points.size() - 1)});
  EXPECT_FALSE(MeshInTunnel(branched, design).between(20.0, 40.0).closed) << "three triangles at one edge";
}

}  // namespace
}  // namespace adit
