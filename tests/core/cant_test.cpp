#include "core/design/cant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/error.h"

namespace adit {
namespace {

TEST(Cant, RisesLinearlyAboutItsPivot) {
  const Cant cant({{0, 0, 0}, {50, 0.12, 0}, {100, 0.12, 0}}, 1.5);  // the right rail is the pivot
  EXPECT_DOUBLE_EQ(cant.at(25).cant_m, 0.06);
  EXPECT_DOUBLE_EQ(cant.at(25).rise_m, 0.03);
  EXPECT_NEAR(cant.at(75).turn_rad, std::asin(0.08), 1e-15);
  EXPECT_DOUBLE_EQ(cant.at(-10).cant_m, 0.0);
  EXPECT_DOUBLE_EQ(cant.at(500).cant_m, 0.12);
  EXPECT_DOUBLE_EQ(cant.strongest_m(10, 30), 0.072);
  EXPECT_DOUBLE_EQ(cant.strongest_m(10, 300), 0.12);
}

TEST(Cant, TransitionsFollowTheirLawAndSidesChangeThroughZero) {
  const Cant cant({{0, 0.05, -0.05, HorizontalKind::bloss}, {40, -0.05, 0.05}}, 1.5);
  EXPECT_NEAR(cant.at(20).cant_m, 0.0, 1e-15);
  EXPECT_NEAR(cant.at(10).cant_m, 0.1 * (1.0 - 2.0 * (3.0 / 16.0 - 2.0 / 64.0)), 1e-15);
  EXPECT_DOUBLE_EQ(cant.at(10).rise_m, 0.0);
}

TEST(Cant, AStepIsTwoStationsAtOnePlace) {
  const Cant cant({{0, 0, 0}, {10, 0, 0}, {10, 0.1, 0}, {20, 0.1, 0}}, 1.5);
  EXPECT_DOUBLE_EQ(cant.at(9.999).cant_m, 0.0);
  EXPECT_DOUBLE_EQ(cant.at(10).cant_m, 0.1);
}

TEST(Cant, WhatCannotBeIsRefused) {
  EXPECT_THROW(Cant({{0, 79, 0}}, 1.435), Error);  // millimetres for metres
  EXPECT_THROW(Cant({{10, 0, 0}, {5, 0, 0}}, 1.435), Error);
  EXPECT_THROW(Cant({{0, 0, 0}}, 0.0), Error);
}

}  // namespace
}  // namespace adit
