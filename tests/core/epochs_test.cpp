// Before and after: faces, what was taken out between them, layers, changes; and how even a surface is.
#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/profiling/face_volume.h"
#include "core/profiling/map_change.h"
#include "core/profiling/undulation.h"
#include "tests/core/sample_map.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

RockTunnel rock_to(double face_m, bool clutter = false, double radius_m = 120.0) {
  RockTunnelOptions options;
  options.seed = 9;
  options.from_m = 1.0;
  options.face_m = face_m;
  options.clutter = clutter;
  return {tests::sample_design(tests::arch_profile(), radius_m), options};
}

std::vector<PlacedTiles> scans_of(const RockTunnel& rock, const std::vector<double>& stations_m) {
  std::vector<PlacedTiles> scans;
  for (const double s : stations_m) {
    const Pose pose = tests::station(rock.design(), s, 30.0 + s);
    scans.push_back(
        {"S", std::make_shared<CloudTiles>(tests::scan_at(rock, pose, static_cast<std::uint64_t>(s), 500000)), pose});
  }
  return scans;
}

FaceMap face_of(const std::vector<PlacedTiles>& scans, const DesignTunnel& design) {
  Progress progress;
  return find_face(scans, ChainageIndex(scans, design.alignment()), design, {}, progress);
}

TEST(Face, ItIsMetWhereItStandsToMillimetres) {
  const RockTunnel rock = rock_to(50.0);
  const FaceMap face = face_of(scans_of(rock, {36.0, 43.0}), rock.design());
  ASSERT_FALSE(face.cells.empty());
  double sum = 0.0, squares = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < face.cells.size(); ++i) {
    if (face.cells[i].kind != FaceKind::seen) continue;
    const Eigen::Vector2d at = face.middle(i % face.columns, i / face.columns);
    const double error = face.cells[i].chainage_m - rock.face_chainage(at.x(), at.y());
    sum += error;
    squares += error * error;
    ++n;
  }
  const auto count = static_cast<double>(n);
  EXPECT_LT(std::abs(sum / count), 0.001);
  EXPECT_LT(std::sqrt(squares / count), 0.012) << "within a cell of 10 cm the face leans";
  const FaceSummary summary = summarise(face);
  EXPECT_GT(summary.share(), 0.97);
  EXPECT_NEAR(summary.mean_m, true_face_chainage(rock), 0.005);
}

TEST(Face, MuckAndMachinesAreNotTheFace) {
  const RockTunnel rock = rock_to(50.0, true);
  const FaceMap face = face_of(scans_of(rock, {34.0, 45.8}), rock.design());
  ASSERT_FALSE(face.cells.empty());
  const FaceSummary summary = summarise(face);
  EXPECT_GT(summary.hidden_m2, 3.0);
  std::size_t wrong = 0, seen = 0;
  for (std::size_t i = 0; i < face.cells.size(); ++i) {
    if (face.cells[i].kind != FaceKind::seen) continue;
    const Eigen::Vector2d at = face.middle(i % face.columns, i / face.columns);
    ++seen;
    wrong += std::abs(face.cells[i].chainage_m - rock.face_chainage(at.x(), at.y())) > 0.1 ? 1 : 0;
  }
  EXPECT_LT(static_cast<double>(wrong), 0.02 * static_cast<double>(seen));
}

TEST(Face, AnOpenTunnelHasNone) {
  const RockTunnel rock = rock_to(100.0);  // out of sight
  EXPECT_TRUE(face_of(scans_of(rock, {30.0}), rock.design()).cells.empty());
}

/// What lies inside the rock between two faces, on a fine grid.
double true_volume_between(const RockTunnel& before, const RockTunnel& after) {
  constexpr double step = 0.02;
  const double first = before.options().face_m - 0.2, last = after.options().face_m + 0.2;
  double sum = 0.0;
  for (double s = first + 0.5 * step; s < last; s += step) {
    const double k = after.design().alignment().horizontal().at(s).curvature_per_m;
    for (double x = -6.0 + 0.5 * step; x < 6.0; x += step)
      for (double z = -1.0 + 0.5 * step; z < 7.5; z += step) {
        if (s < before.face_chainage(x, z) || s > after.face_chainage(x, z)) continue;
        const ProfileFoot foot = after.profile().nearest({x, z});
        if (foot.deviation_m < after.deviation(s, foot.p_m)) sum += step * step * step * (1.0 - k * x);
      }
  }
  return sum;
}

