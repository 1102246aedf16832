#include "core/georeference/camera_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/georeference/calibrate_camera.h"
#include "core/georeference/posit.h"

namespace adit {
namespace {

CameraLens lens_of(double distortion = 1.0) {
  CameraLens lens;
  lens.width = 1280;
  lens.height = 800;
  lens.fx = 1010.0;
  lens.fy = 1004.0;
  lens.cx = 645.0;
  lens.cy = 391.0;
  lens.k1 = -0.12 * distortion;
  lens.k2 = 0.05 * distortion;
  lens.p1 = 0.0008 * distortion;
  lens.p2 = -0.0005 * distortion;
  return lens;
}

const Eigen::Vector3d origin(612345.0, 6998765.0, 412.0);

/// A camera that looks north along a tunnel, and targets on its walls and roof ahead.
struct Scene {
  CameraLens lens = lens_of();
  Pose site_from_camera = Pose::Identity();
  std::vector<LandmarkSight> sights;

  explicit Scene(int count, double noise_px = 0.0, std::uint64_t seed = 1, bool flat = false) {
    const Random random(seed, 5);
    std::uint64_t k = 0;
    Eigen::Matrix3d looking_north;  // camera x east, y down, z north
    looking_north << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
    site_from_camera.linear() = rotation_from_vector({random.uniform(k, -0.1, 0.1), random.uniform(k + 1, -0.1, 0.1),
                                                      random.uniform(k + 2, -0.2, 0.2)}) *
                                looking_north;
    k += 3;
    site_from_camera.translation() = origin + Eigen::Vector3d(random.uniform(k++, -1.0, 1.0), 0.0, 1.6);
    while (static_cast<int>(sights.size()) < count) {
      const double turn = random.uniform(k++, -1.9, 1.9), ahead = flat ? 9.0 : random.uniform(k++, 4.0, 14.0);
      LandmarkSight sight;
      sight.id = std::to_string(sights.size() + 1);
      sight.site = origin + Eigen::Vector3d((flat ? random.uniform(k++, 1.0, 4.0) : 4.0) * std::sin(turn), ahead,
                                            1.5 + 3.0 * std::cos(turn));
      const Eigen::Vector3d at = site_from_camera.inverse() * sight.site;
      if (at.z() < 1.0) continue;
      const Eigen::Vector2d pixel = pixel_of(lens, at);
      if (pixel.x() < 20 || pixel.y() < 20 || pixel.x() > 1260 || pixel.y() > 780) continue;
      sight.pixel = pixel + noise_px * Eigen::Vector2d(random.normal(k), random.normal(k + 1));
      k += 2;
      sight.sigma_px = std::max(0.02, noise_px);
      sights.push_back(sight);
    }
  }
  double off_m(const Pose& pose) const { return distance_between_m(pose, site_from_camera); }
  double off_rad(const Pose& pose) const { return rotation_between_rad(pose, site_from_camera); }
};

TEST(CameraLens, ThereAndBackAndItsDerivative) {
  const CameraLens lens = lens_of();
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.1, -0.2, 1.0), Eigen::Vector3d(3.0, 1.5, 5.0), Eigen::Vector3d(-2.0, 1.1, 4.0)}) {
    const Eigen::Vector2d pixel = pixel_of(lens, point);
    const auto place = place_of(lens, pixel);
    ASSERT_TRUE(place);
    EXPECT_LT((*place - point.head<2>() / point.z()).norm(), 1e-9);
    const auto derivative = pixel_derivative(lens, point);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d by = 1e-6 * Eigen::Vector3d::Unit(k);
      const Eigen::Vector2d numeric = (pixel_of(lens, point + by) - pixel_of(lens, point - by)) / 2e-6;
      EXPECT_LT((derivative.col(k) - numeric).norm(), 1e-4);
    }
  }
  CameraLens strong = lens;
  strong.k1 = -2.0;
  EXPECT_FALSE(place_of(strong, {5.0, 5.0})) << "beyond where the distortion turns back";
  CameraLens millimetres = lens;
  millimetres.fx = millimetres.fy = 4.2;
  EXPECT_THROW(check_lens(millimetres), Error);
}

TEST(Posit, ExactPointsGiveTheExactPose) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(8, 0.0, seed);
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> places;
    for (const LandmarkSight& sight : scene.sights) {
      points.push_back(sight.site - origin);
      places.push_back(*place_of(scene.lens, sight.pixel));
    }
    const auto poses = posit(points, places);
    ASSERT_EQ(poses.size(), 1U) << seed;
    Pose pose = poses[0].camera_from_site;
    pose.translation() -= pose.linear() * origin;
    EXPECT_LT(scene.off_m(pose.inverse()), 1e-5) << seed;
    EXPECT_LT(scene.off_rad(pose.inverse()), 1e-6) << seed;
  }
}

