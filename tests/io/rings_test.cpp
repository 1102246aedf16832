#include <gtest/gtest.h>

#include "io/read_rings.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

class RingFiles : public ::testing::Test {
 protected:
  RingFile read(const std::string& text, double offset_m = 0.0, const std::string& name = "rings.csv") {
    return read_rings(folder_.write(name, text), offset_m);
  }
  std::string refusal(const std::string& text, const std::string& name = "rings.csv") {
    return error_of([&] { read(text, 0.0, name); });
  }
  tests::TemporaryFolder folder_;
};

TEST_F(RingFiles, ATableWithItsOwnOrderAndOffsets) {
  const RingFile file = read(
      "RING NO.,POINT NO.,EASTING (M.),NORTHING (M.),ELEVATION (M.),OFFSET (M.),NUM. POINTS,,,\n"
      "0,1,671704.68,1507395.04,-26.0,0.038,8,,,\n0,2,671704.86,1507394.86,-26.7,,,,,\n",
      0.02);
  ASSERT_EQ(file.points.size(), 2U);
  EXPECT_EQ(file.points[0].ring, "0");
  EXPECT_NEAR(file.points[0].place.position.y(), 1507395.04, 1e-9);
  EXPECT_DOUBLE_EQ(file.points[0].place.target_offset_m, 0.038);
  EXPECT_DOUBLE_EQ(file.points[1].place.target_offset_m, 0.02);  // the job's
  ASSERT_EQ(file.findings.size(), 1U);
  EXPECT_EQ(read("7,a,1,2,3\n7,b,1,3,3,0.1\n").points[1].place.target_offset_m, 0.1);  // no header
}

TEST_F(RingFiles, PointsWithoutNamesAreNumberedInTheirRing) {
  const RingFile file = read("ring,east,north,elevation\n7,0,0,0\n7,1,0,0\n8,0,5,0\n");
  ASSERT_EQ(file.points.size(), 3U);
  EXPECT_EQ(file.points[1].point, "#2");
  EXPECT_EQ(file.points[2].point, "#1");
  EXPECT_EQ(read("ring,point,east,north,elevation\n7,,0,0,0\n7,a,1,0,0\n").points[0].point, "#1");
}

TEST_F(RingFiles, LandXmlGroupsAreRings) {
  const RingFile file = read(
      "<LandXML><Units><Metric linearUnit=\"millimeter\"/></Units><CgPoints name=\"12\"><CgPoint name=\"1\">2000 1000 "
      "500<Feature><Property label=\"targetOffset\" value=\"38\"/></Feature></CgPoint></CgPoints></LandXML>",
      0.0, "rings.xml");
  EXPECT_EQ(file.points.at(0).ring, "12");
  EXPECT_NEAR(file.points[0].place.position.x(), 1.0, 1e-12);
  EXPECT_NEAR(file.points[0].place.target_offset_m, 0.038, 1e-12);
}

TEST_F(RingFiles, BrokenOnesAreRefusedByPlace) {
  expect_words(refusal("ring,point,east,north,elevation\n1,1,0,0,0\n1,1,0,1,0\n"), {"rings.csv:3", "given twice"});
  expect_words(refusal("ring,point,east,north,elevation\n1,1,0,x,0\n"), {"rings.csv:2:7", "\"x\""});
  expect_words(refusal("ring,point,east,north,elevation,offset\n1,1,0,0,0,38\n"), {"half a metre"});
  expect_words(refusal("ring,north,elevation\n1,0,0\n"), {"lacks a column"});
  expect_words(refusal("ring,point,east,north,elevation\n,1,0,0,0\n"), {"no ring"});
  expect_words(refusal("# nothing\n"), {"no points of rings"});
  expect_words(refusal("<LandXML><Units><Metric linearUnit=\"meter\"/></Units></LandXML>", "r.xml"), {"no points"});
}

}  // namespace
}  // namespace adit::io
