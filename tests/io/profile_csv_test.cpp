#include "io/profile_csv.h"

#include <gtest/gtest.h>

#include "core/foundation/angle.h"
#include "io/read_profile.h"
#include "tests/core/profile_shapes.h"
#include "tests/io/error_words.h"
#include "tests/real_data.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

class ProfileTable : public ::testing::Test {
 protected:
  Profile read(const std::string& text) { return read_profile_csv(folder_.write("profile.csv", text)); }
  std::string refusal(const std::string& text) {
    return error_of([&] { read(text); });
  }
  tests::TemporaryFolder folder_;
};

TEST_F(ProfileTable, PointsInAnyOfTheUsualForms) {
  for (const char* text :
       {"offset,height\n-1,0\n-1,3\n1,3\n1,0\n-1,0\n", "-1;0\n-1;3\n1;3\n1;0\n", "# box\n-1 0\n-1 3\n\n1 3\n1 0",
        "x\tz\tbulge\r\n1\t0\t0\r\n1\t3\t0\r\n-1\t3\r\n-1\t0\r\n"}) {
    EXPECT_NEAR(read(text).area_m2(), 6.0, 1e-12) << text;
  }
}

TEST_F(ProfileTable, ABulgeBelongsToTheSegmentThatFollows) {
  const Profile arch = read("3,0\n3,2,1\n-3,2\n-3,0\n");  // counter-clockwise, half a circle over the walls
  EXPECT_NEAR(arch.area_m2(), 12 + pi * 9 / 2, 1e-12);
  EXPECT_EQ(arch.name(), "profile");
}

TEST_F(ProfileTable, ThereAndBack) {
  const Profile profile("a", shapes::horseshoe());
  const Profile back = read(profile_csv_text(profile));
  EXPECT_NEAR(back.area_m2(), profile.area_m2(), 1e-8);
  for (double p = -10; p < 10; p += 0.3) EXPECT_LT((back.at(p).position - profile.at(p).position).norm(), 1e-7);
}

TEST_F(ProfileTable, Refusals) {
  expect_words(refusal("offset,height\n-1,0\n-1,3\n1,3x\n"), {"profile.csv:4:3", "\"3x\""});
  expect_words(refusal("height,offset\n0,-1\n3,-1\n3,1\n"), {"profile.csv:1", "\"height\"", "offset,height"});
  expect_words(refusal("1,2,3,4\n"), {"4 fields"});
  expect_words(refusal("0,0\n2,2\n2,0\n0,2\n"), {"profile.csv", "crosses", "segment 1 meets segment 3"});
  expect_words(refusal("0,0\n"), {"no line"});
  expect_words(error_of([&] { read_profile(folder_ / "absent.csv"); }), {"absent.csv"});
}

TEST_F(ProfileTable, TheDoorRefusesOtherEndingsAndMillimetres) {
  folder_.write("profile.txt", "-1 0\n-1 3\n1 3\n1 0\n");
  EXPECT_NEAR(read_profile(folder_ / "profile.txt").area_m2(), 6.0, 1e-12);
  expect_words(error_of([&] { read_profile(folder_ / "profile.svg"); }), {"\".svg\"", ".dxf"});
  folder_.write("mm.csv", "-1000,0\n-1000,3000\n1000,3000\n1000,0\n");
  expect_words(error_of([&] { read_profile(folder_ / "mm.csv"); }), {"2000 m wide", "unit"});
}

TEST(ProfilesData, TheCorridorIsARectangleOfItsSize) {
  ADIT_NEED_REAL_DATA();
  const Profile profile = read_profile(tests::real_data() / "corridor/profile.csv");
  EXPECT_NEAR(profile.area_m2(), 2.5 * 2.9, 1e-12);
  EXPECT_EQ(profile.corners().size(), 4U);
}

TEST(ProfilesData, PointsThatAreNotInOrderAroundTheLineAreRefusedWithThePlace) {
  ADIT_NEED_REAL_DATA();
  // Digitised points sorted by offset, with comments in GBK: a cloud of points, not a line.
  const auto folder = tests::real_data() / "profiles/maoliling/Examples";
  for (const char* file : {"ExamplesOne/design curve data for tunnel after first lining.txt",
                           "ExamplesTwo/design curve data for tunnel after secondary lining.txt"}) {
    expect_words(error_of([&] { read_profile(folder / file); }),
                 {"lining.txt", "crosses or touches itself", "segment", "without crossing"});
  }
}

}  // namespace
}  // namespace adit::io
