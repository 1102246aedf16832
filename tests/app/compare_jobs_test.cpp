// A job against an earlier one of the same tunnel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/foundation/error.h"
#include "core/simulation/truth.h"
#include "io/results_json.h"
#include "io/text_file.h"
#include "tests/app/run.h"
#include "tests/temporary_folder.h"

namespace adit {
namespace {

using tests::TemporaryFolder;
namespace fs = std::filesystem;

/// A demo with an earlier one, a round back, in its folder "before".
void two_demos(const fs::path& folder) {
  app::DemoOptions options;
  options.points = 500000;
  options.stations = 2;
  options.before = "before";
  Progress progress;
  app::make_demo(folder, options, progress);
  options.before.clear();
  options.rounds_back = 1;
  app::make_demo(folder / "before", options, progress);
}

/// The simulated faces are alike, so the round is as long everywhere: its volume is that of the walls between them.
double true_volume_of_round(const app::JobState& state) {
  constexpr double round_m = 4.0;
  RockTunnelOptions options;
  options.seed = 1;
  options.from_m = 1001.0;
  options.face_m = state.truth->face_chainage_m;
  options.first_round_m = 1000.4;
  Progress progress;
  const double face_m = options.face_m;
  const RockTunnel rock(*state.design, options);
  return true_volume(rock, face_m - round_m, face_m, progress).excavated_m3;
}

TEST(CompareJobsSlow, ARoundIsMeasuredBetweenTwoJobsAndTakenUpAgain) {
  const TemporaryFolder folder;
  two_demos(folder.path());
  tests::run(folder / "before", {}, "register");
  const auto state = tests::run(folder.path());
  ASSERT_TRUE(state->results.compare);
  const CompareResult& result = *state->results.compare;
  ASSERT_TRUE(result.between.whole);
  EXPECT_NEAR(result.between.advance_m, 4.0, 0.03);
  const double truth = true_volume_of_round(*state);
  EXPECT_LT(std::abs(result.between.excavated_m3 - truth), 2.0 * result.between.sigma_m3);
  EXPECT_LT(result.between.sigma_m3, 0.08 * truth) << "18 m from the scanner much of the walls is not seen";
  EXPECT_GT(result.round, 0);
  EXPECT_NEAR(result.left.mean_m, 0.2, 0.05);
  EXPECT_LT(std::abs(result.layer.mean_m), 0.001) << "the walls are the same";
  EXPECT_LT(result.change.inwards_m2 + result.change.outwards_m2, 0.02 * result.change.compared_m2);
  for (const char* file : {"face.csv", "layer.csv", "report/face.png", "report/layer.png"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;

  const auto again = tests::run(folder.path());
  for (const StepTime& time : again->results.timing) EXPECT_TRUE(time.fresh) << time.step;
  const auto json = [](const Results& results) {
    auto all = nlohmann::json::parse(io::results_text(results));
    return std::array{all.at("before"), all.at("face")};
  };
  EXPECT_EQ(json(again->results), json(state->results));

  auto job = nlohmann::json::parse(io::read_text_file(folder / "job.json"));
  job.erase("before");
  job.erase("face");
  std::ofstream(folder / "job.json") << job.dump(1);
  tests::run(folder.path());
  for (const char* file : {"face.csv", "layer.csv", "report/face.png", "report/layer.png"})
    EXPECT_FALSE(fs::exists(folder / "out" / file)) << file << " shows what the job no longer asks for";
}

TEST(CompareJobsSlow, AnEarlierJobThatHasChangedIsRefused) {
  const TemporaryFolder folder;
  two_demos(folder.path());
  tests::run(folder / "before", {}, "register");
  auto job = nlohmann::json::parse(io::read_text_file(folder / "before" / "job.json"));
  job["scans"][0]["pose"]["position"][0] = job["scans"][0]["pose"]["position"][0].get<double>() + 0.1;
  std::ofstream(folder / "before" / "job.json") << job.dump(1);
  try {
    tests::run(folder.path(), {}, "compare");
    FAIL() << "it was compared";
  } catch (const Error& error) {
    EXPECT_NE(error.what_is_wrong().find("has changed since it was run"), std::string::npos) << error.what_is_wrong();
  }
}

TEST(CompareJobsSlow, WhatTheEarlierJobLeavesOpenIsOpenHere) {
  const TemporaryFolder folder;
  two_demos(folder.path());
  auto job = nlohmann::json::parse(io::read_text_file(folder / "before" / "job.json"));
  job.erase("control");
  job.erase("targets");
  std::ofstream(folder / "before" / "job.json") << job.dump(1);
  const auto before = tests::run(folder / "before", {}, "register");
  ASSERT_TRUE(needs_a_person(before->results)) << "nothing holds it but guesses";
  const auto state = tests::run(folder.path(), {}, "compare");
  const Findings& findings = state->results.compare->findings;
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return f.severity == Severity::decision && f.subject.starts_with("earlier job, ");
  }));
}

}  // namespace
}  // namespace adit