TEST(Posit, APlaneLeavesTwoPosesAndALineNone) {
  std::vector<Eigen::Vector3d> points{{-1, -1, 0}, {1.2, -0.8, 0}, {0.9, 1.1, 0}, {-1.1, 0.7, 0}, {0.2, 0.3, 0}};
  std::vector<Eigen::Vector2d> places;
  Pose truth = Pose::Identity();
  truth.linear() = rotation_from_vector({0.5, 0.15, 0.3});
  truth.translation() = Eigen::Vector3d(0.1, -0.2, 9.0);
  for (const Eigen::Vector3d& point : points) places.push_back((truth * point).hnormalized());
  const auto poses = posit(points, places);
  ASSERT_GE(poses.size(), 1U);
  EXPECT_LT(distance_between_m(poses[0].camera_from_site, truth), 1e-8);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = Eigen::Vector3d(0.5 * static_cast<double>(i), 5.0, 1.0);
  EXPECT_TRUE(posit(points, places).empty()) << "on a line";
  points.resize(3);
  places.resize(3);
  EXPECT_TRUE(posit(points, places).empty());
}

TEST(CameraPose, ErrorsAreAsTheSigmasSay) {
  double squares = 0.0;
  constexpr int scenes = 60;
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    Scene scene(8, 0.1, seed);
    CameraPoseOptions options;
    options.landmark_sigma_m = options.lens_sigma_px = 0.0;
    const CameraPose pose = locate_camera(scene.lens, scene.sights, options);
    EXPECT_EQ(pose.used(), 8U);
    Vector6d off;
    off.head<3>() = pose.site_from_camera.translation() - scene.site_from_camera.translation();
    off.tail<3>() = rotation_vector(pose.site_from_camera.linear() * scene.site_from_camera.linear().transpose());
    EXPECT_LT(off.head<3>().norm(), 0.02);
    EXPECT_LT(deg_from_rad(off.tail<3>().norm()), 0.1);
    const double factor = std::max(1.0, pose.sigma_factor);
    squares += off.dot((pose.covariance / (factor * factor)).inverse() * off) / 6.0;
  }
  EXPECT_NEAR(std::sqrt(squares / scenes), 1.0, 0.15);
}

TEST(CameraPose, TargetsInAPlane) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Scene scene(6, 0.0, seed, true);
    const CameraPose pose = locate_camera(scene.lens, scene.sights, {});
    EXPECT_TRUE(pose.flat);
    EXPECT_LT(scene.off_m(pose.site_from_camera), 1e-5) << seed;
  }
}

TEST(CameraPose, AMovedTargetAndWrongIdsAreNamedAndNotUsed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scene scene(8, 0.1, seed);
    scene.sights[2].site.x() += 0.2;                        // moved since it was surveyed
    std::swap(scene.sights[5].site, scene.sights[6].site);  // exchanged in the database
    const CameraPose pose = locate_camera(scene.lens, scene.sights, {});
    EXPECT_FALSE(pose.landmarks[2].used) << seed;
    EXPECT_FALSE(pose.landmarks[5].used) << seed;
    EXPECT_FALSE(pose.landmarks[6].used) << seed;
    EXPECT_EQ(pose.used(), 5U) << seed;
    EXPECT_LT(scene.off_m(pose.site_from_camera), 0.03) << seed;
    EXPECT_GT(pose.landmarks[2].across_m, 0.03) << seed;
    ASSERT_FALSE(pose.findings.empty());
    EXPECT_EQ(pose.findings[0].subject, "target 3");
  }
}

TEST(CameraPose, WrongOnesThatFitByChanceGiveNoPose) {
  std::size_t refused = 0, doubted = 0;
  constexpr std::uint64_t scenes = 20;
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    Scene exchanged(12, 0.1, seed), zoomed(12, 0.1, seed), four(4, 0.1, seed);
    for (LandmarkSight& sight : exchanged.sights) std::swap(sight.site.x(), sight.site.y());
    EXPECT_THROW(locate_camera(exchanged.lens, exchanged.sights, {}), Error) << seed;
    zoomed.lens.fx *= 1.3;
    zoomed.lens.fy *= 1.3;
    try {
      const CameraPose pose = locate_camera(zoomed.lens, zoomed.sights, {});
      EXPECT_GT(pose.used(), 7U) << seed;  // those that are left out are fewer
    } catch (const Error&) {
      ++refused;
    }
    four.sights[1].site.x() += 0.2;
    try {
      const CameraPose pose = locate_camera(four.lens, four.sights, {});
      doubted += std::any_of(pose.findings.begin(), pose.findings.end(),
                             [](const Finding& finding) { return finding.severity == Severity::decision; });
    } catch (const Error&) {
      ++doubted;
    }
  }
  EXPECT_EQ(refused, scenes);
  EXPECT_GE(doubted, scenes - 2);  // four have two observations too many: a move may hide
}

