#include "render/picture.h"

#include <gtest/gtest.h>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "render/colour_map.h"
#include "render/number_text.h"

using namespace adit;
using namespace adit::render;

namespace {

Picture noise(int width, int height, std::uint64_t seed) {
  Picture picture = blank_picture(width, height);
  const Random random(seed);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i)
    if (i % 4 != 3) picture.rgba[i] = static_cast<std::uint8_t>(random.bits(i) & 255);
  return picture;
}

double red_minus_blue(const Colour& c) {
  return c.red - c.blue;
}

}  // namespace

TEST(Picture, PngKeepsEveryPixelOfAnOpaquePicture) {
  const Picture picture = noise(37, 21, 1);
  const Picture back = picture_from_png(png_bytes(picture));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.rgba, picture.rgba);
  EXPECT_EQ(png_bytes(picture), png_bytes(back));
}

TEST(Picture, PngKeepsTransparency) {
  Picture picture = blank_picture(2, 1, {0, 0, 0, 0});
  picture.set_pixel(1, 0, {200, 100, 50, 128});
  const Picture back = picture_from_png(png_bytes(picture));
  EXPECT_EQ(back.pixel(0, 0)[3], 0);
  EXPECT_EQ(back.pixel(1, 0)[3], 128);
  EXPECT_NEAR(back.pixel(1, 0)[0], 200, 1);
}

TEST(Picture, BrokenPngIsRefused) {
  const std::string bytes = png_bytes(noise(20, 20, 2));
  EXPECT_THROW(picture_from_png("no picture"), Error);
  EXPECT_THROW(picture_from_png(bytes.substr(0, bytes.size() / 2)), Error);
}

TEST(Picture, SimilarityIsOneForEqualAndSmallForUnlikePictures) {
  const Picture a = noise(64, 48, 3);
  EXPECT_DOUBLE_EQ(structural_similarity(a, a), 1.0);
  EXPECT_LT(structural_similarity(a, noise(64, 48, 4)), 0.1);
  Picture brighter = a;
  for (std::size_t i = 0; i < brighter.rgba.size(); ++i)
    if (i % 4 != 3) brighter.rgba[i] = static_cast<std::uint8_t>(std::min(255, brighter.rgba[i] + 3));
  EXPECT_GT(structural_similarity(a, brighter), 0.97);
  EXPECT_THROW(structural_similarity(a, noise(48, 64, 3)), Error);
}

TEST(Colours, DeviationsGoFromBlueToRedInClasses) {
  const DeviationScale scale{-0.2, 0.5, 0.1};
  EXPECT_LT(red_minus_blue(deviation_colour(scale, -0.15)), -0.3);
  EXPECT_GT(red_minus_blue(deviation_colour(scale, 0.45)), 0.3);
  EXPECT_EQ(deviation_colour(scale, 0.31), deviation_colour(scale, 0.39));
  EXPECT_NE(deviation_colour(scale, 0.29), deviation_colour(scale, 0.31));
  EXPECT_EQ(deviation_colour(scale, 9.0), deviation_colour(scale, 0.45));
  EXPECT_EQ(deviation_colour(scale, -9.0), deviation_colour(scale, -0.15));
  EXPECT_GT(deviation_colour(scale, 0.01).green, 0.85);
  const Colour unknown = deviation_colour(scale, std::nan(""));
  EXPECT_EQ(unknown.red, unknown.blue);
}

TEST(Colours, ScaleIsRoundAndHoldsTheNumbers) {
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(-0.08F + 0.0005F * static_cast<float>(i));  // -0.08 ... 0.42
  values.push_back(std::nanf(""));
  const DeviationScale scale = deviation_scale(values);
  EXPECT_DOUBLE_EQ(scale.step_m, 0.1);
  EXPECT_DOUBLE_EQ(scale.least_m, -0.1);
  EXPECT_DOUBLE_EQ(scale.most_m, 0.5);
  EXPECT_EQ(scale.boundaries_m().size(), 7U);
  EXPECT_DOUBLE_EQ(scale.boundaries_m()[1], 0.0);
  EXPECT_EQ(deviation_scale({}).boundaries_m(), DeviationScale{}.boundaries_m());
}

TEST(Colours, RoundNumbers) {
  EXPECT_DOUBLE_EQ(round_up(0.034), 0.05);
  EXPECT_DOUBLE_EQ(round_up(0.2), 0.2);
  EXPECT_DOUBLE_EQ(round_up(6.0), 10.0);
  EXPECT_DOUBLE_EQ(round_down(49.0), 25.0);
  EXPECT_DOUBLE_EQ(round_down(0.1), 0.1);
  for (std::size_t i = 0; i < scan_colour_count; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Colour a = scan_colour(i), b = scan_colour(j);
      EXPECT_GT(std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue), 0.25)
          << i << " " << j;
    }
}

TEST(NumberText, SignsAndDecimals) {
  EXPECT_EQ(fixed(62.138, 2), "62.14");
  EXPECT_EQ(fixed(-0.5, 1), "\u22120.5");
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(with_sign(0.42, 2), "+0.42");
  EXPECT_EQ(with_sign(0.001, 2), "0.00");
  EXPECT_EQ(fixed(std::nan(""), 2), "\u2013");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(percent(0.9999), "99\u00a0%");
  EXPECT_EQ(percent(1.0), "100\u00a0%");
}