TEST(FaceVolumeSlow, ARoundBetweenTwoFacesWithinTwoSigmas) {
  const RockTunnel before = rock_to(44.0), after = rock_to(48.0);
  const DesignTunnel& design = after.design();
  const auto later = scans_of(after, {33.0, 40.0, 44.0});
  const FaceMap first = face_of(scans_of(before, {32.0, 39.0}), design), second = face_of(later, design);
  Progress progress;
  const MapResult mapped = map_deviations(later, design, 30.0, 48.5, {}, progress);
  const FaceVolume volume =
      volume_between(first, second, mapped.map, design, {"excavation", 0.0}, 0.002, 0.002, {}, {}, progress);
  ASSERT_TRUE(volume.whole);
  const double truth = true_volume_between(before, after);
  EXPECT_NEAR(volume.advance_m, 4.0, 0.01);
  EXPECT_NEAR(volume.excavated_m3, truth, 0.005 * truth);
  EXPECT_LT(std::abs(volume.excavated_m3 - truth), 2.0 * volume.sigma_m3);
  EXPECT_LT(volume.sigma_m3, 0.01 * truth);
  EXPECT_NEAR(volume.design_m3, 4.0 * after.profile().area_m2(), 0.02 * truth);

  const RockLeft left = rock_left(second, summarise(first).mean_m, 4.3, true);
  EXPECT_NEAR(left.mean_m, 0.3, 0.03);
  EXPECT_NEAR(left.over_03_share, 0.5, 0.1);

  const FaceVolume cut = volume_between(first, second, map_deviations(later, design, 30.0, 46.0, {}, progress).map,
                                        design, {"excavation", 0.0}, 0.002, 0.002, {}, {}, progress);
  EXPECT_FALSE(cut.whole);
}

TEST(FaceVolumeSlow, TheSameRoundOnASteepAxisInBothPlanes) {
  const Alignment level = tests::sample_axis(120.0);
  const Alignment steep("steep", level.horizontal(), VerticalAlignment({{0.0, 0.0}, {120.0, 14.4}}));
  const DesignTunnel design(steep, {{0.0, tests::arch_profile()}}, {{"excavation", 0.0}});
  const auto rock_on = [&](double face_m) {
    RockTunnelOptions options;
    options.seed = 9;
    options.from_m = 1.0;
    options.face_m = face_m;
    options.clutter = false;
    return RockTunnel(design, options);
  };
  const RockTunnel before = rock_on(44.0), after = rock_on(48.0);
  const auto earlier = scans_of(before, {32.0, 39.0}), later = scans_of(after, {33.0, 40.0, 44.0});
  const double truth = true_volume_between(before, after);
  Progress progress;
  for (const SectionPlane plane : {SectionPlane::vertical, SectionPlane::square}) {
    const DesignTunnel standing = design.standing(plane);
    const FaceMap first = face_of(earlier, standing), second = face_of(later, standing);
    const MapResult mapped = map_deviations(later, standing, 30.0, 50.0, {}, progress);
    const FaceVolume volume =
        volume_between(first, second, mapped.map, standing, {"excavation", 0.0}, 0.002, 0.002, {}, {}, progress);
    ASSERT_TRUE(volume.whole) << words_of(plane);
    EXPECT_NEAR(volume.advance_m, 4.0, 0.02) << words_of(plane);
    EXPECT_NEAR(volume.excavated_m3, truth, 0.01 * truth) << words_of(plane);
    EXPECT_LT(std::abs(volume.excavated_m3 - truth), 2.0 * volume.sigma_m3) << words_of(plane);
  }
}

RegistrationResult registered(double sigma_m) {
  RegistrationResult registration;
  PlacedScan scan;
  scan.placed = true;
  scan.sigma.along_m = scan.sigma.across_m = scan.sigma.up_m = sigma_m;
  registration.scans = {scan};
  return registration;
}

/// Distances that may be off by that much, in each epoch by itself.
ProfilingOptions biased_by(double range_bias_sigma_m) {
  ProfilingOptions options;
  options.range_bias_sigma_m = range_bias_sigma_m;
  return options;
}

