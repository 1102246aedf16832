#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/registration/adjustment.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

using namespace tests;

const Pose arm = lever_arm({0.14, -0.03, 0.19}, {0.02, -0.05, 0.01});
constexpr double sight_sigma_m = 0.002, sight_sigma_rad = 0.0004;

Matrix6d sight_information() {
  Matrix6d information = Matrix6d::Identity();
  information.topLeftCorner<3, 3>() /= sight_sigma_rad * sight_sigma_rad;
  information.bottomRightCorner<3, 3>() /= sight_sigma_m * sight_sigma_m;
  return information;
}

Pose noisy(const Pose& pose, const Random& random, std::uint64_t n, double sigma_m, double sigma_rad) {
  const auto three = [&](std::uint64_t k) -> Eigen::Vector3d {
    return {random.normal(n + k), random.normal(n + k + 1), random.normal(n + k + 2)};
  };
  Pose off = pose;
  off.translation() += sigma_m * three(0);
  off.linear() = (rotation_from_vector(sigma_rad * three(3)) * pose.linear()).eval();
  return off;
}

std::vector<Pose> true_stations() {
  std::vector<Pose> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(make_pose({11.0 * i, 0.8 * i, 0.1 * i}, {0.3 * i, 0.01, -0.02}));
  return poses;
}

/// Five stations with a picture each and pairs of neighbours that know nothing along x.
PoseGraph pictured_survey(std::uint64_t seed) {
  const std::vector<Pose> truth = true_stations();
  const Random random(seed, 5);
  PoseGraph graph;
  graph.cameras.push_back({noisy(arm, random, 0, 0.001, 0.0003), 0.001, 0.0003});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    graph.local_from_scan.push_back(off(truth[i], {0.2, -0.1, 0.1}, 0.7));
    graph.sights.push_back(
        {i, 0, noisy(truth[i] * arm, random, 100 + 10 * i, sight_sigma_m, sight_sigma_rad), sight_information()});
  }
  for (std::size_t i = 1; i < truth.size(); ++i) {
    Matrix6d information = 1e6 * Matrix6d::Identity();
    const Eigen::Vector3d along = truth[i - 1].linear().transpose() * Eigen::Vector3d::UnitX();
    information.bottomRightCorner<3, 3>() -= (1e6 - 1e-4) * along * along.transpose();
    graph.pairs.push_back({i, i - 1, truth[i - 1].inverse() * truth[i], information});
  }
  return graph;
}

TEST(PictureSights, ErrorsAreAsTheSigmasSay) {
  // Squared errors in sigmas: six are expected of each station.
  const std::vector<Pose> truth = true_stations();
  double squares = 0.0;
  constexpr int draws = 40;
  for (int draw = 0; draw < draws; ++draw) {
    Progress progress;
    const PoseGraphResult solved = solve_pose_graph(pictured_survey(static_cast<std::uint64_t>(draw) + 1), progress);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
      Vector6d error;
      error << rotation_vector(solved.local_from_scan[i].linear() * truth[i].linear().transpose()),
          solved.local_from_scan[i].translation() - truth[i].translation();
      squares += error.dot(solved.covariance[i].inverse() * error) / (6.0 * 2.0 * draws);
      EXPECT_LT(std::sqrt(solved.covariance[i].bottomRightCorner<3, 3>().trace()), 0.006);
    }
  }
  EXPECT_NEAR(std::sqrt(squares), 1.0, 0.12);
}

TEST(PictureSights, TheLeverArmIsCommonToAllPictures) {
  // Its error does not average out: five pictures know the stations no better than the lever arm is known.
  PoseGraph graph = pictured_survey(3);
  graph.cameras.front().sigma_m = 0.01;
  Progress progress;
  const PoseGraphResult loose = solve_pose_graph(graph, progress);
  EXPECT_GT(std::sqrt(loose.covariance[2].bottomRightCorner<3, 3>().trace() / 3.0), 0.008);
  // Control tells where the camera sits.
  const std::vector<Pose> truth = true_stations();
  graph.cameras.front().scan_from_camera.translation() += Eigen::Vector3d(0.03, -0.02, 0.01);
  graph.cameras.front().sigma_m = 0.05;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d point = truth[i] * Eigen::Vector3d(4.0 - 2.0 * k, 3.0 * (k % 2) - 1.0, 1.0 * k);
      graph.control.push_back(
          {i, "T" + std::to_string(10 * i + static_cast<std::size_t>(k)), truth[i].inverse() * point, point, 0.0});
    }
  const PoseGraphResult told = solve_pose_graph(graph, progress);
  EXPECT_LT(distance_between_m(told.scan_from_camera.front(), arm), 0.003);
  EXPECT_GT(told.camera_misfit.front(), 0.1);
}

