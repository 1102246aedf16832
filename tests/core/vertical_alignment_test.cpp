#include "core/design/vertical_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/error.h"

namespace adit {
namespace {

VerticalPoint pvi(double s, double z) {
  return {s, z, VerticalCurveKind::none, 0.0, 0.0};
}
VerticalPoint parabola(double s, double z, double length) {
  return {s, z, VerticalCurveKind::parabola, length, 0.0};
}
VerticalPoint circle(double s, double z, double radius) {
  return {s, z, VerticalCurveKind::circle, 0.0, radius};
}

std::string message_of(const std::vector<VerticalPoint>& points) {
  try {
    VerticalAlignment{points};
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GradeLine, GradesWithoutCurves) {
  const VerticalAlignment line({pvi(100, 10), pvi(200, 12), pvi(300, 11)});
  EXPECT_DOUBLE_EQ(line.at(150).elevation_m, 11.0);
  EXPECT_DOUBLE_EQ(line.at(150).grade, 0.02);
  EXPECT_DOUBLE_EQ(line.at(250).elevation_m, 11.5);
  EXPECT_DOUBLE_EQ(line.at(300.0005).elevation_m, 11.0);
  EXPECT_THROW(line.at(99.998), Error);
  EXPECT_THROW(line.at(300.002), Error);
}

TEST(GradeLine, ParabolaHasItsAnalyticMiddleAndEnds) {
  const VerticalAlignment line({pvi(0, 100), parabola(100, 103, 80), pvi(250, 100)});
  const double g1 = 0.03, g2 = -0.02;
  EXPECT_NEAR(line.at(100).elevation_m, 103 + (g2 - g1) * 80 / 8, 1e-12);  // external distance
  EXPECT_NEAR(line.at(60).grade, g1, 1e-15);
  EXPECT_NEAR(line.at(140).grade, g2, 1e-15);
  EXPECT_NEAR(line.at(60 - 1e-9).elevation_m, line.at(60 + 1e-9).elevation_m, 1e-9);
  EXPECT_NEAR(line.at(140 - 1e-9).elevation_m, line.at(140 + 1e-9).elevation_m, 1e-9);
  for (double s = 60; s <= 140; s += 1) {
    const double u = s - 60;
    EXPECT_NEAR(line.at(s).elevation_m, 100 + g1 * 60 + g1 * u + (g2 - g1) / 160 * u * u, 1e-12);
  }
}

TEST(GradeLine, UnsymmetricalParabolasMeetAtThePointWithOneGrade) {
  VerticalPoint crest = pvi(100, 103);
  crest.curve = VerticalCurveKind::unsymmetrical_parabola;
  crest.length_in_m = 30;
  crest.curve_length_m = 80;
  const VerticalAlignment line({pvi(0, 100), crest, pvi(250, 100)});
  const double g1 = 0.03, g2 = -0.02, l1 = 30, l2 = 50;
  EXPECT_NEAR(line.at(100).elevation_m, 103 + (g2 - g1) * l1 * l2 / (2 * (l1 + l2)), 1e-12);  // AASHTO's offset
  EXPECT_NEAR(line.at(70).grade, g1, 1e-15);
  EXPECT_NEAR(line.at(150).grade, g2, 1e-15);
  for (const double joint : {70.0, 100.0, 150.0}) {
    EXPECT_NEAR(line.at(joint - 1e-9).elevation_m, line.at(joint + 1e-9).elevation_m, 1e-9);
    EXPECT_NEAR(line.at(joint - 1e-9).grade, line.at(joint + 1e-9).grade, 1e-9);
  }
  crest.length_in_m = 40;  // as long on both sides: the plain parabola
  const VerticalAlignment even({pvi(0, 100), crest, pvi(250, 100)});
  const VerticalAlignment plain({pvi(0, 100), parabola(100, 103, 80), pvi(250, 100)});
  for (double s = 55; s < 145; s += 3) EXPECT_NEAR(even.at(s).elevation_m, plain.at(s).elevation_m, 1e-12);
  crest.length_in_m = 80;
  EXPECT_NE(message_of({pvi(0, 100), crest, pvi(250, 100)}).find("unsymmetrical"), std::string::npos);
}

TEST(GradeLine, CircleTouchesBothGradesAndKeepsItsRadius) {
  for (const double radius : {1500.0, -1500.0, 20000.0}) {  // the sign is a habit of programs, the grades decide
    for (const double rise : {6.0, -6.0}) {
      const VerticalAlignment line({pvi(0, 50), circle(500, 50, radius), pvi(900, 50 + rise)});
      const double r = std::abs(radius);
      const double slope = std::atan(rise / 400);
      const auto extent = line.curve_extent(1);
      const double tangent = r * std::tan(std::abs(slope) / 2);
      EXPECT_NEAR(extent.from_m, 500 - tangent, 1e-12);
      EXPECT_NEAR(extent.to_m, 500 + tangent * std::cos(slope), 1e-9);
      const double side = rise > 0 ? 1.0 : -1.0;
      const double centre_z = 50 + side * r;  // the first grade is level: the centre stands above or below its end
      for (double s = extent.from_m; s <= extent.to_m; s += tangent / 37) {
        EXPECT_NEAR(std::hypot(s - extent.from_m, line.at(s).elevation_m - centre_z), r, 1e-9);
      }
      EXPECT_NEAR(line.at(extent.to_m - 1e-12).grade, rise / 400, 1e-12);
      EXPECT_NEAR(line.at(extent.to_m - 1e-9).elevation_m, line.at(extent.to_m + 1e-9).elevation_m, 1e-10);
    }
  }
}

TEST(GradeLine, TouchingCurvesArePermittedOverlappingOnesNot) {
  EXPECT_EQ(message_of({pvi(0, 0), parabola(50, 1, 40), parabola(100, 0, 60), pvi(200, 3)}), "");
  EXPECT_EQ(message_of({pvi(0, 0), parabola(50, 1, 40.0005), parabola(100, 0, 60.0005), pvi(200, 3)}), "");
  const std::string words = message_of({pvi(0, 0), parabola(50, 1, 40.01), parabola(100, 0, 60), pvi(200, 3)});
  EXPECT_NE(words.find("chainage 50 and 100 overlap by 0.005 m"), std::string::npos) << words;
  EXPECT_NE(message_of({pvi(0, 0), parabola(50, 1, 120), pvi(200, 3)}), "");  // runs out of the start
}

TEST(GradeLine, RefusesWhatIsNoGradeLine) {
  EXPECT_NE(message_of({pvi(0, 0)}), "");
  EXPECT_NE(message_of({pvi(0, 0), pvi(0, 1)}).find("does not advance"), std::string::npos);
  EXPECT_NE(message_of({pvi(0, 0), pvi(10, 0), pvi(5, 1)}).find("chainage 5"), std::string::npos);
  EXPECT_NE(message_of({parabola(0, 0, 10), pvi(10, 0)}), "");
  EXPECT_NE(message_of({pvi(0, std::nan("")), pvi(10, 0)}), "");
  EXPECT_THROW(VerticalAlignment().at(0.0), Error);
}

TEST(GradeLine, MovesWithTheOrigin) {
  const VerticalAlignment line({pvi(0, 400), circle(100, 403, 2000), pvi(250, 400)});
  const VerticalAlignment moved = line.relative_to(400.0);
  for (double s = 0; s <= 250; s += 10) {
    EXPECT_NEAR(moved.at(s).elevation_m, line.at(s).elevation_m - 400.0, 1e-12);
    EXPECT_DOUBLE_EQ(moved.at(s).grade, line.at(s).grade);
  }
}

}  // namespace
}  // namespace adit
