#include "io/xyz.h"

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::HasSubstr;

TEST(Xyz, RoundTripKeepsEveryBit) {
  const tests::TemporaryFolder folder;
  for (const std::string name : {"s.xyz", "s.csv", "s.txt"}) {
    const ScanData scan = tests::sample_scan(3'000);
    tests::write_one(folder / name, scan);
    const ScanData read = tests::read_one(folder / name);
    EXPECT_EQ(read.cloud.points, scan.cloud.points);
    EXPECT_EQ(read.cloud.intensity, scan.cloud.intensity);
    EXPECT_EQ(read.cloud.colour, scan.cloud.colour);
    EXPECT_EQ(read.cloud.normals, scan.cloud.normals);
  }
  EXPECT_THAT(tests::bytes_of(folder / "s.csv"), testing::StartsWith("x,y,z,intensity,r,g,b,nx,ny,nz\n"));
}

TEST(Xyz, SiteCoordinatesKeepTenthOfMillimetre) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan_at_site(3'000);
  tests::write_one(folder / "s.xyz", scan);
  EXPECT_LT(tests::largest_distance_m(tests::read_one(folder / "s.xyz"), scan), 1e-4);
}

ScanData read_text(const std::string& text) {
  const tests::TemporaryFolder folder;
  return tests::read_one(folder.write("a.txt", text));
}

TEST(Xyz, SeparatorsAndNamesOfEveryKind) {
  for (const char* text : {"1 2 3\n",
                           "1,2,3\n",
                           "1;2;3\n",
                           "1\t2\t3\n",
                           "  1   2  3  \n",
                           "1 , 2 , 3\n",
                           "1, 2, 3\r\n",
                           "1;2;3;\n",
                           "\xEF\xBB\xBFx y z\n1 2 3\n",
                           "X,Y,Z\n1,2,3\n",
                           "\"X\",\"Y\",\"Z\"\n1 2 3\n",
                           "y z x\n2 3 1\n",
                           "Easting;Northing;Elevation\n1;2;3\n",
                           "northing,id,easting,height\n2,P1,1,3\n",
                           "# x y z\n1 2 3\n",
                           "//X,Y,Z\n1,2,3\n",
                           "# made by a scanner\n\n1 2 3\n# end\n",
                           "1 2 3 77 88\n",
                           "x [m],y [m],z (m)\n1,2,3\n",
                           "# x y z of what was seen\n1 2 3\n",
                           "X\tY\tZ\n1\t2\t3\n",
                           "x,y,z\n\n\n+1,2.0,3e0\n"}) {
    const ScanData scan = read_text(text);
    ASSERT_EQ(scan.cloud.size(), 1U) << text;
    EXPECT_EQ(scan.cloud.points[0], Eigen::Vector3f(1, 2, 3)) << text;
    EXPECT_FALSE(scan.cloud.has_intensity()) << text;
  }
}

TEST(Xyz, NamedAttributesAreRead) {
  const ScanData scan = read_text("//X Y Z R G B Intensity Nx Ny Nz\n1 2 3 10 20 30 -0.5 0 0 1\n");
  EXPECT_EQ(scan.cloud.intensity[0], -0.5F);
  EXPECT_EQ(scan.cloud.colour[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
  EXPECT_EQ(scan.cloud.normals[0], Eigen::Vector3f(0, 0, 1));
  EXPECT_FALSE(read_text("x y z r g\n1 2 3 4 5\n").cloud.has_colour());
}

std::string refused(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  return tests::refusal(folder.write("bad.csv", bytes));
}

TEST(Xyz, RefusesWhatIsBroken) {
  EXPECT_THAT(refused("X,Y,X\n1,2,3\n"), HasSubstr("bad.csv:1: a point or the column names x, y and z are needed"));
  EXPECT_THAT(refused("x,y,z,X\n1,2,3,4\n"), HasSubstr("bad.csv:1:7: a second column for \"X\""));
  EXPECT_THAT(refused("Some words about a survey\n1 2 3\n"), HasSubstr("column names x, y and z are needed"));
  EXPECT_THAT(refused("x[mm],y[mm],z[mm]\n1,2,3\n"), HasSubstr("coordinates in \"mm\"; export in metres"));
  EXPECT_THAT(refused("x,y,z\n1,2,3\n4,5\n"), HasSubstr("bad.csv:3: the line has 2 columns, 3 are expected"));
  EXPECT_THAT(refused("x,y,z\n1,2,3,4\n"), HasSubstr("bad.csv:2: the line has 4 columns, 3 are expected"));
  EXPECT_THAT(refused("1 2 3\n4 5 six\n"), HasSubstr("bad.csv:2:5: a number is needed, found \"six\""));
  EXPECT_THAT(refused("1,5;2,5;3,5\n"),
              HasSubstr("bad.csv:1:1: a number is needed, found \"1,5\"; write a decimal point, not a comma"));
  EXPECT_THAT(refused("1,5 2,5 3,5\n"), HasSubstr("write a decimal point, not a comma"));
  EXPECT_THAT(refused("1,5\t2,5\t3,5\n"), HasSubstr("write a decimal point, not a comma"));
  EXPECT_THAT(refused("1000\n1 2 3\n"), HasSubstr("bad.csv:1: a point needs x, y and z"));
  EXPECT_THAT(refused("1 2\n"), HasSubstr("a point needs x, y and z"));
  EXPECT_THAT(refused("1 2 3\nnan 2 3\n"), HasSubstr("bad.csv:2: a point is not finite"));
  EXPECT_THAT(refused("x y z\n"), HasSubstr("the file holds no points"));
  EXPECT_THAT(refused("# nothing\n"), HasSubstr("the file holds no points"));
  EXPECT_THAT(refused("x y z r g b\n1 2 3 0 0 300\n"),
              HasSubstr("a whole number from 0 to 255 is needed, found \"300\""));
  EXPECT_THAT(refused("0 0 0\n600000 0 0\n"), HasSubstr("the points lie 600 km apart"));
  EXPECT_THAT(refused("1e15 0 0\n"), HasSubstr("is no site coordinate"));
}

}  // namespace
}  // namespace adit::io
