#include "io/profile_json.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/angle.h"
#include "io/expression.h"
#include "io/read_profile.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

TEST(Expression, CountsAsOneWrites) {
  const std::map<std::string, double> sizes{{"width", 9.0}, {"r_1", 2.0}};
  EXPECT_DOUBLE_EQ(evaluate("1 + 2 * 3 - 4 / 2", sizes), 5.0);
  EXPECT_DOUBLE_EQ(evaluate("-width/2", sizes), -4.5);
  EXPECT_DOUBLE_EQ(evaluate("(1 + r_1) * -2", sizes), -6.0);
  EXPECT_DOUBLE_EQ(evaluate("sqrt(width) + sin(30) + cos(60) + tan(45)", sizes), 5.0);
  EXPECT_DOUBLE_EQ(evaluate("1e-3 * 2.5", sizes), 0.0025);
}

TEST(Expression, RefusesWhatIsNone) {
  const auto said = [](const std::string& formula) { return error_of([&] { evaluate(formula, {{"a", 0.0}}); }); };
  expect_words(said("b + 1"), {"\"b\"", "no size"});
  expect_words(said("1 +"), {"lacks a number"});
  expect_words(said("(1"), {"closing bracket"});
  expect_words(said("1 2"), {"where an operator belongs"});
  expect_words(said("1/a"), {"divides by zero"});
  expect_words(said("sqrt(-1)"), {"negative"});
  expect_words(said("exp(1)"), {"\"exp\""});
  expect_words(said(std::string(200, '(') + "1"), {"too deep"});
}

TEST(ProfileLibrary, EveryFileHasTheAreaOfItsFormula) {
  EXPECT_NEAR(library_profile("rectangle", {{"width", 4}, {"height", 3}}).area_m2(), 12.0, 1e-9);
  EXPECT_NEAR(library_profile("circle", {{"radius", 3.2}}).area_m2(), pi * 3.2 * 3.2, 1e-9);
  EXPECT_NEAR(library_profile("d_shape", {{"width", 9}, {"wall_height", 2}}).area_m2(), 18 + pi * 4.5 * 4.5 / 2, 1e-9);
  // A segment of a circle of 9.25 m chord rise: r = (w^2/4 + f^2) / (2 f).
  const double f = 2.0, w = 6.0, r = (w * w / 4 + f * f) / (2 * f), half = std::asin(w / 2 / r);
  EXPECT_NEAR(library_profile("arch", {{"width", w}, {"wall_height", 3}, {"height", 5}}).area_m2(),
              w * 3 + r * r * (half - std::sin(half) * std::cos(half)), 1e-9);
  for (const char* name : {"horseshoe_3", "horseshoe_5"}) {
    const Profile profile = library_profile(name, {});
    EXPECT_EQ(profile.corners().size(), 2U) << name;  // where the walls meet the floor: all arcs meet tangents
    EXPECT_NEAR(profile.box().max().x(), -profile.box().min().x(), 1e-9);
    EXPECT_NEAR(profile.box().min().y(), 0.0, 1e-9);
  }
  EXPECT_NEAR(library_profile("horseshoe_3", {}).box().max().y(), 7.0, 1e-9);
  EXPECT_EQ(library_profiles().size(), 6U);
}

TEST(ProfileLibrary, SaysWhatItHas) {
  expect_words(error_of([] { library_profile("oval", {}); }), {"\"oval\"", "d_shape", "horseshoe_5"});
  expect_words(error_of([] { library_profile("circle", {{"width", 3}}); }), {"no size \"width\"", "radius 3"});
  expect_words(error_of([] { library_profile("arch", {{"width", -3}}); }), {"arch", "width is -3", "at least 0.1"});
  expect_words(error_of([] { library_profile("arch", {{"height", 2}}); }), {"height is 2", "at least 3"});
  EXPECT_NO_THROW(library_profile("horseshoe_3", {{"crown_center_height", 0}}));
  expect_words(error_of([] { library_profile("horseshoe_3", {{"side_radius", 0.5}}); }), {"horseshoe_3"});
}

TEST(ProfileJson, LinesAndArcsInEveryWayOfSaying) {
  const tests::TemporaryFolder folder;
  const auto area = [&](const std::string& arc) {
    return read_profile(folder.write("p.json", R"({"start": [-2, 0], "pieces": [{"line": [-2, 1]}, {"arc": [2, 1], )" +
                                                   arc + R"(}, {"line": [2, 0]}, {"line": [-2, 0]}]})"))
        .area_m2();
  };
  EXPECT_NEAR(area(R"("through": [0, 3])"), 4 + 2 * pi, 1e-9);
  EXPECT_NEAR(area(R"("bulge": -1)"), 4 + 2 * pi, 1e-9);
  EXPECT_NEAR(area(R"("center": [0, -1])"), 4 + 8 * (std::asin(1 / std::sqrt(2.0)) - 0.5), 1e-9);
  // Hollow: a segment of a circle of chord 4 and rise 0.5 is missing.
  const double r = (4.0 + 0.25) / 1.0, half = std::asin(2.0 / r);
  EXPECT_NEAR(area(R"("through": [0, 0.5])"), 4.0 - r * r * (half - std::sin(half) * std::cos(half)), 1e-9);
}

TEST(ProfileJson, RefusalsNameTheKey) {
  const tests::TemporaryFolder folder;
  const auto said = [&](const std::string& json) {
    return error_of([&] { read_profile(folder.write("p.json", json)); });
  };
  expect_words(said(R"({"start": [0, 0], "pieces": [{"curve": [1, 1]}]})"), {"p.json", "pieces[0]", "curve"});
  expect_words(said(R"({"start": [0, 0], "pieces": [{"arc": [1, 1]}]})"), {"pieces[0]", "one of"});
  expect_words(said(R"({"start": ["w", 0], "pieces": []})"), {"start", "\"w\"", "no size"});
  expect_words(said(R"({"start": [0, 0], "pieces": [{"line": [1, 0]}, {"line": [1, 1]}]})"), {"p.json"});
  expect_words(said(R"({"start": [0, 0], "pieces": [{"arc": [2, 0], "center": [0.5, 0]}]})"), {"as far"});
  expect_words(error_of([&] {
                 read_profile(folder.write("p.csv", "offset,height\n"), {}, {{"w", 1}});
               }),
               {"only a .json"});
}

}  // namespace
}  // namespace adit::io
