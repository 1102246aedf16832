#include "app/run_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/job_runner.h"
#include "app/registration_figures.h"
#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "io/job_json.h"
#include "io/results_json.h"
#include "io/text_file.h"
#include "tests/app/run.h"
#include "tests/temporary_folder.h"

namespace adit {
namespace {

using tests::TemporaryFolder;
namespace fs = std::filesystem;

/// Names of the steps that really ran.
std::vector<std::string> steps_run(const app::JobState& state) {
  std::vector<std::string> names;
  for (const StepTime& time : state.results.timing)
    if (!time.fresh) names.push_back(time.step);
  return names;
}

/// results.json without what differs from run to run.
nlohmann::json comparable(const Results& results) {
  auto json = nlohmann::json::parse(io::results_text(results));
  json.erase("timing_s");
  json.erase("pair_timing_s");
  json.erase("peak_memory_bytes");
  return json;
}

void change_job(const fs::path& folder, const std::function<void(nlohmann::json&)>& change) {
  auto json = nlohmann::json::parse(io::read_text_file(folder / "job.json"));
  change(json);
  std::ofstream(folder / "job.json") << json.dump(1);
}

TEST(RunJobSlow, StepsRunAgainOnlyWhenWhatTheyDependOnChanged) {
  const TemporaryFolder folder;
  tests::small_demo(folder.path());
  const auto first = tests::run(folder.path());
  EXPECT_EQ(steps_run(*first),
            (std::vector<std::string>{"import", "register", "surface", "profile", "volume", "report"}));
  for (const char* file :
       {"report.pdf", "results.json", "sections.csv", "volumes.csv", "registration.csv", "map.png", "mesh.ply"})
    EXPECT_TRUE(fs::is_regular_file(folder / "out" / file)) << file;

  const auto again = tests::run(folder.path());
  EXPECT_TRUE(steps_run(*again).empty());
  EXPECT_EQ(comparable(first->results), comparable(again->results));  // to the last digit

  change_job(folder.path(), [](nlohmann::json& job) { job["rounds"].erase(0); });
  EXPECT_EQ(steps_run(*tests::run(folder.path())), (std::vector<std::string>{"volume", "report"}));

  change_job(folder.path(), [](nlohmann::json& job) { job["chainage"]["interval"] = 2.0; });
  EXPECT_EQ(steps_run(*tests::run(folder.path())), (std::vector<std::string>{"profile", "volume", "report"}));

  change_job(folder.path(), [](nlohmann::json& job) { job["options"]["surface"]["spacing_m"] = 0.25; });
  EXPECT_EQ(steps_run(*tests::run(folder.path())), (std::vector<std::string>{"surface", "volume", "report"}));

  fs::resize_file(folder / "out" / "steps" / "map.bin", 1000);  // damaged: simply made again
  EXPECT_EQ(steps_run(*tests::run(folder.path())), (std::vector<std::string>{"profile"}));
}

TEST(RegistrationFigures, TakeThePlaceOfTheirOwnAloneInTheirFolder) {
  const TemporaryFolder folder;
  tests::small_demo(folder.path());
  app::RunOptions options;
  options.last_step = "register";
  Progress progress;
  const auto state = app::run_job(folder.path(), options, progress);
  const fs::path figures = folder / "out" / "figures";
  fs::create_directories(figures / "own");
  for (const char* name : {"mine.png", "ndt-99-gone.png", "ndt-notes.txt", "own/overlap-1-a-b.png"})
    std::ofstream(figures / name) << "x";
  const auto files = app::write_registration_figures(*state, progress);
  std::size_t pairs = 0;
  for (const PairResult& pair : state->results.registration.pairs) pairs += pair.used ? 1 : 0;
  EXPECT_EQ(files.size(), state->stores.size() + pairs);
  for (const fs::path& file : files) EXPECT_GT(fs::file_size(file), 2000U) << file;
  EXPECT_FALSE(fs::exists(figures / "ndt-99-gone.png"));
  for (const char* name : {"mine.png", "ndt-notes.txt", "own/overlap-1-a-b.png"})
    EXPECT_TRUE(fs::exists(figures / name)) << name;
  fs::remove_all(figures);
  std::ofstream(figures) << "a file in the way";
  EXPECT_THROW(app::write_registration_figures(*state, progress), Error);
  EXPECT_TRUE(fs::is_regular_file(figures));
}

TEST(RunJobSlow, DemoIsWithinItsFigures) {
  const TemporaryFolder folder;
  tests::small_demo(folder.path(), 800000, 2);
  const auto state = tests::run(folder.path(), {}, "volume");
  EXPECT_TRUE(state->results.registration.accepted);
  ASSERT_TRUE(state->results.truth);
  const TruthComparison& truth = *state->results.truth;
  EXPECT_LT(truth.worst_position_error_m, 0.010);
  EXPECT_LT(deg_from_rad(truth.worst_rotation_error_rad), 0.05);
  EXPECT_LT(std::abs(truth.overbreak_error), 0.01);
  EXPECT_LT(std::abs(truth.excavated_error), 0.01);
  EXPECT_LT(truth.section_area_rms, 0.01);
}

TEST(RunJobSlow, DemoWithoutControlIsWithinItsFiguresFromTheFirstStation) {
  const TemporaryFolder folder;
  app::DemoOptions options;
  options.points = 250000;
  options.stations = 3;
  options.control = false;
  Progress progress;
  app::make_demo(folder.path(), options, progress);
  const auto state = tests::run(folder.path(), {}, "register");
  // The first scan is the datum and keeps its guess; the others must fit to it as the truth does.
  const Pose datum_error = site_from_scan(state->results, 0) * state->truth->site_from_scan[0].inverse();
  for (std::size_t i = 1; i < 3; ++i) {
    const Pose expected = datum_error * state->truth->site_from_scan[i];
    EXPECT_LT(distance_between_m(site_from_scan(state->results, i), expected), 0.010);
    EXPECT_LT(deg_from_rad(rotation_between_rad(site_from_scan(state->results, i), expected)), 0.05);
  }
}

TEST(RunJobSlow, AJobOfOneScanWithoutDesignRunsToAReport) {
  const TemporaryFolder folder;
  tests::small_demo(folder / "demo");
  folder.write("job.json", R"({"adit": 1, "scans": [{"name": "only", "file": "demo/scans/S1.ply"}]})");
  const auto state = tests::run(folder.path());
  EXPECT_FALSE(state->results.profile);
  EXPECT_TRUE(fs::is_regular_file(folder / "out" / "report.pdf"));
  EXPECT_EQ(state->results.registration.scans[0].placed_by, "datum");
}

TEST(JobRunnerSlow, CancelAnswersWithinASecondAndLeavesFinishedSteps) {
  const TemporaryFolder folder;
  tests::small_demo(folder.path(), 250000, 2);
  app::RunOptions options;
  options.context.make_gl_context = [] { return render::make_osmesa_context(); };
  app::JobRunner runner;
  runner.start(folder / "job.json", options);
  while (runner.poll().running && runner.poll().fraction < 0.3)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const auto asked = std::chrono::steady_clock::now();
  runner.cancel();
  runner.wait();
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count(), 1.0);
  EXPECT_EQ(runner.poll().outcome, app::JobRunner::Outcome::cancelled);
  EXPECT_TRUE(fs::exists(folder / "out" / "steps" / "import.key"));
  EXPECT_FALSE(fs::exists(folder / "out" / "results.json"));
  runner.start(folder / "job.json", options);
  runner.wait();
  ASSERT_EQ(runner.poll().outcome, app::JobRunner::Outcome::done);
  EXPECT_EQ(runner.poll().state->results.timing.front().fresh, true);  // the import was kept
}

TEST(JobRunner, AFailedRunSaysWhyInOneLine) {
  const TemporaryFolder folder;
  folder.write("job.json", R"({"adit": 1, "scans": []})");
  app::JobRunner runner;
  runner.start(folder / "job.json", {});
  runner.wait();
  EXPECT_EQ(runner.poll().outcome, app::JobRunner::Outcome::failed);
  EXPECT_NE(runner.poll().error.find("scans"), std::string::npos);
  EXPECT_EQ(runner.poll().error.find('\n'), std::string::npos);
}

TEST(JobText, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  for (const char* file : {"a.ply", "c.csv", "t.csv", "x.xml", "p.dxf"}) folder.write(file, "x");
  Job job;
  job.name = "Näset & <sons>";
  job.scans.push_back(
      {"S1", "a.ply", 0, Eigen::Vector3d(612345.123456, 6998765.5, 1.0), {0.0, 0.0, rad_from_deg(90.0)}});
  job.control = "c.csv";
  job.targets = "t.csv";
  job.alignment = "x.xml";
  job.profiles.emplace_back();
  job.profiles.back().from_m = -1e9;
  job.profiles.back().file = "p.dxf";
  job.profiles.back().layer = "layer";
  job.lines = {{"a", 0.0}, {"b", 0.3}};
  job.chainage = JobChainage{10.0, 20.5, 0.5};
  job.rounds.push_back({7, 10.0, 14.0, 4.2});
  job.options.registration.spacing_m = 0.07;
  folder.write("job.json", io::job_text(job));
  const Job back = io::read_job(folder / "job.json");
  EXPECT_EQ(io::job_text(back), io::job_text(job));
  EXPECT_EQ(back.options.registration.spacing_m, 0.07);
  EXPECT_NEAR(back.scans[0].angles.roll_rad, rad_from_deg(90.0), 1e-12);
}

}  // namespace
}  // namespace adit
