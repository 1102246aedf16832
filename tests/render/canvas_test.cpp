#include "render/canvas.h"

#include <gtest/gtest.h>

#include "core/foundation/error.h"
#include "render/axes.h"
#include "render/map_signs.h"
#include "render/table_drawing.h"
#include "tests/render/golden.h"

using namespace adit;
using namespace adit::render;

namespace {

// Everything a canvas can do, on 80 x 60 mm.
void draw_sampler(Canvas& canvas) {
  const Rect outer{10, 5, 30, 30}, hole{18, 13, 14, 14};
  canvas.fill({ring_of(outer), ring_of(hole)}, colours::overbreak_pale);
  canvas.hatch({ring_of(hole)}, {colours::underbreak, 0.2, {}}, 1.5, 0.8);
  canvas.frame(outer, {colours::red, 0.4, {2.0, 1.0}});
  canvas.disc({25, 20}, 2.0, colours::green);
  canvas.polyline({{45, 5}, {50, 15}, {55, 5}, {60, 15}}, {colours::ink_blue, 0.6, {}});
  canvas.text({42, 18}, "Søråsen <A&B> Größe", {.size_mm = 3.0, .bold = true});
  canvas.text({42, 23}, "a long name that is cut", {.shorten_mm = 24.0});
  canvas.text({78, 26}, "right \u22120.25", {.across = Across::right});
  canvas.text({45, 30}, "a text that is broken into lines where its room ends", {.wrap_mm = 30.0});
  canvas.text({6, 20}, "turned", {.across = Across::centre, .down = Down::middle, .turn_rad = -1.5708});
  canvas.save();
  canvas.clip({45, 42, 10, 10});
  canvas.translate(45, 42);
  canvas.rotate(0.5);
  canvas.fill(Rect{0, 0, 30, 30}, colours::light_grey);
  canvas.restore();
  Picture tiles = blank_picture(2, 2, {200, 30, 30, 255});
  tiles.set_pixel(1, 0, {30, 30, 200, 255});
  tiles.set_pixel(0, 1, {30, 30, 200, 0});
  canvas.picture(tiles, {60, 42, 12, 12}, false);
  draw_scale_bar(canvas, {10, 45}, 4.0, 30.0);
  draw_north_arrow(canvas, {14, 54}, 6.0, 0.4);
}

std::string sampler_pdf(const std::string& date) {
  Canvas canvas = Canvas::pdf(80, 60, {"Title & <more>", "Surveyor", date});
  draw_sampler(canvas);
  canvas.next_page();
  draw_sampler(canvas);
  return canvas.finish();
}

}  // namespace

TEST(Canvas, LooksAsItShould) {
  Canvas canvas = Canvas::raster(80, 60, 120);
  draw_sampler(canvas);
  EXPECT_TRUE(tests::like_golden(canvas.finish_picture(), "canvas"));
}

TEST(Canvas, MillimetresAreWhereTheyShouldBe) {
  Canvas canvas = Canvas::raster(20, 10, 254);  // 10 pixels a millimetre
  canvas.fill(Rect{5, 2, 4, 3}, {1.0, 0.0, 0.0});
  const Picture picture = canvas.finish_picture();
  ASSERT_EQ(picture.width, 200);
  ASSERT_EQ(picture.height, 100);
  const std::array<std::uint8_t, 4> red{255, 0, 0, 255}, white{255, 255, 255, 255};
  EXPECT_EQ(picture.pixel(50, 20), red);
  EXPECT_EQ(picture.pixel(89, 49), red);
  EXPECT_EQ(picture.pixel(49, 20), white);
  EXPECT_EQ(picture.pixel(90, 49), white);
  EXPECT_EQ(picture.pixel(89, 50), white);
}

TEST(Canvas, PdfBytesAreTheSameEveryTime) {
  const std::string bytes = sampler_pdf("2024-05-31");
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  EXPECT_EQ(bytes, sampler_pdf("2024-05-31"));
  EXPECT_NE(bytes, sampler_pdf("2024-06-01"));
  EXPECT_THROW(sampler_pdf("yesterday"), Error);
}

