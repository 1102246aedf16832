#include "render/section_drawing.h"

#include <gtest/gtest.h>

#include "core/foundation/angle.h"
#include "render/section_outline.h"
#include "tests/render/golden.h"

using namespace adit;
using namespace adit::render;

namespace {

// A circle of radius 5, the rock a circle of radius 5 + d; unseen between the two angles (clockwise from the crown).
std::vector<OutlinePoint> round_outline(double d, double unseen_from_deg, double unseen_to_deg) {
  std::vector<OutlinePoint> outline;
  for (int i = 0; i < 720; ++i) {
    const double angle = rad_from_deg(0.5 * i);
    OutlinePoint point;
    point.normal = {std::sin(angle), std::cos(angle)};
    const bool unseen = 0.5 * i >= unseen_from_deg && 0.5 * i <= unseen_to_deg;
    point.kind = unseen ? CellKind::unseen : CellKind::measured;
    point.deviation_m = unseen ? 0.0 : d;
    point.position = (5.0 + point.deviation_m) * point.normal;
    point.p_m = 5.0 * wrapped_rad(angle);
    outline.push_back(point);
  }
  return outline;
}

Polygon circle(double radius) {
  Polygon ring;
  for (int i = 0; i < 720; ++i)
    ring.emplace_back(radius * std::sin(rad_from_deg(0.5 * i)), radius * std::cos(rad_from_deg(0.5 * i)));
  return ring;
}

double area(const std::vector<Polygon>& rings) {
  return std::abs(area_moment(rings).area_m2);
}

Section rough_section() {
  Section section;
  section.chainage_m = 118.0;
  section.station_m = 1118.0;
  section.axis_site = {612345.678, 6998765.432, 412.5};
  section.outline = round_outline(0.0, 400.0, 400.0);
  for (OutlinePoint& p : section.outline) {
    const double angle = p.p_m / 5.0;
    p.kind = angle > 2.4 || angle < -2.9  ? CellKind::unseen
             : angle > 1.0 && angle < 1.2 ? CellKind::interpolated
                                          : CellKind::measured;
    p.deviation_m = p.kind == CellKind::unseen
                        ? 0.0
                        : 0.25 + 0.2 * std::sin(7.0 * angle) - 0.65 * std::exp(-std::pow((angle + 1.6) / 0.2, 2));
    p.position = (5.0 + p.deviation_m) * p.normal;
  }
  section.lines = {{"excavation", 0.0, 78.54, 84.21, 7.32, 0.91, 0.45, 1.2, 0.38, -8.0, 0.72, 0.03}};
  return section;
}

Picture drawn(const Section& section, const std::vector<SectionLine>& lines) {
  Canvas canvas = Canvas::raster(92, 86, 150);
  draw_section(canvas, {2, 2, 88, 82}, section, lines);
  return canvas.finish_picture();
}

}  // namespace

TEST(SectionOutline, RunsAreCutWhereTheKindChanges) {
  const auto all = outline_runs(round_outline(0.2, 400.0, 400.0));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].points.size(), 721U);
  EXPECT_EQ(all[0].points.front(), all[0].points.back());
  const auto parts = outline_runs(round_outline(0.2, 90.0, 120.0));
  ASSERT_EQ(parts.size(), 2U);
  std::size_t edges = 0;
  for (const OutlineRun& run : parts) edges += run.points.size() - 1;
  EXPECT_EQ(edges, 720U);
  const auto& unseen = parts[0].kind == CellKind::unseen ? parts[0] : parts[1];
  EXPECT_EQ(unseen.points.size(), 63U);  // 61 points and one measured neighbour on each side
  EXPECT_TRUE(outline_runs({}).empty());
}

TEST(SectionOutline, UnseenPartsCountForNoLine) {
  const double sector = 1.0 / 12.0;  // 30 degrees
  const auto outline = round_outline(0.4, 90.0, 120.0);
  const double ring = pi * (5.4 * 5.4 - 25.0);
  EXPECT_NEAR(area(over_under(outline, circle(5.0), 0.0).over), ring * (1.0 - sector), 0.03 * ring);
  const auto pay = over_under(outline, circle(5.25), 0.25);
  const double pay_ring = pi * (5.4 * 5.4 - 5.25 * 5.25);
  EXPECT_NEAR(area(pay.over), pay_ring * (1.0 - sector), 0.03 * pay_ring);
  EXPECT_NEAR(area(pay.under), 0.0, 1e-3);
  EXPECT_TRUE(over_under({}, circle(5.0), 0.0).over.empty());
}

TEST(SectionOutline, ThinnedStaysWithinTheTolerance) {
  const Polygon full = circle(5.0);
  const Polygon few = thinned(full, 0.01);
  EXPECT_LT(few.size(), 80U);
  for (std::size_t i = 0; i + 1 < few.size(); ++i) EXPECT_GT(((few[i] + few[i + 1]) / 2.0).norm(), 5.0 - 0.0102);
  EXPECT_EQ(few.front(), full.front());
  EXPECT_EQ(few.back(), full.back());
}

TEST(SectionOutline, NearestPointAlongTheLine) {
  const auto outline = round_outline(0.1, 400.0, 400.0);
  EXPECT_NEAR(outline_at(outline, -2.5)->position.x(), 5.1 * std::sin(-0.5), 0.03);
  EXPECT_EQ(outline_at({}, 0.0), nullptr);
}

TEST(SectionDrawing, LooksAsItShould) {
  const std::vector<SectionLine> lines = {{"excavation", 0.0, circle(5.0)}, {"pay line", 0.25, circle(5.25)}};
  EXPECT_TRUE(tests::like_golden(drawn(rough_section(), lines), "section"));
}

TEST(SectionDrawing, TitleNamesTheStationWhereItDiffers) {
  Section section;
  section.chainage_m = section.station_m = 118.0;
  EXPECT_EQ(section_title(section), "Section 118.00");
  section.station_m = 1118.0;
  EXPECT_EQ(section_title(section), "Section 118.00 (station 1118.00)");
}

TEST(SectionDrawing, EmptyAndUnseenSectionsAreDrawn) {
  Section section;
  EXPECT_GT(drawn(section, {}).width, 0);
  section.outline = round_outline(0.0, 0.0, 360.0);
  const Picture unseen = drawn(section, {{"excavation", 0.0, circle(5.0)}});
  // No red and no blue fill where nobody looked.
  for (int y = 80; y < unseen.height - 90; y += 3)
    for (int x = 60; x < unseen.width - 10; x += 3) {
      const auto p = unseen.pixel(x, y);
      EXPECT_FALSE(p[0] > 240 && p[1] > 180 && p[1] < 225) << x << " " << y;
    }
}