TEST(PictureSights, AWrongPictureIsLeftOut) {
  PoseGraph graph = pictured_survey(2);
  for (GraphPair& pair : graph.pairs) {
    pair.information = 1e6 * Matrix6d::Identity();
    pair.information.topLeftCorner<3, 3>() *= 100.0;
  }
  graph.sights[2].local_from_camera.translation() += Eigen::Vector3d(0.08, 0.0, 0.02);
  Progress progress;
  const Adjustment adjustment = adjusted(graph, progress);
  ASSERT_EQ(adjustment.contradictions.size(), 1U);
  EXPECT_TRUE(adjustment.contradictions.front().left_out);
  EXPECT_EQ(adjustment.contradictions.front().suspects.front().kind, Suspect::Kind::sight);
  EXPECT_FALSE(adjustment.sight_used[2]);
  EXPECT_NEAR(adjustment.contradictions.front().off_m, 0.082, 0.006);
  EXPECT_LT(distance_between_m(adjustment.solved.local_from_scan[2], true_stations()[2]), 0.005);
}

/// One scan with a picture and nothing else, but perhaps a guess so far off.
RegistrationResult with_picture(std::optional<double> guess_off_m, const Eigen::Vector3d& picture_off_m = {0, 0, 0}) {
  const RockTunnel rock = sample_rock();
  const Pose truth = station(rock.design(), 36.0, 10.0);
  RegistrationContext context = context_along(rock.design().alignment());
  context.cameras.push_back({"front", arm, 0.001, 0.0003});
  CameraSight sight{"A", "a.png", 0, truth * arm, Matrix6d::Identity()};
  sight.local_from_camera.translation() += picture_off_m;
  sight.covariance.topLeftCorner<3, 3>() *= sight_sigma_m * sight_sigma_m;
  sight.covariance.bottomRightCorner<3, 3>() *= sight_sigma_rad * sight_sigma_rad;
  context.pictures.push_back(sight);
  ScanToPlace scan = scan_to_place("A", scan_at(rock, truth, 1, 20000), truth);
  scan.local_from_scan_guess.reset();
  if (guess_off_m) scan.local_from_scan_guess = off(truth, {*guess_off_m, 0.0, 0.0}, 0.5);
  Progress progress;
  RegistrationResult result = register_scans({scan}, context, {}, progress);
  EXPECT_LT(distance_between_m(result.scans.front().local_from_scan, truth), 1e-6 + picture_off_m.norm());
  return result;
}

TEST(PictureSights, APictureAlonePlacesAScan) {
  const RegistrationResult result = with_picture(std::nullopt);
  EXPECT_TRUE(result.accepted);
  EXPECT_TRUE(result.in_site);
  const PlacedScan& scan = result.scans.front();
  EXPECT_EQ(scan.placed_by, "pictures");
  EXPECT_NEAR(scan.sigma.up_m, std::hypot(sight_sigma_m, 0.001), 0.0002);
  EXPECT_NEAR(scan.sigma.yaw_rad, std::hypot(sight_sigma_rad, 0.0003), 0.00005);
  EXPECT_DOUBLE_EQ(result.datum_sigma_m, 0.0);
  ASSERT_EQ(result.pictures.size(), 1U);
  EXPECT_TRUE(result.pictures.front().used);
  EXPECT_EQ(result.pictures.front().camera, "front");
}

TEST(PictureSights, AGuessThatContradictsThePictureIsSaid) {
  EXPECT_TRUE(with_picture(0.6).accepted);
  const RegistrationResult result = with_picture(4.0);
  EXPECT_FALSE(result.accepted);
  EXPECT_TRUE(std::any_of(result.findings.begin(), result.findings.end(), [](const Finding& f) {
    return f.severity == Severity::decision && f.words.find("its picture puts it 4.0") != std::string::npos;
  }));
}

TEST(PictureSights, AnglesOfTheLeverArmThereAndBack) {
  const YawPitchRoll angles{0.3, -0.2, 0.1};
  const YawPitchRoll back = lever_arm_angles(lever_arm({1, 2, 3}, angles));
  EXPECT_NEAR(back.yaw_rad, angles.yaw_rad, 1e-12);
  EXPECT_NEAR(back.pitch_rad, angles.pitch_rad, 1e-12);
  EXPECT_NEAR(back.roll_rad, angles.roll_rad, 1e-12);
  // Unturned it looks along x, upright.
  EXPECT_LT((lever_arm({0, 0, 0}, {}).linear() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((lever_arm({0, 0, 0}, {}).linear() * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 1e-15);
}

}  // namespace
}  // namespace adit