TEST(Layer, ThicknessVolumeAndClassesOfAShell) {
  const double radius = 4.0;
  const DesignTunnel design = tests::sample_design(tests::circle_profile(radius), 60.0);
  const DeviationMap before = tests::map_of(design, [](double, const ProfilePoint&) { return 0.10; });
  // 8 cm, but 3 cm between chainage 22 and 24, and nothing on the floor.
  const DeviationMap after = tests::map_of(design, [](double s, const ProfilePoint& at) {
    if (at.normal.y() < -0.5) return 0.10;
    return s > 22.0 && s < 24.0 ? 0.07 : 0.02;
  });
  const MapChange change = compare_maps(before, after, design, {0.05, 0.07, {}}, standard_sectors(), registered(0.001),
                                        registered(0.001), biased_by(0.0));
  EXPECT_NEAR(change.layer.measured_m2, 2.0 * pi * (radius + 0.07) * 8.0, 0.02 * 200.0);
  // Guldin per sector of the ring; on the curve both sides balance.
  const auto shell = [&](double inner) {
    return (2.0 / 3.0) * pi * (std::pow(radius + 0.10, 2) - std::pow(radius + inner, 2));
  };
  const double exact = shell(0.02) * 6.0 + shell(0.07) * 2.0;
  EXPECT_NEAR(change.layer.volume_m3, exact, 0.01 * exact);
  EXPECT_NEAR(change.layer.below_minimum, 1.0 / 3.0 + 2.0 / 3.0 * 0.25, 0.06);
  EXPECT_NEAR(change.layer.from_nominal, 2.0 / 3.0 * 0.75, 0.06);
  EXPECT_NEAR(change.layer.below_minimum + change.layer.below_nominal + change.layer.from_nominal, 1.0, 1e-12);
  EXPECT_NEAR(change.change.level_m, 1.96 * std::hypot(0.001, 0.001), 1e-4);
  EXPECT_EQ(change.change.outwards_m2, 0.0);
  EXPECT_NEAR(change.change.inwards_m3, change.layer.volume_m3, 1e-6) << "all of the layer is significant";
  // Distances that are off by 2 mm in each epoch move all of the shell.
  const LayerResult biased =
      compare_maps(before, after, design, {}, standard_sectors(), registered(0.0), registered(0.0), biased_by(0.002))
          .layer;
  EXPECT_NEAR(biased.sigma_volume_m3, std::sqrt(2.0) * 0.002 * biased.measured_m2, 1e-3 * biased.measured_m2 * 0.002);
  const LayerBlock& one = change.layer.blocks.front();
  EXPECT_NEAR(one.chainage_m, 20.5, 1e-9);
  EXPECT_GT(one.sigma_m, 0.0005);
  EXPECT_LT(one.sigma_m, 0.0015);
}

TEST(Layer, OnlyTheSectorsThatGetItAndWhatWasNotMeasured) {
  const double radius = 4.0;
  const DesignTunnel design = tests::sample_design(tests::circle_profile(radius), 60.0);
  const DeviationMap before = tests::map_of(design, [](double, const ProfilePoint&) { return 0.0; });
  DeviationMap after = tests::map_of(design, [](double s, const ProfilePoint& at) {
    if (at.normal.y() < -0.5) return 0.0;  // the floor is bare
    return s > 24.0 ? -0.06 : -0.04;       // 4 cm, then 6 cm
  });
  const LayerDesign layer{
      0.03, 0.05, {"crown", "left shoulder", "right shoulder"}};  // within 70 degrees of straight up
  const LayerResult whole =
      compare_maps(before, after, design, layer, standard_sectors(), registered(0.0), registered(0.0), biased_by(0.0))
          .layer;
  EXPECT_EQ(whole.below_minimum, 0.0) << "the floor does not count";
  EXPECT_NEAR(whole.surface_m2, 8.0 * radius * 2.0 * rad_from_deg(70.0), 0.5);
  EXPECT_NEAR(whole.missing_m2, 0.0, 1e-9);
  EXPECT_NEAR(whole.whole_volume_m3, whole.volume_m3, 1e-9);
  // Of the thick half a quarter was not seen: the mean stands for it, and its sigma holds the truth.
  for (std::size_t r = 0; r < after.rows; ++r)
    if (after.row_chainage(r) > 26.0)
      for (std::size_t c = 0; c < after.columns; ++c) after.cell(r, c) = {};
  const LayerResult part =
      compare_maps(before, after, design, layer, standard_sectors(), registered(0.0), registered(0.0), biased_by(0.0))
          .layer;
  EXPECT_NEAR(part.missing_m2, 0.25 * whole.surface_m2, 0.01 * whole.surface_m2);
  EXPECT_LT(std::abs(part.whole_volume_m3 - whole.volume_m3), 2.0 * part.sigma_whole_m3);
  EXPECT_GT(std::abs(part.whole_volume_m3 - whole.volume_m3), 0.01) << "thin where it was seen";
  EXPECT_THROW(compare_maps(before, after, design, {0.03, 0.05, {"roof"}}, standard_sectors(), {}, {}, {}), Error);
}