/// Pictures of a board of 7 x 5 targets, 40 mm apart, held before the camera in many ways.
std::vector<BoardPicture> board_pictures(const CameraLens& lens, int count, double most_tilt_rad, double noise_px) {
  const Random random(4, 9);
  std::uint64_t k = 0;
  std::vector<BoardPicture> pictures;
  for (int i = 0; i < count; ++i) {
    Pose pose = Pose::Identity();
    pose.linear() =
        rotation_from_vector({random.uniform(k, -most_tilt_rad, most_tilt_rad),
                              random.uniform(k + 1, -most_tilt_rad, most_tilt_rad), random.uniform(k + 2, -0.5, 0.5)});
    pose.translation() = Eigen::Vector3d(random.uniform(k + 3, -0.25, 0.05), random.uniform(k + 4, -0.2, 0.05),
                                         random.uniform(k + 5, 0.28, 0.4));
    k += 6;
    BoardPicture picture{"board " + std::to_string(i), {}};
    for (int c = 0; c < 7; ++c)
      for (int r = 0; r < 5; ++r) {
        const Eigen::Vector3d board(0.04 * c, 0.04 * r, 0.0);
        const Eigen::Vector2d pixel = pixel_of(lens, pose * board);
        if (pixel.x() < 10 || pixel.y() < 10 || pixel.x() > lens.width - 10 || pixel.y() > lens.height - 10) continue;
        picture.sights.push_back({board, pixel + noise_px * Eigen::Vector2d(random.normal(k), random.normal(k + 1))});
        k += 2;
      }
    pictures.push_back(picture);
  }
  return pictures;
}

TEST(CalibrateCamera, TheLensWithinItsSigmas) {
  const CameraLens lens = lens_of();
  const CameraCalibration found = calibrate_camera(board_pictures(lens, 20, 0.7, 0.05), lens.width, lens.height);
  EXPECT_NEAR(found.rms_px, 0.05 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(found.lens.fx, lens.fx, 4.0 * found.sigma_fx);
  EXPECT_NEAR(found.lens.fy, lens.fy, 4.0 * found.sigma_fy);
  EXPECT_NEAR(found.lens.cx, lens.cx, 4.0 * found.sigma_cx);
  EXPECT_LT(found.sigma_fx, 2.0);
  // What counts: where a far corner is seen.
  const Eigen::Vector3d corner(0.55, 0.33, 1.0);
  EXPECT_LT((pixel_of(found.lens, corner) - pixel_of(lens, corner)).norm(), 1.0);
}

TEST(CalibrateCamera, TooFewAndSquarePicturesAreRefused) {
  const CameraLens lens = lens_of();
  EXPECT_THROW(calibrate_camera(board_pictures(lens, 3, 0.7, 0.05), lens.width, lens.height), Error);
  EXPECT_THROW(calibrate_camera(board_pictures(lens, 12, 0.0, 0.05), lens.width, lens.height), Error);
  auto other_board = board_pictures(lens, 12, 0.7, 0.05);
  for (BoardPicture& picture : other_board) std::swap(picture.sights.front().pixel, picture.sights.back().pixel);
  EXPECT_THROW(calibrate_camera(other_board, lens.width, lens.height), Error) << "not the printed one";
}

TEST(CameraPose, ItsSigmasHoldWhatTheFocalLengthMayBeOff) {
  // 0.1 % is some centimetre of ten metres, and hardly shows in the residuals.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene scene(12, 0.05, seed);
    scene.lens.focal_sigma = 0.001;
    for (double* focal : {&scene.lens.fx, &scene.lens.fy}) *focal *= 1.0 + scene.lens.focal_sigma;
    const CameraPose pose = locate_camera(scene.lens, scene.sights, {});
    EXPECT_EQ(pose.used(), 12U) << seed;
    const Eigen::Vector3d off = pose.site_from_camera.translation() - scene.site_from_camera.translation();
    const Eigen::Matrix3d covariance = pose.covariance.topLeftCorner<3, 3>();
    EXPECT_LT(off.dot(covariance.ldlt().solve(off)), 16.0) << seed;
    EXPECT_NEAR(pose.by_focal_length.head<3>().norm(), off.norm(), 0.5 * off.norm() + 0.003) << seed;
  }
}

