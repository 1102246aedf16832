// Targets on paper and in simulated pictures, read again.
#include <gtest/gtest.h>

#include "core/foundation/error.h"
#include "core/georeference/detect_targets.h"
#include "core/simulation/camera_effects.h"
#include "render/camera_scene.h"
#include "render/gl_context.h"
#include "render/target_sheet.h"

namespace adit::render {
namespace {

std::vector<DetectedTarget> found_in(const GreyPicture& picture, double focal_px) {
  Progress progress;
  DetectOptions options;
  options.fit.focal_length_px = focal_px;
  return detect_targets(picture, options, progress);
}

TEST(TargetSheet, WhatIsDrawnOnPaperIsRead) {
  Canvas canvas = Canvas::raster(120.0, 60.0, 25.4 * 4.0);  // four pixels a millimetre
  draw_target(canvas, {30.0, 30.0}, 40.0, code_of_id(17));
  draw_target(canvas, {90.0, 28.0}, 40.0, code_of_id(3999));
  const Picture picture = canvas.finish_picture();
  GreyPicture grey(picture.width, picture.height);
  for (int v = 0; v < picture.height; ++v)
    for (int u = 0; u < picture.width; ++u) grey.pixels[grey.index(u, v)] = picture.pixel(u, v)[0];
  const auto found = found_in(grey, 1000.0);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, 17);
  EXPECT_NEAR(found[0].center.x(), 4.0 * 30.0 - 0.5, 0.15);
  EXPECT_NEAR(found[0].center.y(), 4.0 * 30.0 - 0.5, 0.15);
  EXPECT_NEAR(found[0].diameter_px, 160.0, 1.0);
  EXPECT_EQ(found[1].id, 3999);
}

TEST(TargetSheet, PagesAndBoardsFitTheirPaper) {
  std::vector<int> ids(30);
  for (int i = 0; i < 30; ++i) ids[static_cast<std::size_t>(i)] = i + 1;
  const std::string pages = target_pages(ids, 150.0, paper_size("A4"), {});
  EXPECT_EQ(pages.rfind("%PDF", 0), 0U);
  EXPECT_GT(pages.size(), 20000U) << "thirty pages";
  EXPECT_THROW(target_pages(ids, 160.0, paper_size("A4"), {}), Error);
  EXPECT_THROW(paper_size("B5"), Error);
  std::vector<int> on_board(36);
  for (int i = 0; i < 36; ++i) on_board[static_cast<std::size_t>(i)] = 101 + 2 * i;
  const TargetBoard board = target_board(on_board, 7, 5, 30.0, paper_size("A4"), {});
  ASSERT_EQ(board.centres_mm.size(), 35U);
  EXPECT_EQ(board.centres_mm[0], PaperPoint(0.0, 0.0));
  EXPECT_GT(board.centres_mm[6].x(), 6.0 * 33.0);
  EXPECT_LT(board.centres_mm[34].y(), -4.0 * 33.0) << "up is positive";
  EXPECT_THROW(target_board(on_board, 10, 10, 30.0, paper_size("A4"), {}), Error) << "too large";
  EXPECT_THROW(target_board(ids, 7, 5, 30.0, paper_size("A4"), {}), Error) << "thirty ids";
}

TEST(CameraScene, ATargetInThePictureStandsWhereTheLensPutsIt) {
  const auto context = make_osmesa_context();
  context->make_current();
  CameraLens lens;
  lens.width = 640;
  lens.height = 480;
  lens.fx = lens.fy = 520.0;
  lens.cx = 322.0;
  lens.cy = 236.0;
  lens.k1 = -0.15;
  lens.p1 = 0.001;
  CameraScene scene;
  for (int i = 0; i < 3; ++i) {
    SceneTarget target;
    target.code = code_of_id(5 + i);
    target.radius_m = 0.12;
    Pose camera_from_target = Pose::Identity();
    camera_from_target.linear() =
        rotation_from_vector({0.4 * (i - 1), 0.3, 0.0}) * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    camera_from_target.translation() = Eigen::Vector3d(0.7 * (i - 1), 0.35 * (i - 1), 1.8);
    target.site_from_target = camera_from_target;
    scene.targets.push_back(target);
  }
  const IdealSize size = ideal_size(lens, 3.0);
  CameraSceneView drawn(scene);
  PinholeView view;
  view.width = size.width;
  view.height = size.height;
  view.focal_px = size.focal_px;
  view.lamp_reach_m = 3.0;
  CameraEffects effects;
  effects.dust = 3;
  const GreyPicture picture = stored_picture(drawn.picture(view), size.focal_px, lens, effects);
  ASSERT_EQ(picture.width, 640);
  const auto found = found_in(picture, lens.focal_px());
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found[i].id, 5 + static_cast<int>(i));
    const Eigen::Vector2d truth = pixel_of(lens, scene.targets[i].site_from_target.translation());
    EXPECT_LT((found[i].center - truth).norm(), 0.15) << i;
    EXPECT_LT((found[i].center - truth).norm(), 5.0 * found[i].sigma_px) << i;
  }
}

}  // namespace
}  // namespace adit::render
