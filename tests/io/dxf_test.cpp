#include "io/dxf.h"

#include <gtest/gtest.h>

#include "core/foundation/angle.h"
#include "io/read_profile.h"
#include "tests/core/profile_shapes.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

std::string pairs(std::initializer_list<std::pair<int, std::string>> list) {
  std::string text;
  for (const auto& [code, value] : list) text += std::to_string(code) + "\n" + value + "\n";
  return text;
}
std::string real(double value) {
  return std::to_string(value);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& layer = "0") {
  return pairs({{0, "LINE"},
                {8, layer},
                {10, real(x1)},
                {20, real(y1)},
                {30, "0.0"},
                {11, real(x2)},
                {21, real(y2)},
                {31, "0.0"}});
}
std::string arc(double x, double y, double r, double from_deg, double to_deg, const std::string& layer = "0",
                const std::string& more = "") {
  return pairs({{0, "ARC"},
                {8, layer},
                {10, real(x)},
                {20, real(y)},
                {30, "0.0"},
                {40, real(r)},
                {50, real(from_deg)},
                {51, real(to_deg)}}) +
         more;
}
std::string circle(double x, double y, double r, const std::string& layer = "0") {
  return pairs({{0, "CIRCLE"}, {8, layer}, {10, real(x)}, {20, real(y)}, {30, "0.0"}, {40, real(r)}});
}
struct V {
  double x, y, bulge;
};
std::string lwpolyline(const std::vector<V>& vertices, bool closed, const std::string& layer = "0") {
  std::string text =
      pairs({{0, "LWPOLYLINE"}, {8, layer}, {90, std::to_string(vertices.size())}, {70, closed ? "1" : "0"}});
  for (const V& v : vertices) text += pairs({{10, real(v.x)}, {20, real(v.y)}, {42, real(v.bulge)}});
  return text;
}
std::string old_polyline(const std::vector<V>& vertices, bool closed) {
  std::string text = pairs({{0, "POLYLINE"}, {8, "old"}, {66, "1"}, {70, closed ? "1" : "0"}});
  for (const V& v : vertices)
    text += pairs({{0, "VERTEX"}, {8, "old"}, {10, real(v.x)}, {20, real(v.y)}, {30, "0.0"}, {42, real(v.bulge)}});
  return text + pairs({{0, "SEQEND"}});
}
std::string drawing(const std::string& entities, int insunits = 6, const std::string& blocks = "") {
  return pairs({{0, "SECTION"},
                {2, "HEADER"},
                {9, "$ACADVER"},
                {1, "AC1015"},
                {9, "$INSUNITS"},
                {70, std::to_string(insunits)},
                {0, "ENDSEC"}}) +
         blocks + pairs({{0, "SECTION"}, {2, "ENTITIES"}}) + entities + pairs({{0, "ENDSEC"}, {0, "EOF"}});
}

/// A D-shape of loose entities, in any order and direction: walls 2 m, arch of radius 3 m.
std::string loose_d(double unit = 1.0, const std::string& layer = "0") {
  return line(-3 * unit, 0, 3 * unit, 0, layer) + arc(0, 2 * unit, 3 * unit, 0, 180, layer) +
         line(3 * unit, 2 * unit, 3 * unit, 0, layer) + line(-3 * unit, 2 * unit, -3 * unit, 0, layer);
}
const double d_area = 12 + pi * 9 / 2;

class Dxf : public ::testing::Test {
 protected:
  Profile read(const std::string& text, const std::string& layer = "") {
    return read_dxf_profile(folder_.write("profile.dxf", text), layer);
  }
  std::string refusal(const std::string& text, const std::string& layer = "") {
    return error_of([&] { read(text, layer); });
  }
  tests::TemporaryFolder folder_;
};

TEST_F(Dxf, LooseLinesAndArcsAreChained) {
  const Profile profile = read(drawing(loose_d()));
  EXPECT_NEAR(profile.area_m2(), d_area, 1e-9);
  EXPECT_EQ(profile.corners().size(), 2U);
}

TEST_F(Dxf, PolylinesOfBothKindsWithBulges) {
  const std::vector<V> d{{-3, 0, 0}, {3, 0, 0}, {3, 2, 1}, {-3, 2, 0}};
  EXPECT_NEAR(read(drawing(lwpolyline(d, true))).area_m2(), d_area, 1e-5);
  EXPECT_NEAR(read(drawing(old_polyline(d, true))).area_m2(), d_area, 1e-5);
  std::vector<V> repeated = d;
  repeated.push_back(d[0]);
  EXPECT_NEAR(read(drawing(lwpolyline(repeated, false))).area_m2(), d_area, 1e-5);
  // An open polyline closed by a loose line.
  EXPECT_NEAR(read(drawing(lwpolyline({d[1], d[2], d[3], d[0]}, false) + line(-3, 0, 3, 0))).area_m2(), d_area, 1e-5);
}

TEST_F(Dxf, ACircleIsAProfile) {
  const Profile profile = read(drawing(circle(0.5, 3, 4)));
  EXPECT_NEAR(profile.area_m2(), 16 * pi, 1e-9);
  EXPECT_NEAR(profile.at(0).position.x(), 0.5, 1e-9);
}

