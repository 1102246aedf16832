#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/foundation/error.h"
#include "core/registration/observability.h"
#include "core/registration/pose_graph.h"
#include "tests/core/sample_mine.h"

namespace adit {
namespace {

using namespace tests;

struct TwoScans {
  RockTunnel rock = sample_rock();
  Pose first = station(rock.design(), 36.0, 10.0);
  Pose second = station(rock.design(), 44.0, 140.0);
  std::vector<ScanToPlace> scans() const {
    return {scan_to_place("A", scan_at(rock, first, 1), first),
            scan_to_place("B", scan_at(rock, second, 2), off(second, {0.3, -0.35, 0.1}, 2.0))};
  }
};

TEST(RegistrationSlow, PlacesAScanGuessedHalfAMetreAndTwoDegreesOff) {
  const TwoScans two;
  Progress progress;
  const RegistrationResult result =
      register_scans(two.scans(), context_along(two.rock.design().alignment()), {}, progress);
  ASSERT_EQ(result.scans.size(), 2U);
  // Everything fits, but without control the survey stands where the first guess put it: only that is to be decided.
  EXPECT_FALSE(result.accepted);
  ASSERT_EQ(result.findings.size(), 1U);
  EXPECT_EQ(result.findings[0].subject, "datum");
  EXPECT_GT(result.datum_sigma_m, 0.5);
  EXPECT_LT(distance_between_m(result.scans[1].local_from_scan, two.second), 0.005);
  EXPECT_LT(deg_from_rad(rotation_between_rad(result.scans[1].local_from_scan, two.second)), 0.02);
  ASSERT_EQ(result.pairs.size(), 1U);
  EXPECT_TRUE(result.pairs[0].undetermined.empty());
  EXPECT_LT(result.pairs[0].median_m, 0.006);
  // The stated sigma is honest: the error lies within four of it.
  EXPECT_LT(distance_between_m(result.scans[1].local_from_scan, two.second),
            4.0 * result.scans[1].sigma.along_m + 0.002);
}

TEST(RegistrationSlow, GivesTheSameBytesOnOneThreadAndTwo) {
  const TwoScans two;
  const auto poses = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    Progress progress;
    return register_scans(two.scans(), context_along(two.rock.design().alignment()), {}, progress)
        .scans[1]
        .local_from_scan;
  };
  EXPECT_EQ(poses(1).matrix(), poses(2).matrix());
}

TEST(RegistrationSlow, AFeaturelessTubeIsUndeterminedAlongAndHeldAtItsGuess) {
  // No look-out, no roughness, no face in reach: only noise tells along from along.
  RockTunnelOptions smooth;
  smooth.from_m = 1.0;
  smooth.face_m = 110.0;
  smooth.lookout_collar_m = smooth.lookout_toe_m = 0.1;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = 0.0;
  smooth.clutter = false;
  const RockTunnel tube(sample_design(arch_profile()), smooth);
  const Pose first = station(tube.design(), 50.0, 0.0);
  const Pose second = station(tube.design(), 58.0, 90.0);
  const Eigen::Vector2d t = tube.design().alignment().horizontal().at(50.0).tangent();
  const Eigen::Vector3d along(t.x(), t.y(), 0.0);
  const Pose guess = off(second, 0.3 * along, 1.0);
  Progress progress;
  const RegistrationResult result = register_scans(
      {scan_to_place("A", scan_at(tube, first, 1), first), scan_to_place("B", scan_at(tube, second, 2), guess)},
      context_along(tube.design().alignment()), {}, progress);
  EXPECT_FALSE(result.accepted);
  ASSERT_FALSE(result.pairs[0].undetermined.empty());
  EXPECT_EQ(result.pairs[0].undetermined.front(), "along");
  const Eigen::Vector3d error = result.scans[1].local_from_scan.translation() - second.translation();
  EXPECT_NEAR(error.dot(along), 0.3, 0.02);                     // held at the guess
  EXPECT_LT((error - along * error.dot(along)).norm(), 0.005);  // the rest is found
  EXPECT_GT(result.scans[1].sigma.along_m, 0.1);                // and it says so
  EXPECT_TRUE(std::any_of(result.findings.begin(), result.findings.end(),
                          [](const Finding& f) { return f.severity == Severity::decision && f.subject == "scan B"; }));
}

TEST(RegistrationSlow, InARoundTubeRollIsHeldWhereTheScanFits) {
  // Neither scanner stands on the axis: a transform that has rolled the scan about it has moved the scanner by metres.
  RockTunnelOptions smooth;
  smooth.from_m = 1.0;
  smooth.face_m = 110.0;
  smooth.lookout_collar_m = smooth.lookout_toe_m = smooth.corner_m = 0.0;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = smooth.floor_mean_m = 0.0;
  smooth.clutter = false;
  const RockTunnel tube(sample_design(circle_profile(3.0)), smooth);
  const auto standing = [&](double chainage_m, double x_m, double z_m, double yaw_deg) {
    return make_pose(tube.design().alignment().to_site({chainage_m, x_m, z_m}), {rad_from_deg(yaw_deg), 0.0, 0.0});
  };
  const Pose first = standing(50.0, 1.5, -1.0, 10.0);
  for (const Pose& second : {standing(58.0, -1.2, -0.5, 70.0), standing(58.0, -1.8, 0.0, 120.0)}) {
    Progress progress;
    const RegistrationResult result =
        register_scans({scan_to_place("A", scan_at(tube, first, 1, 200000), first),
                        scan_to_place("B", scan_at(tube, second, 2, 200000), off(second, {0.1, 0.1, 0.05}, 0.5))},
                       context_along(tube.design().alignment()), {}, progress);
    ASSERT_TRUE(result.pairs[0].used) << result.pairs[0].why_not;
    EXPECT_EQ(result.pairs[0].undetermined, (std::vector<std::string>{"along", "roll"}));
    EXPECT_LT(result.pairs[0].median_m, 0.002);
    EXPECT_LT(distance_between_m(result.scans[1].local_from_scan, second), 0.25);
  }
}

TEST(RegistrationSlow, ControlDeterminesWhatACloudCannot) {
  RockTunnelOptions smooth;
  smooth.from_m = 1.0;
  smooth.face_m = 110.0;
  smooth.lookout_collar_m = smooth.lookout_toe_m = 0.1;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = 0.0;
  smooth.clutter = false;
  const RockTunnel tube(sample_design(arch_profile()), smooth);
  const std::vector<Pose> truth{station(tube.design(), 50.0, 0.0), station(tube.design(), 58.0, 90.0)};
  RegistrationContext context = context_along(tube.design().alignment());
  for (int k = 0; k < 5; ++k) {
    const double s = 48.0 + 3.0 * k;
    const Eigen::Vector3d place = tube.design().alignment().to_site({s, k % 2 == 0 ? -3.9 : 3.9, 1.0 + 0.5 * k});
    context.control.push_back({"T" + std::to_string(k), place});
    for (std::size_t i = 0; i < 2; ++i)
      context.targets.push_back({i == 0 ? "A" : "B", "T" + std::to_string(k), truth[i].inverse() * place});
  }
  Progress progress;
  const RegistrationResult result =
      register_scans({scan_to_place("A", scan_at(tube, truth[0], 1), off(truth[0], {0.2, 0.2, 0}, 1)),
                      scan_to_place("B", scan_at(tube, truth[1], 2), off(truth[1], {-0.2, 0.1, 0}, -1))},
                     context, {}, progress);
  EXPECT_TRUE(result.accepted);
  EXPECT_EQ(result.datum_sigma_m, 0.0);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(distance_between_m(result.scans[i].local_from_scan, truth[i]), 0.003);
  EXPECT_LT(result.control_rms_m, 0.002);
}

TEST(Registration, AScanOfAnotherTunnelIsSaidNotGuessed) {
  const RockTunnel rock = sample_rock();
  const SampleMine elsewhere = sample_mine(MineKind::straight, 9, 2);
  const Pose pose = station(rock.design(), 36.0, 10.0);
  ScannerOptions scanner;
  scanner.pulses = 20000;
  Progress progress;
  ScanToPlace lost =
      scan_to_place("lost", scan_tunnel(elsewhere.tunnels, elsewhere.stations[0], scanner, {}, progress), pose);
  lost.local_from_scan_guess.reset();
  const RegistrationResult result = register_scans({scan_to_place("A", scan_at(rock, pose, 1, 20000), pose), lost},
                                                   context_along(rock.design().alignment()), {}, progress);
  EXPECT_FALSE(result.scans[1].placed);
  EXPECT_EQ(result.scans[1].placed_by, "not placed");
  EXPECT_FALSE(result.accepted);
}

/// Three stations in a row whose guesses are right, but for one: metres off and turned about.
RegistrationResult with_wrong_guess(std::size_t wrong) {
  const RockTunnel rock = sample_rock();
  std::vector<ScanToPlace> scans;
  for (std::size_t i = 0; i < 3; ++i) {
    const Pose truth =
        station(rock.design(), 32.0 + 7.0 * static_cast<double>(i), 10.0 + 50.0 * static_cast<double>(i));
    const Pose guess = i == wrong ? off(truth, {5.0, 6.0, 0.0}, 200.0) : truth;
    scans.push_back(scan_to_place(std::string(1, "ABC"[i]), scan_at(rock, truth, i + 1, 100000), guess));
  }
  Progress progress;
  return register_scans(scans, context_along(rock.design().alignment()), {}, progress);
}

TEST(RegistrationSlow, AWrongGuessIsSetAsideNotItsPairs) {
  const RockTunnel rock = sample_rock();
  for (const std::size_t wrong : {1U, 2U}) {
    const RegistrationResult result = with_wrong_guess(wrong);
    for (const PairResult& pair : result.pairs)
      EXPECT_TRUE(pair.used || pair.overlap < 0.15) << pair.source << pair.target << pair.why_not;
    for (std::size_t i = 0; i < 3; ++i) {
      const Pose truth =
          station(rock.design(), 32.0 + 7.0 * static_cast<double>(i), 10.0 + 50.0 * static_cast<double>(i));
      EXPECT_LT(distance_between_m(result.scans[i].local_from_scan, truth), 0.005);
    }
    EXPECT_EQ(std::count_if(result.findings.begin(), result.findings.end(),
                            [&](const Finding& f) {
                              return f.subject == "scan " + result.scans[wrong].name &&
                                     f.words.find("set aside") != std::string::npos;
                            }),
              1);
  }
}

TEST(RegistrationSlow, TwoExchangedGuessesAreNamedInAnyOrder) {
  const RockTunnel rock = sample_rock();
  std::vector<Pose> truth;
  for (int i = 0; i < 4; ++i) truth.push_back(station(rock.design(), 26.0 + 11.0 * i, 10.0 + 50.0 * i));
  for (const std::array<std::size_t, 4>& order : {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 2, 1, 3}}) {
    std::vector<ScanToPlace> scans;
    for (const std::size_t i : order) {
      const std::size_t guessed = i == 1 ? 2 : i == 2 ? 1 : i;
      scans.push_back(scan_to_place(std::string(1, "ABCD"[i]), scan_at(rock, truth[i], i + 1, 100000), truth[guessed]));
    }
    Progress progress;
    const RegistrationResult result = register_scans(scans, context_along(rock.design().alignment()), {}, progress);
    std::set<std::string> aside;
    for (const Finding& f : result.findings)
      if (f.words.find("set aside") != std::string::npos) aside.insert(f.subject);
    EXPECT_EQ(aside, (std::set<std::string>{"scan B", "scan C"}));
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LT(distance_between_m(result.scans[k].local_from_scan, truth[order[k]]), 0.005);
  }
}

