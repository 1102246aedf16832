#include "core/design/station_equations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/error.h"

namespace adit {
namespace {

TEST(StationEquations, WithoutEquationsTheStationIsTheChainage) {
  EXPECT_DOUBLE_EQ(StationEquations().displayed_m(1234.5), 1234.5);
}

TEST(StationEquations, AGapAnOverlapAndFallingStations) {
  const StationEquations stations({{100, 120, false}, {200, 210, false}, {300, 500, true}});
  EXPECT_DOUBLE_EQ(stations.displayed_m(99.5), 99.5);
  EXPECT_DOUBLE_EQ(stations.displayed_m(100), 120);  // ahead at the equation itself
  EXPECT_DOUBLE_EQ(stations.displayed_m(199), 219);
  EXPECT_DOUBLE_EQ(stations.back_m(1), 220);  // 210 to 220 occur twice
  EXPECT_DOUBLE_EQ(stations.displayed_m(205), 215);
  EXPECT_DOUBLE_EQ(stations.displayed_m(310), 490);
  EXPECT_DOUBLE_EQ(stations.back_m(0), 100);
}

TEST(StationEquations, ThoseThatGoBackAreRefused) {
  EXPECT_THROW(StationEquations({{100, 0, false}, {100, 5, false}}), Error);
  EXPECT_THROW(StationEquations({{100, 0, false}, {90, 5, false}}), Error);
  EXPECT_THROW(StationEquations({{std::nan(""), 0, false}}), Error);
}

}  // namespace
}  // namespace adit
