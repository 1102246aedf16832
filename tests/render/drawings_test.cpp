// The deviation map, the volume chart, the plan and the bars of pairs.
#include <gtest/gtest.h>

#include "render/deviation_map_drawing.h"
#include "render/plan_drawing.h"
#include "render/registration_drawing.h"
#include "render/volume_chart.h"
#include "tests/render/golden.h"
#include "tests/render/sample_job.h"

using namespace adit;
using namespace adit::render;

namespace {

DeviationMap small_map(std::size_t rows) {
  DeviationMap map;
  map.from_m = 100.0;
  map.step_s_m = 0.5;
  map.step_q_m = 0.5;
  map.rows = rows;
  map.columns = 40;
  map.to_m = map.from_m + 0.5 * static_cast<double>(rows);
  map.cells.resize(rows * map.columns);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < map.columns; ++c) {
      MapCell& cell = map.cell(r, c);
      if (c < 5 && r % 40 < 10) continue;
      cell.kind = c < 8 && r % 40 < 12 ? CellKind::interpolated : CellKind::measured;
      cell.deviation_m = -0.15F + 0.4F * static_cast<float>(c) / 39.0F + 0.15F * static_cast<float>(r % 8) / 8.0F;
    }
  return map;
}

const MapTexts map_texts{"profile",
                         {{0.0, "-10", false}, {5.0, "-5", false}, {10.0, "crown 0", true}, {15.0, "+5", false}},
                         {{118, 100.0, 104.0, 0.0}, {119, 104.0, 108.0, 0.0}}};

std::vector<Section> three_sections() {
  std::vector<Section> sections;
  const double over[] = {1.0, 3.0, 2.0}, under[] = {0.5, 0.0, 1.0};
  for (int i = 0; i < 3; ++i) {
    Section s;
    s.chainage_m = 100.0 + 2.0 * i;
    s.lines.push_back({});
    s.lines[0].overbreak_m2 = over[i];
    s.lines[0].underbreak_m2 = under[i];
    sections.push_back(s);
  }
  return sections;
}

}  // namespace

TEST(DeviationMapDrawing, LooksAsItShould) {
  const DeviationMap map = small_map(80);
  Canvas canvas = Canvas::raster(130, deviation_map_height(map, 126) + 4, 120);
  draw_deviation_map(canvas, {2, 2, 126, deviation_map_height(map, 126)}, map, {-0.2, 0.4, 0.1}, map_texts);
  EXPECT_TRUE(tests::like_golden(canvas.finish_picture(), "map"));
}

TEST(DeviationMapDrawing, ColoursAreAtTheirPlace) {
  DeviationMap map = small_map(80);
  for (MapCell& cell : map.cells) cell = {0.05F, 0.0F, 5, 1.0F, CellKind::measured};
  for (std::size_t r = 0; r < 40; ++r)
    for (std::size_t c = 0; c < 20; ++c)
      map.cell(r, c).deviation_m = -0.15F;  // first half, left of the crown: upper left
  Canvas canvas = Canvas::raster(130, deviation_map_height(map, 126) + 4, 100);
  draw_deviation_map(canvas, {2, 2, 126, deviation_map_height(map, 126)}, map, {-0.2, 0.2, 0.1}, {});
  const Picture picture = canvas.finish_picture();
  const auto at = [&](double x_mm, double y_mm) {
    return picture.pixel(static_cast<int>(x_mm / 25.4 * 100), static_cast<int>(y_mm / 25.4 * 100));
  };
  EXPECT_GT(at(30, 12)[2], at(30, 12)[0] + 60);   // blue
  EXPECT_GT(at(110, 12)[0], at(110, 12)[2] - 1);  // reddish white
  EXPECT_GT(at(30, 50)[0], at(30, 50)[2] - 1);
}

TEST(DeviationMapDrawing, LongMapsComeInStripsAndEmptyOnesSaySo) {
  const double one = deviation_map_height(small_map(200), 180), three = deviation_map_height(small_map(500), 180);
  EXPECT_GT(three, 2.0 * one);
  Canvas canvas = Canvas::raster(180, 200, 60);
  draw_deviation_map(canvas, {0, 0, 180, 200}, small_map(500), {}, map_texts);
  draw_deviation_map(canvas, {0, 0, 180, 200}, {}, {}, map_texts);
  EXPECT_TRUE(seen_deviations({}).empty());
}

