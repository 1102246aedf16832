#include "core/registration/alike_along.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/registration/found_place.h"
#include "core/registration/scan_pairs.h"
#include "tests/core/ribbed_tunnel.h"

namespace adit {
namespace {

const Pose first = make_pose({0.13, 0.0, -1.0}, {0.3, 0.01, 0.0});
const Pose second = make_pose({8.13, 0.2, -1.0}, {1.1, 0.0, 0.01});
const Eigen::Vector3d axis = first.linear().transpose() * Eigen::Vector3d::UnitX();

struct TwoScans {
  PreparedScan target, source;
};
TwoScans scans_of(const tests::RibbedTunnel& tunnel) {
  Progress progress;
  const auto prepared = [&](const char* name, const Pose& pose, std::uint64_t seed) {
    return prepare_scan(name, CloudTiles(tunnel.scan(pose, 150000, seed)), 0.1, 0.6, 45.0, progress);
  };
  return {prepared("A", first, 1), prepared("B", second, 2)};
}

/// The pair, guessed so far along; and its error in the tunnel's axes.
struct Matched {
  PairResult pair;
  Eigen::Vector3d error_m;
};
Matched matched(const TwoScans& scans, double guess_off_m) {
  Progress progress;
  const Pose truth = first.inverse() * second;
  const Pose guess = Eigen::Translation3d(guess_off_m * axis) * truth;
  Matched result;
  result.pair = matched_pair(scans.target, scans.source, guess, Start::guess, axis, {}, progress);
  result.error_m = first.linear() * (result.pair.target_from_source.translation() - truth.translation());
  return result;
}

TEST(AlikeAlongSlow, RibsAloneDoNotTellWhichIsWhich) {
  const TwoScans scans = scans_of({});
  std::size_t alike = 0;
  for (const double off_m : {0.3, -0.4, -0.7}) {
    const Matched found = matched(scans, off_m);
    EXPECT_EQ(found.pair.undetermined, (std::vector<std::string>{"along"}));
    if (found.pair.alike_m != 0.0) {
      EXPECT_NEAR(std::remainder(found.pair.alike_m, 1.1), 0.0, 0.05) << found.pair.alike_m;
      EXPECT_GT(std::abs(found.pair.alike_m), 1.0);
      EXPECT_NEAR(std::remainder(found.error_m.x(), 1.1), 0.0, 0.02);  // it stays where ribs meet ribs
    } else {  // too little stands out of the noise to tell; it stays where ribs meet all the same
      EXPECT_NEAR(std::remainder(found.error_m.x(), 1.1), 0.0, 0.02) << found.error_m.x();
    }
    EXPECT_LT(found.error_m.tail<2>().norm(), 0.001);
    EXPECT_GE(found.pair.sigma.along_m, 0.5);  // as the guess
    alike += found.pair.alike_m != 0.0 ? 1 : 0;
  }
  EXPECT_GE(alike, 1U);
  Progress progress;
  EXPECT_EQ(found_place(scans.target, scans.source, {}, progress).outcome, SearchOutcome::alike_elsewhere);
}

TEST(AlikeAlongSlow, RibsThatDoNotMeetAtTheGuessTellTheOtherDirectionsWhereTheyMeet) {
  // Half a period off, ribs would ride on what is between them: 0.12 m across.
  const TwoScans scans = scans_of({.rib_m = 0.12, .period_m = 0.8});
  for (const double off_m : {0.4, -0.4}) {
    const Matched found = matched(scans, off_m);
    EXPECT_EQ(found.pair.undetermined, (std::vector<std::string>{"along"}));
    EXPECT_GT(found.pair.agreeing, 0.7);
    EXPECT_LT(found.error_m.tail<2>().norm(), 0.001);
  }
  Progress progress;
  const auto placed_scan = [&](const char* name, const Pose& pose, std::uint64_t seed) {
    return ScanToPlace{
        name,
        std::make_shared<CloudTiles>(tests::RibbedTunnel{.rib_m = 0.12, .period_m = 0.8}.scan(pose, 150000, seed)),
        pose, true};
  };
  std::vector<ScanToPlace> both{placed_scan("A", first, 1), placed_scan("B", second, 2)};
  both[1].local_from_scan_guess = Eigen::Translation3d(0.4, 0.0, 0.0) * second;
  const RegistrationResult result = register_scans(both, {}, {}, progress);
  const PlacedScan& scan = result.scans[1];
  EXPECT_EQ(scan.undetermined, (std::vector<std::string>{"along"}));
  const Eigen::Vector3d error_m = scan.local_from_scan.translation() - second.translation();
  EXPECT_NEAR(error_m.x(), 0.4, 0.01);  // as the guess
  EXPECT_LT(error_m.tail<2>().norm(), 0.002);
}

TEST(AlikeAlongSlow, APairThatHardlyOverlapsIsNotDrawnTogether) {
  // 26 m apart: what the transform finds is where the scans overlap most, upon each other.
  const tests::RibbedTunnel tunnel{.rib_m = 0.0, .roughness_m = 0.03};
  Progress progress;
  const Pose far = Eigen::Translation3d(18.0, 0.0, 0.0) * second;
  const auto prepared = [&](const Pose& pose, std::uint64_t seed) {
    return prepare_scan("scan", CloudTiles(tunnel.scan(pose, 60000, seed)), 0.1, 0.6, 45.0, progress);
  };
  const Pose truth = first.inverse() * far;
  const PairResult pair = matched_pair(prepared(first, 1), prepared(far, 2), Eigen::Translation3d(0.3 * axis) * truth,
                                       Start::guess, axis, {}, progress);
  EXPECT_TRUE(!lies_well(pair) || pair.overlap < 0.15 || distance_between_m(pair.target_from_source, truth) < 2.0)
      << pair.overlap << " " << pair.agreeing << " " << distance_between_m(pair.target_from_source, truth);
}

TEST(AlikeAlongSlow, RockBetweenTheRibsTells) {
  tests::RibbedTunnel tunnel;
  tunnel.roughness_m = 0.05;
  const TwoScans scans = scans_of(tunnel);
  for (const double off_m : {0.3, -0.7}) {
    const Matched found = matched(scans, off_m);
    EXPECT_TRUE(found.pair.undetermined.empty());
    EXPECT_EQ(found.pair.alike_m, 0.0);
    EXPECT_LT(found.error_m.norm(), 0.002);
  }
}

TEST(AlikeAlongSlow, ARoughLiningIsFoundWhereTheTransformDrifts) {
  // Nothing longer than half a metre: coarse cells see a smooth tube and drift along it by metres.
  const TwoScans scans = scans_of({.rib_m = 0.0, .roughness_m = 0.03});
  const Matched found = matched(scans, 0.6);
  EXPECT_TRUE(found.pair.undetermined.empty());
  EXPECT_LT(found.error_m.norm(), 0.002);
}

TEST(AlikeAlongSlow, InACurveWhatIsHeldAlongTakesTheOthersWithIt) {
  // Half a metre along is as much as 40 mm across to a target that stands 8 m away in a curve of 100 m, and 0.3
  // degrees: the pair's information has to admit that, whether rings repeat or nothing tells.
  for (const double rib_m : {0.15, 0.0}) {
    const tests::RibbedTunnel tunnel{.rib_m = rib_m, .bend_per_m = 0.01};
    const Pose one = tunnel.bent(first), other = tunnel.bent(second);
    Progress progress;
    const auto prepared = [&](const Pose& pose, std::uint64_t seed) {
      return prepare_scan("scan", CloudTiles(tunnel.scan(pose, 150000, seed)), 0.1, 0.6, 45.0, progress);
    };
    const PreparedScan target = prepared(one, 1), source = prepared(other, 2);
    const Pose truth = one.inverse() * other;
    const Eigen::Vector3d along = one.linear().transpose() * rotation_from_vector({0.0, 0.0, 0.0013}).col(0);
    for (const double off_m : {-0.5, 0.7}) {
      const PairResult pair =
          matched_pair(target, source, Eigen::Translation3d(off_m * along) * truth, Start::guess, along, {}, progress);
      EXPECT_EQ(pair.undetermined, (std::vector<std::string>{"along"}));
      Vector6d error;
      error << rotation_vector(pair.target_from_source.linear() * truth.linear().transpose()),
          pair.target_from_source.translation() - truth.translation();
      const double along_m = along.dot(error.tail<3>());
      if (rib_m > 0.0)
        EXPECT_NEAR(std::remainder(along_m, 1.1), 0.0, 0.05) << along_m;  // where ribs meet
      else
        EXPECT_NEAR(along_m, off_m, 0.1);                                             // as the guess
      EXPECT_LT(error.dot(pair.information * error), 25.0) << rib_m << " " << off_m;  // chi squared, 6 degrees
      EXPECT_LT(pair.sigma.across_m, 0.005);                                          // with "along" held
    }
  }
}

TEST(AlikeAlongSlow, OppositeFacesOfARibDoNotPullScansTogether) {
  // Between the stations each scanner sees its own side of every rib.
  tests::RibbedTunnel tunnel;
  tunnel.roughness_m = 0.01;
  Progress progress;
  const auto prepared = [&](const Pose& pose, std::uint64_t seed) {
    return prepare_scan("scan", CloudTiles(tunnel.scan(pose, 400000, seed)), 0.1, 0.6, 45.0, progress);
  };
  const Matched found = matched({prepared(first, 1), prepared(second, 2)}, 0.3);
  EXPECT_TRUE(found.pair.undetermined.empty());
  EXPECT_LT(std::abs(found.error_m.x()), 0.001);
  EXPECT_LT(std::abs(found.error_m.x()), 4.0 * found.pair.sigma.along_m);
}

TEST(ScanPairs, WhatAPairShowsMustLieOnTheSameSurfaces) {
  const auto lies = [](double agreeing, double seen_through, double median_m, double noise_m) {
    PairResult pair;
    pair.agreeing = agreeing;
    pair.seen_through = seen_through;
    pair.median_m = median_m;
    pair.noise_m = noise_m;
    return lies_well(pair);
  };
  EXPECT_TRUE(lies(0.95, 0.0, 0.0018, 0.0021));
  EXPECT_TRUE(lies(0.50, 0.002, 0.0103, 0.0062));   // the real corridor
  EXPECT_FALSE(lies(0.56, 0.047, 0.0085, 0.0062));  // the same, one scan upon the other
  EXPECT_FALSE(lies(0.52, 0.0, 0.0181, 0.0021));    // turned about in rock of 30 mm
  EXPECT_TRUE(lies(0.52, 0.0, 0.0181, 0.0));        // nothing known of the noise
  EXPECT_FALSE(lies(0.44, 0.0, 0.0018, 0.0021));
}

/// Two scans between which the face went on, and the machine before it as far.
TwoScans scans_before_a_face(double roughness_m, double went_on_m, bool machine = false) {
  Progress progress;
  const auto prepared = [&](const Pose& pose, std::uint64_t seed, double face_m) {
    const tests::RibbedTunnel tunnel{
        .rib_m = 0.0, .roughness_m = roughness_m, .face_m = face_m, .machine_m = machine ? face_m - 4.0 : 1e9};
    return prepare_scan("scan", CloudTiles(tunnel.scan(pose, 150000, seed)), 0.1, 0.6, 45.0, progress);
  };
  return {prepared(first, 1, 15.0), prepared(second, 2, 15.0 + went_on_m)};
}

TEST(LoneWitnessSlow, WhatAFaceAloneTellsIsNotBelieved) {
  for (const double went_on_m : {0.0, 0.3}) {
    const Matched found = matched(scans_before_a_face(0.0, went_on_m), 0.1);
    EXPECT_EQ(found.pair.undetermined, (std::vector<std::string>{"along"}));
    EXPECT_GE(found.pair.sigma.along_m, 0.5);
    EXPECT_LT(found.error_m.tail<2>().norm(), 0.002);
    const double face_m = 15.0 - 0.13;  // from the target's scanner
    EXPECT_LT(found.pair.lone_witness.from_m, face_m);
    EXPECT_GT(found.pair.lone_witness.to_m, face_m);
  }
}

TEST(LoneWitnessSlow, RoughWallsBearTheFaceOutOrContradictIt) {
  const Matched same = matched(scans_before_a_face(0.03, 0.0), 0.1);
  EXPECT_TRUE(same.pair.lone_witness.is_empty());
  EXPECT_TRUE(same.pair.undetermined.empty());
  EXPECT_LT(same.error_m.norm(), 0.001);
  for (const double went_on_m : {-0.05, -0.01, 0.15}) {
    const Matched moved = matched(scans_before_a_face(0.03, went_on_m), 0.1);
    EXPECT_TRUE(moved.pair.undetermined.empty());
    EXPECT_FALSE(moved.pair.moved.empty()) << went_on_m;
    EXPECT_NEAR(moved.pair.moved_m, -went_on_m, 0.003);
    EXPECT_LT(std::abs(moved.error_m.x()), 4.0 * moved.pair.sigma.along_m) << went_on_m;
    EXPECT_LT(moved.error_m.norm(), 0.003);
  }
}

TEST(LoneWitnessSlow, ThingsThatMovedTogetherDoNotOutvoteTheRock) {
  for (const double roughness_m : {0.01, 0.03}) {
    const Matched same = matched(scans_before_a_face(roughness_m, 0.0, true), 0.1);
    EXPECT_TRUE(same.pair.moved.empty());
    EXPECT_LT(same.error_m.norm(), 0.001);
    const Matched moved = matched(scans_before_a_face(roughness_m, 0.3, true), 0.1);
    const auto& unknown = moved.pair.undetermined;
    const bool held = std::find(unknown.begin(), unknown.end(), "along") != unknown.end();
    EXPECT_TRUE(held || std::abs(moved.error_m.x()) < 4.0 * moved.pair.sigma.along_m)
        << roughness_m << " " << moved.error_m.x() << " " << moved.pair.sigma.along_m;
  }
}

}  // namespace
}  // namespace adit