TEST(Registration, WithNeitherControlNorGuessItDoesNotStandInTheSite) {
  const RockTunnel rock = sample_rock();
  const Pose pose = station(rock.design(), 36.0, 10.0);
  std::vector<ScanToPlace> scans{scan_to_place("A", scan_at(rock, pose, 1, 20000), pose)};
  Progress progress;
  const RegistrationContext context = context_along(rock.design().alignment());
  EXPECT_TRUE(register_scans(scans, context, {}, progress).in_site);
  scans[0].local_from_scan_guess.reset();
  const RegistrationResult alone = register_scans(scans, context, {}, progress);
  EXPECT_FALSE(alone.in_site);
  EXPECT_FALSE(alone.accepted);
  EXPECT_EQ(alone.datum_scan, "A");
  EXPECT_TRUE(register_scans(scans, {}, {}, progress).accepted);  // without a design there is nothing to be wrong about
}

TEST(RegistrationSlow, TargetsOfAllScansTogetherPlaceASurveyThatNobodyGuessed) {
  const TwoScans two;
  std::vector<ScanToPlace> scans = two.scans();
  for (ScanToPlace& scan : scans) scan.local_from_scan_guess.reset();
  RegistrationContext context = context_along(two.rock.design().alignment());
  for (int k = 0; k < 4; ++k) {  // two targets in each scan: neither is placed by its own
    const Eigen::Vector3d place =
        two.rock.design().alignment().to_site({34.0 + 4.0 * k, k % 2 == 0 ? -3.9 : 3.9, 1.0 + 0.5 * (k % 3)});
    context.control.push_back({"T" + std::to_string(k), place});
    const Pose& pose = k < 2 ? two.first : two.second;
    context.targets.push_back({k < 2 ? "A" : "B", "T" + std::to_string(k), pose.inverse() * place});
  }
  Progress progress;
  const RegistrationResult result = register_scans(scans, context, {}, progress);
  EXPECT_TRUE(result.in_site);
  EXPECT_EQ(result.datum_sigma_m, 0.0);
  EXPECT_TRUE(result.findings.empty()) << result.findings.front().words;
  EXPECT_LT(distance_between_m(result.scans[0].local_from_scan, two.first), 0.003);
  EXPECT_LT(distance_between_m(result.scans[1].local_from_scan, two.second), 0.003);
  context.targets.resize(1);  // one target tells nothing
  const RegistrationResult alone = register_scans(scans, context, {}, progress);
  EXPECT_FALSE(alone.in_site);
  EXPECT_TRUE(alone.control.empty());
}