TEST(DeviationMapDrawing, MarksNameTheCrownInTheMiddle) {
  const tests::SampleJob sample;
  const auto marks = line_marks(sample.design, sample.map);
  const double width = static_cast<double>(sample.map.columns) * sample.map.step_q_m;
  const auto crown = std::find_if(marks.begin(), marks.end(), [](const LineMark& m) { return m.label == "crown 0"; });
  ASSERT_NE(crown, marks.end());
  EXPECT_NEAR(crown->q_m, width / 2.0, 0.1);
  EXPECT_TRUE(
      std::is_sorted(marks.begin(), marks.end(), [](const LineMark& a, const LineMark& b) { return a.q_m < b.q_m; }));
  EXPECT_EQ(std::count_if(marks.begin(), marks.end(), [](const LineMark& m) { return m.strong; }), 3);
}

TEST(VolumeChart, ExcessIsAddedUpByEndAreas) {
  const auto sums = accumulated_excess_m3(three_sections());
  ASSERT_EQ(sums.size(), 3U);
  EXPECT_DOUBLE_EQ(sums[0], 0.0);
  EXPECT_DOUBLE_EQ(sums[1], 2.0 * (0.5 + 3.0) / 2.0);
  EXPECT_DOUBLE_EQ(sums[2], 3.5 + 2.0 * (3.0 + 1.0) / 2.0);
  EXPECT_TRUE(accumulated_excess_m3({}).empty());
}

TEST(VolumeChart, LooksAsItShould) {
  Canvas canvas = Canvas::raster(140, 75, 120);
  draw_volume_chart(canvas, {2, 2, 136, 71}, three_sections(), {{118, 99.0, 102.0, 0.0}, {119, 102.0, 105.0, 0.0}});
  EXPECT_TRUE(tests::like_golden(canvas.finish_picture(), "volume_chart"));
  Canvas other = Canvas::raster(140, 75, 60);
  draw_volume_chart(other, {2, 2, 136, 71}, {}, {});
  draw_volume_chart(other, {2, 2, 136, 71}, {three_sections().front()}, {});
}

TEST(PlanDrawing, LooksAsItShould) {
  Plan plan;
  for (int i = 0; i <= 40; ++i)
    plan.axis.push_back({100.0 + 2.0 * i, {612345.0 + 1.6 * i, 6998765.0 + 1.2 * i + 0.004 * i * i}});
  plan.stations = {{"S1 <a>", {612353.0, 6998772.0}}, {"S2", {612390.0, 6998803.0}}};
  plan.control = {{"101", {612350.0, 6998766.0}}};
  Canvas canvas = Canvas::raster(140, 60, 120);
  draw_plan(canvas, {2, 2, 136, 56}, plan);
  EXPECT_TRUE(tests::like_golden(canvas.finish_picture(), "plan"));
  draw_plan(canvas, {2, 2, 136, 56}, {});
  draw_plan(canvas, {2, 2, 136, 56}, {{}, {{"S1", {612353.0, 6998772.0}}}, {}, {}});
}

TEST(RegistrationDrawing, ShowsTheWorstPairsFirst) {
  std::vector<PairResult> pairs(3);
  for (int i = 0; i < 3; ++i) {
    pairs[static_cast<std::size_t>(i)].source = "S" + std::to_string(i + 2);
    pairs[static_cast<std::size_t>(i)].target = "S" + std::to_string(i + 1);
    pairs[static_cast<std::size_t>(i)].rms_m = 0.003 + 0.002 * i;
    pairs[static_cast<std::size_t>(i)].median_m = 0.002 + 0.001 * i;
  }
  pairs[1].used = false;
  Canvas canvas = Canvas::raster(130, 26, 120);
  draw_pair_bars(canvas, {2, 2, 126, 22}, pairs);
  EXPECT_TRUE(tests::like_golden(canvas.finish_picture(), "pair_bars"));
  draw_pair_bars(canvas, {2, 2, 126, 22}, {});
}