TEST(Layer, NoiseIsNoSignificantChange) {
  const DesignTunnel design = tests::sample_design(tests::circle_profile());
  const double spread = 0.004;
  const auto noisy = [&](std::uint64_t seed) {
    const Random random(seed, 1);
    std::uint64_t i = 0;
    DeviationMap map =
        tests::map_of(design, [&](double, const ProfilePoint&) { return 0.1 + spread / 3.0 * random.normal(i++); });
    for (MapCell& cell : map.cells) cell.spread_m = static_cast<float>(spread);  // of 9 points each
    return map;
  };
  const MapChange change = compare_maps(noisy(1), noisy(2), design, {}, standard_sectors(), registered(0.0),
                                        registered(0.0), biased_by(0.0));
  const double share = (change.change.inwards_m2 + change.change.outwards_m2) / change.change.compared_m2;
  EXPECT_NEAR(share, 0.05, 0.005) << "a level of 95 %";
  DeviationMap other = noisy(1);
  other.step_q_m = 0.2;
  EXPECT_THROW(compare_maps(other, noisy(2), design, {}, standard_sectors(), {}, {}, {}), Error);
}

TEST(Undulation, WavesAndDentsAreMeasuredUnderTheEdge) {
  const DesignTunnel design = tests::sample_design(tests::circle_profile());
  // Waves of 2 m and 3 cm along the axis: the edge spans crest to crest over troughs of twice the amplitude.
  const DeviationMap waves =
      tests::map_of(design, [](double s, const ProfilePoint&) { return 0.03 * std::cos(pi * (s - 20.05)); });
  const UndulationResult along = undulation(waves, design, 3.0, 0.02);
  EXPECT_NEAR(along.along.max_depth_m, 0.06, 0.002);
  EXPECT_NEAR(along.along.max_ratio, 0.03, 0.002);
  EXPECT_GT(along.along.over_limit, 0.9);
  EXPECT_NEAR(along.around.max_depth_m, 0.0, 1e-6) << "an arch is even, though it is bent";
  EXPECT_GT(along.around.places, 80U * 200U);

  // A dent of 5 cm over 0.6 m at the crown; a bump is no gap.
  const DeviationMap dent = tests::map_of(design, [](double s, const ProfilePoint& at) {
    return std::abs(at.p_m) < 0.3 && std::abs(s - 24.0) < 0.3 ? 0.05 : 0.0;
  });
  const UndulationResult found = undulation(dent, design, 2.0, 0.0);
  EXPECT_NEAR(found.along.max_depth_m, 0.05, 1e-6);
  EXPECT_NEAR(found.along.chainage_m, 24.0, 0.3);
  EXPECT_NEAR(found.around.p_m, 0.0, 0.3);
  EXPECT_EQ(found.along.over_limit, 0.0);
  EXPECT_NEAR(found.along.depth_95_m, 0.0, 1e-6);

  DeviationMap holed = waves;
  for (std::size_t r = 0; r < holed.rows; r += 10)
    for (std::size_t c = 0; c < holed.columns; ++c) holed.cell(r, c) = holed.cell(r + 1, c) = MapCell{};
  EXPECT_EQ(undulation(holed, design, 3.0, 0.0).along.places, 0U) << "no edge is laid over what was not seen";
}

}  // namespace
}  // namespace adit