/// One scan with so many targets, the first off its control point.
RegistrationResult with_targets(int targets, const Eigen::Vector3d& first_off_m) {
  const RockTunnel rock = sample_rock();
  const Pose truth = station(rock.design(), 36.0, 10.0);
  RegistrationContext context = context_along(rock.design().alignment());
  for (int k = 0; k < targets; ++k) {
    const Eigen::Vector3d place =
        rock.design().alignment().to_site({30.0 + 3.0 * k, k % 2 == 0 ? -3.9 : 3.9, 1.0 + 0.5 * (k % 3)});
    context.control.push_back({"T" + std::to_string(k), place});
    const Eigen::Vector3d seen = place + (k == 0 ? first_off_m : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    context.targets.push_back({"A", "T" + std::to_string(k), truth.inverse() * seen});
  }
  Progress progress;
  return register_scans({scan_to_place("A", scan_at(rock, truth, 1, 20000), truth)}, context, {}, progress);
}

TEST(Registration, RedundanciesAreObservationsLessUnknowns) {
  for (const int targets : {3, 5}) {
    double sum = 0.0;
    for (const ControlResidual& residual : with_targets(targets, Eigen::Vector3d::Zero()).control) {
      EXPECT_GE(residual.redundancy, 0.0);
      EXPECT_LE(residual.redundancy, 1.0);
      sum += 3.0 * residual.redundancy;
    }
    EXPECT_NEAR(sum, 3.0 * targets - 6.0, 0.01);
  }
}

TEST(Registration, WhatNothingElseChecksIsSaid) {
  const auto warnings = [](const RegistrationResult& result) {
    return std::count_if(result.findings.begin(), result.findings.end(), [](const Finding& f) {
      return f.severity == Severity::warning && f.words.find("hardly anything else checks") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings(with_targets(3, Eigen::Vector3d::Zero())), 1);
  EXPECT_EQ(warnings(with_targets(6, Eigen::Vector3d::Zero())), 0);
}

TEST(Registration, AScanWithTooFewPointsIsNotPlacedAndTheRestIs) {
  const RockTunnel rock = sample_rock();
  const Pose first = station(rock.design(), 36.0, 10.0);
  PointCloud few;
  few.points.assign(50, Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  Progress progress;
  const RegistrationResult result = register_scans(
      {scan_to_place("few", few, first), scan_to_place("A", scan_at(rock, first, 1, 20000), first)}, {}, {}, progress);
  EXPECT_FALSE(result.scans[0].placed);
  EXPECT_TRUE(result.scans[1].placed);
  EXPECT_EQ(result.datum_scan, "A");
  EXPECT_FALSE(result.accepted);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(result.findings[0].subject, "scan few");
  EXPECT_NE(result.findings[0].words.find("only 50 points"), std::string::npos);
}

TEST(Registration, ATargetThatFailsTheBlunderTestIsSaid) {
  const auto decisions = [](const RegistrationResult& result) {
    return std::count_if(result.findings.begin(), result.findings.end(), [](const Finding& f) {
      return f.severity == Severity::decision && f.words.find("target T0") != std::string::npos;
    });
  };
  EXPECT_EQ(decisions(with_targets(6, {0.0, 0.0, 0.003})), 0);
  const RegistrationResult wrong =
      with_targets(6, {0.0, 0.0, 0.014});  // its residual is under five sigma: no contradiction
  EXPECT_EQ(decisions(wrong), 1);
  EXPECT_FALSE(wrong.accepted);
  EXPECT_GT(wrong.control.front().normalised, wrong_normalised);
}

TEST(Registration, ABlunderAcrossAllAxesIsMeasuredInSpace) {
  // 7 mm on each axis: every axis by itself would pass.
  const RegistrationResult wrong = with_targets(6, {0.0075, 0.0075, 0.0075});
  EXPECT_GT(wrong.control.front().normalised, wrong_normalised);
  EXPECT_FALSE(wrong.accepted);
}

TEST(Registration, ATargetWithoutControlPointIsRefused) {
  RegistrationContext context;
  context.targets.push_back({"A", "T9", {1, 2, 3}});
  PointCloud cloud;
  cloud.points.assign(10, Eigen::Vector3f::Zero());
  Progress progress;
  EXPECT_THROW(register_scans({scan_to_place("A", cloud, Pose::Identity())}, context, {}, progress), Error);
}

Matrix6d tight() {
  return Matrix6d::Identity() * 1e6;
}

TEST(PoseGraph, ClosesALoopAndIgnoresAPlantedWrongPair) {
  std::vector<Pose> truth;
  for (int i = 0; i < 5; ++i) truth.push_back(make_pose({6.0 * i, 0.5 * i, 0.0}, {0.2 * i, 0.0, 0.0}));
  PoseGraph graph;
  graph.datum = 0;
  graph.guess_sigma_rad = 0.1;
  for (std::size_t i = 0; i < truth.size(); ++i)
    graph.local_from_scan.push_back(i == 0 ? truth[i] : off(truth[i], {0.2, -0.1, 0.05}, 1.0));
  for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
    graph.pairs.push_back({i + 1, i, truth[i].inverse() * truth[i + 1], tight()});
    if (i + 2 < truth.size()) graph.pairs.push_back({i + 2, i, truth[i].inverse() * truth[i + 2], tight()});
  }
  Progress progress;
  const PoseGraphResult clean = solve_pose_graph(graph, progress);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(distance_between_m(clean.local_from_scan[i], truth[i]), 1e-4);
  graph.pairs.push_back({4, 0, off(truth[0].inverse() * truth[4], {1.0, 0.5, 0.0}, 5.0), tight()});
  const PoseGraphResult planted = solve_pose_graph(graph, progress);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(distance_between_m(planted.local_from_scan[i], clean.local_from_scan[i]), 0.001);
  EXPECT_GT(planted.pair_misfit.back(), 1000.0);
}

TEST(PoseGraph, AWrongDatumTurnsALongChainAndTearsNoPair) {
  // 3 degrees of the datum are 6 m at the other end: guesses that are right each by itself disagree by twelve sigmas.
  std::vector<Pose> truth;
  for (int i = 0; i < 10; ++i) truth.push_back(make_pose({13.0 * i, 0.5 * i, 0.0}, {0.4 * i, 0.0, 0.0}));
  PoseGraph graph;
  graph.datum = 0;
  graph.local_from_scan = truth;
  const Pose wrong = off(truth[0], {0.3, -0.2, 0.1}, 3.0);
  graph.local_from_scan[0] = wrong;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i)
    graph.pairs.push_back({i + 1, i, truth[i].inverse() * truth[i + 1], 1e4 * tight()});
  Progress progress;
  const PoseGraphResult result = solve_pose_graph(graph, progress);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(distance_between_m(wrong.inverse() * result.local_from_scan[i], truth[0].inverse() * truth[i]), 1e-3)
        << i;
  for (const double misfit : result.pair_misfit) EXPECT_LT(misfit, 1.0);
  EXPECT_LT(distance_between_m(result.moved_from_guesses * truth[9], result.local_from_scan[9]), 0.5);
  EXPECT_NEAR(rotation_between_rad(result.moved_from_guesses, Pose::Identity()), rad_from_deg(3.0), 0.005);
}

TEST(PoseGraph, CovarianceDoesNotDependOnTheStart) {
  const Pose truth = make_pose({10, 20, 3}, {1.0, 0.01, 0.02});
  const auto covariance = [&](double yaw_deg) {
    PoseGraph graph;
    graph.local_from_scan = {off(truth, {0.3, 0.2, 0.1}, yaw_deg)};
    graph.guess_sigma_rad = 10.0;
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(0, 3, 1), Eigen::Vector3d(-2, 0, 2)})
      graph.control.push_back({0, "T", p, truth * p});
    Progress progress;
    return Matrix6d(solve_pose_graph(graph, progress).covariance[0]);
  };
  const Matrix6d right = covariance(0.0);
  for (const double yaw_deg : {40.0, 120.0, 170.0})
    EXPECT_LT((covariance(yaw_deg) - right).norm(), 1e-3 * right.norm()) << yaw_deg;
}

