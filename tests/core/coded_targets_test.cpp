#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "core/foundation/error.h"
#include "core/georeference/detect_targets.h"
#include "tests/core/target_drawing.h"

namespace adit {
namespace {

using tests::drawn_target;
using tests::DrawnTarget;

constexpr int width = 800, height = 600;
const Eigen::Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));

double wavy(int u, int v) {
  return 90.0 + 40.0 * std::sin(0.031 * u) * std::cos(0.027 * v);
}

GreyPicture drawn(const std::vector<DrawnTarget>& targets, const tests::DrawingOptions& options = {}) {
  return tests::draw_targets(width, height, targets, options, wavy);
}

std::vector<DetectedTarget> found_in(const GreyPicture& picture, const std::vector<TargetCode>& codes = {}) {
  Progress progress;
  DetectOptions options;
  options.fit.codes = codes;
  options.fit.focal_length_px = 1000.0;
  return detect_targets(picture, options, progress);
}

std::vector<TargetCode> first_codes(int count) {
  return {target_codes().begin(), target_codes().begin() + count};
}

TEST(CodedPattern, AsManyCodesAsThePaperKeepsAndTheFirstAreFarApart) {
  ASSERT_EQ(target_codes().size(), 4017U);
  const std::set<TargetCode> all(target_codes().begin(), target_codes().end());
  EXPECT_EQ(all.size(), 4017U) << "each once";
  int few = 0;  // of the others each has fewer than three black segments
  for (unsigned code = 0; code < 4096; ++code) {
    if (all.count(static_cast<TargetCode>(code)) != 0) continue;
    EXPECT_LT(std::popcount(code), 3);
    EXPECT_EQ(id_of_code(static_cast<TargetCode>(code)), 0);
    ++few;
  }
  EXPECT_EQ(few, 1 + 12 + 66);
  for (const int apart : {2, 3, 4}) {
    const auto codes = first_codes(codes_differing_in(apart));
    EXPECT_GE(codes.size(), apart == 4 ? 100U : 200U);
    for (std::size_t i = 0; i < codes.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        ASSERT_GE(std::popcount(static_cast<unsigned>(codes[i] ^ codes[k])), apart) << i << " " << k;
  }
  EXPECT_EQ(id_of_code(code_of_id(77)), 77);
  EXPECT_THROW(code_of_id(0), Error);
  EXPECT_THROW(code_of_id(4018), Error);
}

TEST(CodedPattern, IsReadCounterClockwiseFromTheBaseline) {
  const TargetCode code = 0b100010010101;  // the paper's first one
  EXPECT_TRUE(is_black_at(code, 0.8 * std::cos(0.1), 0.8 * std::sin(0.1)));
  EXPECT_FALSE(is_black_at(code, 0.8 * std::cos(0.6), 0.8 * std::sin(0.6)));
  EXPECT_TRUE(is_black_at(code, 0.8 * std::cos(-0.1), 0.8 * std::sin(-0.1)));
  EXPECT_FALSE(is_black_at(code, 0.1, 0.1)) << "the white quarter";
  EXPECT_TRUE(is_black_at(code, -0.1, 0.1));
}

TEST(DetectTargets, PlaceAndIdOfTargetsLargeSmallAndOblique) {
  for (const double tilt_deg : {0.0, 25.0, 45.0, 60.0})
    for (const double diameter_px : {28.0, 60.0, 150.0, 380.0}) {
      const Eigen::Vector2d at(411.3, 287.6);
      const DrawnTarget target =
          drawn_target(code_of_id(1234), at, diameter_px, rad_from_deg(tilt_deg), 1.1, 2.2, 1000.0, middle);
      const auto found = found_in(drawn({target}));
      ASSERT_EQ(found.size(), 1U) << diameter_px << " px at " << tilt_deg;
      EXPECT_EQ(found[0].id, 1234);
      const double off_px = (found[0].center - at).norm();
      EXPECT_LT(off_px, 0.08 + 1e-3 * diameter_px) << diameter_px << " px at " << tilt_deg;
      EXPECT_LT(off_px, 4.5 * found[0].sigma_px + 0.03);
      EXPECT_NEAR(found[0].diameter_px, diameter_px, 0.04 * diameter_px + 0.5);
    }
}

TEST(DetectTargets, TheEllipsesCentreIsNotTheCircles) {
  // Seen from near and obliquely: the middle of the ellipse's box lies pixels beside the circle's centre.
  const DrawnTarget target =
      drawn_target(code_of_id(7), {400.0, 300.0}, 380.0, rad_from_deg(60.0), 0.0, 0.5, 1000.0, middle);
  double low = 1e9, high = -1e9;
  for (int i = 0; i < 720; ++i) {
    const double a = 2.0 * pi * i / 720.0;
    const Eigen::Vector3d p =
        target.camera_from_target * Eigen::Vector3d(target.radius_m * std::cos(a), target.radius_m * std::sin(a), 0.0);
    const double v = middle.y() + 1000.0 * p.y() / p.z();
    low = std::min(low, v);
    high = std::max(high, v);
  }
  ASSERT_GT(std::abs(0.5 * (low + high) - 300.0), 5.0);
  const auto found = found_in(drawn({target}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].center.y(), 300.0, 0.3);
}

TEST(DetectTargets, DarkBlurredAndPartlyHidden) {
  const DrawnTarget target = drawn_target(code_of_id(21), {300.4, 250.7}, 90.0, 0.5, 0.3, 4.0, 1000.0, middle);
  tests::DrawingOptions dark;
  dark.white = 34.0;
  dark.black = 8.0;
  dark.noise = 2.5;
  auto night = [](int, int) { return 14.0; };
  auto found = found_in(tests::draw_targets(width, height, {target}, dark, night));
  ASSERT_EQ(found.size(), 1U) << "in the dark";
  EXPECT_EQ(found[0].id, 21);
  tests::DrawingOptions blurred;
  blurred.blur_px = 3.0;
  found = found_in(drawn({target}, blurred));
  ASSERT_EQ(found.size(), 1U) << "out of focus";
  EXPECT_LT((found[0].center - Eigen::Vector2d(300.4, 250.7)).norm(), 0.15);
  // A cable across one segment: read only when it is known which codes were printed.
  GreyPicture covered = drawn({target});
  for (int v = 200; v < 300; ++v)
    for (int u = 328; u < 336; ++u) covered.pixels[covered.index(u, v)] = 120;
  for (const DetectedTarget& any : found_in(covered)) EXPECT_EQ(any.id, 21);
  found = found_in(covered, first_codes(40));
  ASSERT_EQ(found.size(), 1U) << "partly hidden";
  EXPECT_EQ(found[0].id, 21);
}

TEST(DetectTargets, AReflectionOnWhitePaperMakesNoOtherCode) {
  // Paper as bright as the picture can be, light beyond a line across the disc: black segments vanish without a trace.
  // Only where the light lies over the white quarter alone can nobody tell.
  tests::DrawingOptions bright;
  bright.white = 300.0;
  const Eigen::Vector2d at(300.4, 250.7);
  const DrawnTarget target = drawn_target(code_of_id(13), at, 80.0, 0.2, 0.3, 1.0, 1000.0, middle);
  const GreyPicture clear = drawn({target}, bright);
  int read = 0;
  for (int k = 0; k < 24; ++k)
    for (const double off_px : {4.0, 6.0, 8.0}) {
      const Eigen::Vector2d towards(std::cos(2.0 * pi * k / 24), std::sin(2.0 * pi * k / 24));
      GreyPicture lit = clear;
      double black = 0.0, black_lit = 0.0;
      for (int v = 180; v < 320; ++v)
        for (int u = 230; u < 370; ++u) {
          const double light = 125.0 * (towards.dot(Eigen::Vector2d(u, v) - at) - off_px);
          const int grey = lit.at(u, v) + static_cast<int>(std::clamp(light, 0.0, 255.0));
          const bool of_disc = lit.at(u, v) < 60 && (Eigen::Vector2d(u, v) - at).norm() < 15.0;
          black += of_disc ? 1.0 : 0.0;
          black_lit += of_disc && grey > 200 ? 1.0 : 0.0;
          lit.pixels[lit.index(u, v)] = static_cast<std::uint8_t>(std::min(255, grey));
        }
      for (const DetectedTarget& found : found_in(lit)) {
        ++read;
        EXPECT_TRUE(found.id == 13 || black_lit < 0.04 * black) << "light from " << k << " beyond " << off_px << " px";
      }
    }
  EXPECT_EQ(found_in(clear).size(), 1U);
  EXPECT_LT(read, 72);
}

TEST(DetectTargets, NothingWhereThereIsNone) {
  const auto empty = [](const auto& background) {
    return found_in(tests::draw_targets(width, height, {}, {}, background)).empty();
  };
  EXPECT_TRUE(empty([](int, int) { return 100.0; }));
  EXPECT_TRUE(empty([](int u, int v) {
    return (u / 40 + (v / 20) % 2) % 2 == 0 && u % 40 > 3 && v % 20 > 3 ? 140.0 : 60.0;
  })) << "bricks";
  EXPECT_TRUE(empty([](int u, int v) { return u % 17 < 3 || v % 17 < 3 ? 30.0 : 180.0; })) << "mesh";
  EXPECT_TRUE(empty([](int u, int v) {
    const double r = std::hypot(u % 60 - 30.0, v % 60 - 30.0);
    return r < 7.0 || (r > 12.0 && r < 20.0) ? 30.0 : 190.0;
  })) << "bolts with plates";
  EXPECT_THROW(found_in(GreyPicture(20, 20)), Error);
}

}  // namespace
}  // namespace adit
