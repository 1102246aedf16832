#include "ui/navigation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace adit::ui {
namespace {

using render::Camera;

Camera oblique() {
  return render::oblique({{0.0, 0.0, 0.0}, {40.0, 10.0, 6.0}}, Eigen::Vector3d::UnitX(), 1.5);
}

double tilt(const Camera& camera) {
  return render::axes_of(camera).right.z();
}

TEST(Navigation, TurningKeepsDistanceAndHorizon) {
  Camera camera = oblique();
  const double distance = (camera.position - camera.focal_point).norm();
  for (int i = 0; i < 50; ++i) {
    camera = turned(camera, 37.0, i % 3 == 0 ? 80.0 : -90.0, 600.0);
    EXPECT_NEAR((camera.position - camera.focal_point).norm(), distance, 1e-9 * distance);
    EXPECT_NEAR(tilt(camera), 0.0, 1e-9);
    EXPECT_GE(render::axes_of(camera).up.z(), -1e-9) << "upside down";
  }
}

TEST(Navigation, AWholeTurnComesBack) {
  Camera camera = oblique();
  const Eigen::Vector3d start = camera.position;
  for (int i = 0; i < 12; ++i) camera = turned(camera, 100.0, 0.0, 600.0);
  EXPECT_NEAR((camera.position - start).norm(), 0.0, 1e-9 * start.norm());
}

TEST(Navigation, InsideTheHeadTurnsAndTheFeetStay) {
  const Camera camera = render::along_tunnel({5.0, 5.0, 2.0}, Eigen::Vector3d::UnitX());
  const Camera after = turned(camera, 120.0, 40.0, 600.0);
  EXPECT_EQ(after.position, camera.position);
  EXPECT_GT((after.focal_point - camera.focal_point).norm(), 0.1);
  EXPECT_NEAR(tilt(after), 0.0, 1e-9);
}

TEST(Navigation, WhatIsSeenFollowsTheMouse) {
  const Camera camera = oblique();
  const Eigen::Vector3d place(20.0, 5.0, 3.0);
  const Camera after = shifted(camera, 30.0, -20.0, 600.0);
  const auto before_px = render::pixel_of(camera, 900, 600, place);
  const auto after_px = render::pixel_of(after, 900, 600, place);
  EXPECT_NEAR(after_px->x() - before_px->x(), 30.0, 1e-6);
  EXPECT_NEAR(after_px->y() - before_px->y(), -20.0, 1e-6);
}

TEST(Navigation, TheWheelBringsNearerAndBack) {
  const Camera camera = oblique();
  EXPECT_LT(nearer(camera, 1.0).view_height_m, camera.view_height_m);
  EXPECT_NEAR(nearer(nearer(camera, 3.0), -3.0).view_height_m, camera.view_height_m, 1e-9);
  const Camera inside = render::along_tunnel({0.0, 0.0, 0.0}, Eigen::Vector3d::UnitX());
  EXPECT_GT(nearer(inside, 1.0).position.x(), 0.0);
}

}  // namespace
}  // namespace adit::ui
