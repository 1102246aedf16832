#include "render/scene.h"

#include <gtest/gtest.h>

#include "render/scene_view.h"
#include "tests/render/golden.h"

using namespace adit;
using namespace adit::render;

namespace {

// The square [-1, 1] x [-1, 1] at height 0.
SceneMesh square(const Colour& colour) {
  SceneMesh mesh;
  mesh.surface.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.colour = colour;
  return mesh;
}

Camera from_above(double height_m) {
  Camera camera;
  camera.position = {0, 0, 10};
  camera.focal_point = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.orthographic = true;
  camera.view_height_m = height_m;
  return camera;
}

Picture bare(const Scene& scene, const Camera& camera, int width, int height) {
  const auto context = make_osmesa_context();
  SceneView view(width, height);
  view.set_scene(scene);
  view.set_camera(camera);
  view.render();
  EXPECT_NE(view.texture(), 0U);
  return view.picture();
}

bool reddish(const std::array<std::uint8_t, 4>& p) {
  return p[0] > 200 && p[1] < 40 && p[2] < 40;
}
bool white(const std::array<std::uint8_t, 4>& p) {
  return p[0] == 255 && p[1] == 255 && p[2] == 255;
}

}  // namespace

TEST(Scene, RedSquareIsWhereItShouldBe) {
  Scene scene;
  scene.meshes.push_back(square({1.0, 0.0, 0.0}));
  const Picture picture =
      bare(scene, from_above(4.0), 200, 100);  // 25 pixels a metre, square from (75, 25) to (125, 75)
  for (int y : {27, 50, 73})
    for (int x : {77, 100, 123}) EXPECT_TRUE(reddish(picture.pixel(x, y))) << x << " " << y;
  for (auto [x, y] : {std::pair{72, 50}, {128, 50}, {100, 22}, {100, 78}})
    EXPECT_TRUE(white(picture.pixel(x, y))) << x << " " << y;
}

TEST(Scene, NearPointsHideFarOnes) {
  Scene scene;
  scene.meshes.push_back(square({1.0, 0.0, 0.0}));
  SceneCloud above, below;
  above.points = {{0.5F, 0.5F, 1.0F}};
  above.colour = {0.0, 0.0, 1.0};
  above.point_px = 5.0;
  below = above;
  below.points = {{-0.5F, -0.5F, -1.0F}};
  scene.clouds = {above, below};
  const Picture picture = bare(scene, from_above(4.0), 200, 100);
  const auto front = picture.pixel(112, 37);  // (0.5, 0.5)
  EXPECT_EQ(front[0], 0);
  EXPECT_EQ(front[2], 255);
  EXPECT_TRUE(reddish(picture.pixel(87, 62)));
}

TEST(Scene, DeviationsHaveTheColoursOfTheLegend) {
  Scene scene;
  SceneMesh mesh = square({});
  mesh.deviations_m = {0.45F, 0.45F, 0.45F, 0.45F};
  scene.meshes.push_back(mesh);
  scene.scale = DeviationScale{-0.2, 0.5, 0.1};
  const auto pixel = bare(scene, from_above(4.0), 100, 100).pixel(50, 50);
  const Colour expected = deviation_colour(*scene.scale, 0.45);
  EXPECT_NEAR(pixel[0], 255.0 * expected.red, 3.0);
  EXPECT_NEAR(pixel[1], 255.0 * expected.green, 3.0);
  EXPECT_NEAR(pixel[2], 255.0 * expected.blue, 3.0);
}

TEST(Scene, PixelOfAgreesWithThePicture) {
  Scene scene;
  SceneCloud cloud;
  cloud.points = {{1.0F, 12.0F, 2.0F}};
  cloud.colour = {0.0, 0.0, 0.0};
  cloud.point_px = 3.0;
  scene.clouds = {cloud};
  Camera camera = along_tunnel({0.0, 0.0, 1.5}, {0.1, 1.0, 0.0});
  const auto place = pixel_of(camera, 300, 200, cloud.points[0].cast<double>());
  ASSERT_TRUE(place);
  const Picture picture = bare(scene, camera, 300, 200);
  EXPECT_LT(picture.pixel(static_cast<int>(place->x()), static_cast<int>(place->y()))[0], 50);
  EXPECT_FALSE(pixel_of(camera, 300, 200, {0.0, -5.0, 1.5}));
}

TEST(Scene, TwoViewsAndAnotherSize) {
  const auto context = make_osmesa_context();
  Scene red, dark;
  red.meshes.push_back(square({1.0, 0.0, 0.0}));
  dark.dark = true;
  SceneView first(50, 50), second(40, 40);
  first.set_scene(red);
  first.set_camera(from_above(4.0));
  second.set_scene(dark);
  second.set_camera(from_above(4.0));
  first.render();
  second.render();
  EXPECT_TRUE(reddish(first.picture().pixel(25, 25)));
  EXPECT_LT(second.picture().pixel(20, 20)[0], 60);
  first.resize(120, 80);
  first.render();
  const Picture picture = first.picture();
  EXPECT_EQ(picture.width, 120);
  EXPECT_TRUE(reddish(picture.pixel(60, 40)));
  EXPECT_TRUE(white(picture.pixel(20, 40)));
}

TEST(Scene, EmptySceneIsWhite) {
  const Picture picture = bare({}, from_above(4.0), 64, 64);
  EXPECT_TRUE(white(picture.pixel(0, 0)));
  EXPECT_TRUE(white(picture.pixel(32, 32)));
}

TEST(Scene, LabelsAndSigns) {
  Scene scene;
  SceneMesh mesh = square({});
  mesh.deviations_m = {-0.15F, 0.05F, 0.45F, 0.05F};
  scene.meshes.push_back(mesh);
  scene.scale = DeviationScale{-0.2, 0.5, 0.1};
  scene.labels = {{{-0.5, 0.2, 0.1}, "S1 Nord-Süd", true}, {{0.6, -0.6, 0.1}, "118.0", false}};
  scene.lines = {{{{-1.5, 0, 0.1}, {1.5, 0, 0.1}}, colours::ink_blue, 2.0}};
  SceneCloud cloud;
  cloud.name = "S1";
  cloud.colour = scan_colour(0);
  for (int i = 0; i < 50; ++i) cloud.points.emplace_back(-1.4F, -1.0F + 0.04F * static_cast<float>(i), 0.0F);
  scene.clouds = {cloud};
  scene.name_clouds = true;
  const auto context = make_osmesa_context();
  EXPECT_TRUE(tests::like_golden(draw_scene(scene, from_above(3.0), 900, 450, *context), "scene"));
}

TEST(Camera, TopViewHoldsAllPointsWithTheHeadingToTheRight) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {50, 50, 5}, {48, 52, 2}, {2, -2, 7}};
  const Camera camera = top_view(points, {1, 1, 0.1}, 2.0);
  for (const auto& p : points) {
    const auto pixel = pixel_of(camera, 800, 400, p);
    ASSERT_TRUE(pixel);
    EXPECT_GT(pixel->x(), 0.0);
    EXPECT_LT(pixel->x(), 800.0);
    EXPECT_GT(pixel->y(), 0.0);
    EXPECT_LT(pixel->y(), 400.0);
  }
  EXPECT_GT(pixel_of(camera, 800, 400, points[1])->x(), pixel_of(camera, 800, 400, points[0])->x() + 600.0);
  // The left of the heading is up.
  EXPECT_LT(pixel_of(camera, 800, 400, points[2])->y(), pixel_of(camera, 800, 400, points[3])->y());
}