TEST(Canvas, SvgHoldsTheDrawing) {
  Canvas canvas = Canvas::svg(80, 60);
  draw_sampler(canvas);
  const std::string bytes = canvas.finish();
  EXPECT_NE(bytes.find("<svg"), std::string::npos);
  EXPECT_NE(bytes.find("</svg>"), std::string::npos);
}

TEST(Canvas, BrokenTextDoesNoHarm) {
  Canvas canvas = Canvas::raster(40, 10, 100);
  canvas.text({1, 1}, std::string("S\xff\xfe") + "1\x80", {});
  const double with = canvas.text_size(std::string("S1\xff"), {}).x();
  EXPECT_GT(with, canvas.text_size("S1", {}).x());
  EXPECT_THROW(canvas.finish(), Error);
}

TEST(Canvas, TextIsMeasuredAlikeOnPaperAndInPictures) {
  const Canvas paper = Canvas::pdf(80, 60, {});
  const Canvas picture = Canvas::raster(80, 60, 96);
  const TextStyle style{.size_mm = 2.4, .wrap_mm = 40.0};
  const std::string text = "direction along of scan S3 is not determined by the clouds; add a target";
  EXPECT_NEAR(paper.text_size(text, style).x(), picture.text_size(text, style).x(), 0.01);
  EXPECT_NEAR(paper.text_size(text, style).y(), picture.text_size(text, style).y(), 0.01);
}

TEST(Axes, TicksAreRoundAndInside) {
  const Ticks ticks = nice_ticks(99.9, 180.1, 10);
  EXPECT_DOUBLE_EQ(ticks.step, 10.0);
  EXPECT_DOUBLE_EQ(ticks.values.front(), 100.0);
  EXPECT_DOUBLE_EQ(ticks.values.back(), 180.0);
  EXPECT_EQ(ticks.decimals, 0);
  EXPECT_EQ(nice_ticks(0.0, 0.9, 4).decimals, 2);
  EXPECT_TRUE(nice_ticks(5.0, 5.0, 4).values.empty());
}

TEST(Axes, TrueScaleIsRoundAndHoldsTheBox) {
  double scale = 0.0;
  const Eigen::AlignedBox2d box(Eigen::Vector2d(-4.0, -1.0), Eigen::Vector2d(4.5, 7.0));
  const PlotArea area = true_scale_area({0, 0, 80, 60}, box, scale);
  EXPECT_DOUBLE_EQ(scale, 150.0);
  EXPECT_NEAR(area.paper_x(1.0) - area.paper_x(0.0), 1000.0 / 150.0, 1e-9);
  EXPECT_NEAR(area.paper_y(0.0) - area.paper_y(1.0), 1000.0 / 150.0, 1e-9);
  EXPECT_LE(area.x_from, -4.0);
  EXPECT_GE(area.y_to, 7.0);
}

TEST(Tables, SplitWhereThePaperEndsAndLoseNoRow) {
  Canvas canvas = Canvas::raster(100, 60, 100);
  Table table{{{"name", 20, false}, {"words", 50, false}, {"number", 20, true}}, {}, 2.4};
  for (int i = 0; i < 30; ++i)
    table.rows.push_back(
        {std::to_string(i), i % 7 == 3 ? "many words that need a second line in this narrow column" : "short", "1.00"});
  std::size_t row = 0;
  int parts = 0;
  while (row < table.rows.size()) {
    const TablePart part = draw_table(canvas, {0, 0}, table, row, 40.0);
    ASSERT_GT(part.next_row, row);
    EXPECT_LE(part.height_mm, 40.0);
    row = part.next_row;
    ++parts;
  }
  EXPECT_GE(parts, 3);
  EXPECT_GT(row_height(canvas, table, 3), 1.5 * row_height(canvas, table, 2));
  EXPECT_EQ(draw_table(canvas, {0, 0}, table, 0, 1.0).next_row, 0U);
  EXPECT_EQ(draw_table(canvas, {0, 0}, table, 0, 1.0, true).next_row, 1U);
}