TEST(CalibrateCamera, WhatIsWrongWithTheBoardIsNamed) {
  const CameraLens lens = lens_of();
  const auto refusal = [&](const std::vector<BoardPicture>& pictures) -> std::string {
    try {
      calibrate_camera(pictures, lens.width, lens.height);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  const auto pictures = board_pictures(lens, 12, 0.7, 0.05);
  auto twice = pictures;
  twice[7].sights = twice[2].sights;
  EXPECT_NE(refusal(twice).find("shows the same as"), std::string::npos) << refusal(twice);
  auto millimetres = pictures, high = pictures, bent = pictures, moved = pictures;
  for (BoardPicture& picture : millimetres)
    for (BoardSight& sight : picture.sights) sight.board *= 1000.0;
  EXPECT_NE(refusal(millimetres).find("in metres"), std::string::npos);
  for (BoardPicture& picture : bent) picture.sights[3].board.z() += 0.01;
  EXPECT_NE(refusal(bent).find("different elevations"), std::string::npos);
  for (BoardPicture& picture : high)
    for (BoardSight& sight : picture.sights) sight.board.z() += 5.0;
  EXPECT_NEAR(calibrate_camera(high, lens.width, lens.height).lens.fx,
              calibrate_camera(pictures, lens.width, lens.height).lens.fx, 1e-6);
  // Unequal focal lengths, as a print gives that is longer one way; one that fits worse than its targets are seen.
  CameraLens square = lens;
  square.fy = square.fx;
  const auto even = board_pictures(square, 12, 0.7, 0.05);
  const auto is_said = [&](const std::vector<BoardPicture>& some, const std::string& words) {
    const Findings findings = calibrate_camera(some, lens.width, lens.height).findings;
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return finding.words.find(words) != std::string::npos; });
  };
  CameraLens oblong = square;
  oblong.fy *= 1.004;
  auto doubtful = even;
  EXPECT_TRUE(is_said(board_pictures(oblong, 12, 0.7, 0.05), "the print may be longer one way"));
  EXPECT_FALSE(is_said(even, "the print may be longer one way"));
  for (BoardPicture& picture : doubtful)
    for (BoardSight& sight : picture.sights) {
      sight.sigma_px = 0.02;
      sight.pixel += Eigen::Vector2d(0.4 * std::sin(40.0 * sight.board.x()), 0.0);
    }
  EXPECT_TRUE(is_said(doubtful, "the targets are seen to"));
  for (BoardPicture& picture : doubtful)
    for (BoardSight& sight : picture.sights) sight.sigma_px = 0.3;
  EXPECT_FALSE(is_said(doubtful, "the targets are seen to"));
  for (BoardPicture& picture : moved)
    for (std::size_t k = 0; k < picture.sights.size(); ++k) {
      picture.sights[k].id = static_cast<int>(k) + 1;
      if (k == 8) picture.sights[k].board.x() += 0.003;
    }
  const Findings findings = calibrate_camera(moved, lens.width, lens.height).findings;
  EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                          [](const Finding& finding) { return finding.subject.rfind("target ", 0) == 0; }),
            1);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(),
                          [](const Finding& finding) { return finding.subject == "target 9"; }));
}

TEST(CameraPose, TooLittleIsRefusedAndDoubtIsSaid) {
  const Scene scene(8);
  const auto first = [&](std::size_t count) {
    return std::vector<LandmarkSight>(scene.sights.begin(), scene.sights.begin() + static_cast<std::ptrdiff_t>(count));
  };
  EXPECT_THROW(locate_camera(scene.lens, first(3), {}), Error);
  auto millimetres = scene.sights;
  for (LandmarkSight& sight : millimetres) sight.site *= 1000.0;
  EXPECT_THROW(locate_camera(scene.lens, millimetres, {}), Error);
  const CameraPose four = locate_camera(scene.lens, first(4), {});
  ASSERT_FALSE(four.findings.empty());
  EXPECT_NE(four.findings[0].words.find("hardly anything checks"), std::string::npos);
  // Small, far and flat: its mirror pose fits as well.
  Scene flat(6, 0.3, 2, true);
  for (LandmarkSight& sight : flat.sights) {
    sight.site =
        origin + Eigen::Vector3d(0.02 * (sight.site.x() - origin.x()), 9.0, 1.6 + 0.02 * (sight.site.z() - origin.z()));
    sight.pixel = pixel_of(flat.lens, flat.site_from_camera.inverse() * sight.site) + Eigen::Vector2d(0.2, -0.1);
    sight.sigma_px = 0.3;
  }
  const CameraPose doubtful = locate_camera(flat.lens, flat.sights, {});
  EXPECT_TRUE(doubtful.flat);
  EXPECT_TRUE(std::any_of(doubtful.findings.begin(), doubtful.findings.end(),
                          [](const Finding& finding) { return finding.severity == Severity::decision; }));
}

}  // namespace
}  // namespace adit
