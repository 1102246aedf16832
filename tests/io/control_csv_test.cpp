#include "io/control_csv.h"

#include <gtest/gtest.h>

#include "io/targets_csv.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

class SurveyTables : public ::testing::Test {
 protected:
  std::vector<ControlPoint> control(const std::string& text) {
    return read_control_csv(folder_.write("control.csv", text));
  }
  std::vector<TargetObservation> targets(const std::string& text) {
    return read_targets_csv(folder_.write("targets.csv", text));
  }
  std::string control_refusal(const std::string& text) {
    return error_of([&] { control(text); });
  }
  std::string targets_refusal(const std::string& text) {
    return error_of([&] { targets(text); });
  }
  tests::TemporaryFolder folder_;
};

TEST_F(SurveyTables, ControlInAnyOfTheUsualForms) {
  for (const char* text :
       {"id,east,north,elevation\nP1,612345.125,6998765.5,412.0\n", "P1;612345.125;6998765.5;412.0",
        "# site\r\n\r\nP1\t612345.125\t6998765.5\t412\r\n", "Name, X, Y, Z\nP1 , 612345.125 , 6998765.5 , 412,\n"}) {
    const auto points = control(text);
    ASSERT_EQ(points.size(), 1U) << text;
    EXPECT_EQ(points[0].id, "P1");
    EXPECT_EQ(points[0].position, Eigen::Vector3d(612345.125, 6998765.5, 412.0));
  }
}

TEST_F(SurveyTables, ControlThereAndBack) {
  const std::vector<ControlPoint> points{
      {"1001", {2683026.060271, 1251466.930252, 412.5}}, {"north wall, 2", {-1, -2.5, 0}}, {"#3", {0, 0, 0}}};
  const auto back = control(control_csv_text(points));
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back[i].id, points[i].id);
    EXPECT_LT((back[i].position - points[i].position).norm(), 1e-6);
  }
  EXPECT_NE(error_of([] { control_csv_text({{"a\"b", {0, 0, 0}}}); }), "");
}

TEST_F(SurveyTables, ControlRefusals) {
  expect_words(control_refusal("id,east,north,elevation\nP1,1,4l2.0,3\n"),
               {"control.csv:2:6", "a number is needed, found \"4l2.0\""});
  expect_words(control_refusal("P1;1,5;2;3\n"), {"control.csv:1:4", "decimal point"});
  expect_words(control_refusal("P1,1,2,nan\n"), {"\"nan\""});
  expect_words(control_refusal("P1,1,2\n"), {"control.csv:1", "3 fields", "id,east,north,elevation"});
  expect_words(control_refusal("P1,1,2,3\nP2,1,2,3\n# same again\nP1,4,5,6\n"),
               {"control.csv:4", "\"P1\"", "twice", "line 1"});
  expect_words(control_refusal("id,north,east,elevation\nP1,1,2,3\n"),
               {"control.csv:1", "\"north\"", "id,east,north,elevation"});
  expect_words(control_refusal(",1,2,3\n"), {"no id"});
  expect_words(control_refusal("P1,1,1e160,3\n"), {"control.csv:1:6", "beyond 100,000 km"});
  expect_words(control_refusal("# nothing\n"), {"no control points"});
  expect_words(error_of([&] { read_control_csv(folder_ / "absent.csv"); }), {"absent.csv"});
}

TEST_F(SurveyTables, TargetsThereAndBack) {
  const std::vector<TargetObservation> seen{{"S1", "T1", {1.25, -2, 0.5}}, {"S2", "T1", {4, 5, 6}}};
  const auto back = targets(targets_csv_text(seen));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[1].scan, "S2");
  EXPECT_EQ(back[1].id, "T1");
  EXPECT_EQ(back[0].position, seen[0].position);
}

TEST_F(SurveyTables, TargetRefusals) {
  expect_words(targets_refusal("S1,T1,1,2,3\nS1,T1,1,2,3\n"), {"targets.csv:2:4", "\"T1\" of scan \"S1\"", "line 1"});
  expect_words(targets_refusal("scan,id,x,y,z\nS1,T1,1,b,3\n"), {"targets.csv:2:9", "\"b\""});
  expect_words(targets_refusal("id,scan,x,y,z\nT1,S1,1,2,3\n"), {"targets.csv:1", "\"id\""});
  expect_words(targets_refusal("S1,T1,1,2\n"), {"4 fields"});
  expect_words(targets_refusal(""), {"no targets"});
}

}  // namespace
}  // namespace adit::io