TEST(PoseGraph, ControlGivesDatumAndCovariance) {
  const Pose truth = make_pose({10, 20, 3}, {1.0, 0.01, 0.02});
  PoseGraph graph;
  graph.local_from_scan = {off(truth, {0.3, 0.2, 0.1}, 2.0)};
  graph.control_sigma_m = 0.002;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(0, 5, 1), Eigen::Vector3d(-5, 0, 2), Eigen::Vector3d(0, -5, 3)})
    graph.control.push_back({0, "T", p, truth * p});
  Progress progress;
  const PoseGraphResult result = solve_pose_graph(graph, progress);
  EXPECT_LT(distance_between_m(result.local_from_scan[0], truth), 1e-5);  // the loose guess pulls a little
  EXPECT_NEAR(std::sqrt(result.covariance[0](3, 3)), 0.001, 0.0005);      // 2 mm over four points
}

TEST(Observability, AxesAreAlongRightUp) {
  const Eigen::Matrix3d axes = tunnel_axes({0, 2, 0});
  EXPECT_TRUE(axes.row(0).isApprox(Eigen::RowVector3d(0, 1, 0)));
  EXPECT_TRUE(axes.row(1).isApprox(Eigen::RowVector3d(1, 0, 0)));
  EXPECT_TRUE(axes.row(2).isApprox(Eigen::RowVector3d(0, 0, 1)));
}

}  // namespace
}  // namespace adit