TEST_F(Dxf, UnitsBecomeMetres) {
  EXPECT_NEAR(read(drawing(loose_d(1000.0), 4)).area_m2(), d_area, 1e-9);
  EXPECT_NEAR(read(drawing(loose_d(100.0), 5)).area_m2(), d_area, 1e-9);
  EXPECT_NEAR(read(drawing(loose_d(1.0), 2)).area_m2(), d_area * 0.3048 * 0.3048, 1e-9);
  EXPECT_NEAR(read(drawing(loose_d(1.0), 0)).area_m2(), d_area, 1e-9);
  expect_words(refusal(drawing(loose_d(), 20)), {"$INSUNITS 20"});
}

TEST_F(Dxf, AnArcDrawnFromBehindIsMirrored) {
  // Extrusion (0, 0, -1): the arc's own x axis runs to the left.
  const std::string behind = pairs({{210, "0.0"}, {220, "0.0"}, {230, "-1.0"}});
  const std::string text = line(-3, 0, 5, 0) + arc(-1, 0, 4, 0, 180, "0", behind);  // centre at x = +1
  EXPECT_NEAR(read(drawing(text)).area_m2(), pi * 8, 1e-9);
  EXPECT_NEAR(read(drawing(text)).box().max().x(), 5.0, 1e-9);
}

TEST_F(Dxf, TheLayerChoosesAmongSeveralClosedLines) {
  const std::string text =
      drawing(loose_d(1.0, "excavation") + circle(0, 2, 1, "lining") + line(9, 9, 10, 10, "frame"));
  EXPECT_NEAR(read(text, "lining").area_m2(), pi, 1e-9);
  EXPECT_EQ(read(text, "excavation").name(), "profile/excavation");
  expect_words(refusal(text), {"2 closed lines", "\"excavation\", \"lining\""});
  expect_words(refusal(text, "pay"), {"nothing on layer \"pay\"", "\"excavation\", \"frame\", \"lining\""});
  expect_words(refusal(text, "frame"), {"no closed line", "\"frame\""});
}

TEST_F(Dxf, OpenAndBranchingLinesAreRefusedWithThePlace) {
  const std::string open = arc(0, 2, 3, 0, 180) + line(3, 2, 3, 0) + line(-3, 2, -3, 0);
  expect_words(refusal(drawing(open)), {"no closed line", "(3, 0) m", "(-3, 0) m", "close the line along the floor"});
  // The floor drawn twice: no way around is the only one. A single stub on the outline leaves one.
  expect_words(refusal(drawing(loose_d() + line(-3, 0, 3, 0))), {"three or more ends meet", "(-3, 0) m"});
  EXPECT_NEAR(read(drawing(loose_d() + line(-3, 0, -5, 1))).area_m2(), d_area, 1e-9);
  const std::string spline = pairs({{0, "SPLINE"}, {8, "0"}, {70, "8"}, {71, "1"}, {72, "0"}, {73, "0"}, {74, "0"}});
  expect_words(refusal(drawing(open + spline)), {"not read: SPLINE"});
  expect_words(refusal(drawing("")), {"no closed line"});
}

TEST_F(Dxf, EntitiesInsideBlocksAreNotTheProfile) {
  const std::string blocks = pairs({{0, "SECTION"},
                                    {2, "BLOCKS"},
                                    {0, "BLOCK"},
                                    {8, "0"},
                                    {2, "bolt"},
                                    {70, "0"},
                                    {10, "0.0"},
                                    {20, "0.0"},
                                    {30, "0.0"}}) +
                             circle(0, 0, 1) + pairs({{0, "ENDBLK"}, {0, "ENDSEC"}});
  EXPECT_NEAR(read(drawing(loose_d(), 6, blocks)).area_m2(), d_area, 1e-9);
}

TEST_F(Dxf, BrokenTextIsRefusedWithLineAndColumn) {
  std::string text = drawing(loose_d());
  const auto at = text.find("3.000000");
  expect_words(refusal(std::string(text).replace(at, 8, "3.00oo00")),
               {"profile.dxf:", "3.00oo00\"", "a number is needed"});
  expect_words(refusal(text.substr(0, text.size() - 8)), {"cut off"});
  expect_words(refusal("hello\nworld\n"), {"profile.dxf:1:1", "group code", "\"hello\""});
  expect_words(refusal("AutoCAD Binary DXF\r\n"), {"binary", "ASCII"});
  expect_words(refusal(drawing(pairs({{0, "LWPOLYLINE"}, {8, "0"}, {90, "2000000000"}}))),
               {"more places are announced"});
  expect_words(error_of([&] { read_dxf_profile(folder_ / "absent.dxf"); }), {"absent.dxf"});
  expect_words(refusal(drawing(lwpolyline({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}, true))),
               {"profile.dxf", "crosses"});
}

TEST_F(Dxf, ThereAndBack) {
  const Profile profile("a", shapes::horseshoe());
  write_dxf_profile(folder_ / "written.dxf", profile, "excavation");
  const Profile back = read_profile(folder_ / "written.dxf", "excavation");
  EXPECT_EQ(back.segments().size(), profile.segments().size());
  EXPECT_NEAR(back.area_m2(), profile.area_m2(), 1e-9);
  for (double p = -10; p < 10; p += 0.3) EXPECT_LT((back.at(p).position - profile.at(p).position).norm(), 1e-9);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "written.dxf.draft"));
  expect_words(error_of([&] { write_dxf_profile(folder_ / "no/such/folder.dxf", profile); }), {"folder.dxf"});
}

}  // namespace
}  // namespace adit::io
