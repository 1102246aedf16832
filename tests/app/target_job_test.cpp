#include <gtest/gtest.h>

#include <algorithm>

#include "core/foundation/angle.h"
#include "io/atomic_file.h"
#include "io/text_file.h"
#include "tests/app/run.h"
#include "tests/temporary_folder.h"

namespace adit {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

std::string with_point_moved(const std::string& table, const std::string& id) {
  const std::size_t row = table.find("\n" + id + ",") + 1, comma = table.find(',', row) + 1;
  char east[40];
  std::snprintf(east, sizeof east, "%.4f", std::stod(table.substr(comma)) + 0.2);
  return table.substr(0, comma) + east + table.substr(table.find(',', comma));
}

std::string found_id(const Results& results, TargetKind kind) {
  for (const FoundTarget& target : results.targets.found)
    if (target.kind == kind && !target.id.empty()) return target.id;
  return "none";
}

bool is_said(const Results& results, const std::string& words) {
  const Findings findings = all_findings(results);
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.severity == Severity::decision && finding.words.find(words) != std::string::npos;
  });
}

TEST(TargetJobSlow, TargetsFoundInTheScansOfADemoPlaceThem) {
  const TemporaryFolder folder;
  app::DemoOptions options;
  options.points = 4000000;
  options.stations = 2;
  options.scan_targets = true;
  Progress progress;
  app::make_demo(folder.path(), options, progress);
  EXPECT_FALSE(fs::exists(folder / "targets.csv"));
  const auto state = tests::run(folder.path(), {}, "register");
  const Results& results = state->results;
  EXPECT_FALSE(needs_a_person(results));
  EXPECT_TRUE(results.registration.accepted);
  ASSERT_TRUE(results.truth);
  EXPECT_LT(results.truth->worst_position_error_m, 0.003);
  EXPECT_LT(deg_from_rad(results.truth->worst_rotation_error_rad), 0.02);
  for (const TargetKind kind : {TargetKind::sphere, TargetKind::quarters, TargetKind::coded})
    EXPECT_GE(std::count_if(results.targets.found.begin(), results.targets.found.end(),
                            [&](const FoundTarget& target) { return target.kind == kind && !target.id.empty(); }),
              3)
        << static_cast<int>(kind);
  for (const ControlResidual& residual : results.registration.control) EXPECT_TRUE(residual.used) << residual.id;

  // A coded target and a sphere that were moved since they were surveyed are named and not used.
  const std::string table = io::read_text_file(folder / "control.csv");
  const std::string code = found_id(results, TargetKind::coded), sphere = found_id(results, TargetKind::sphere);
  io::write_file_atomically(folder / "control.csv", with_point_moved(with_point_moved(table, code), sphere));
  const auto moved = tests::run(folder.path(), {}, "register");
  EXPECT_TRUE(is_said(moved->results, "coded target " + code + " lies "));
  EXPECT_TRUE(is_said(moved->results, "from control point " + sphere + ", on which none lies"));
  EXPECT_LT(moved->results.truth->worst_position_error_m, 0.004);

  // Spheres of another size than the job says.
  io::write_file_atomically(folder / "control.csv", table);
  std::string job = io::read_text_file(folder / "job.json");
  job.replace(job.find("0.145"), 5, "0.150");
  io::write_file_atomically(folder / "job.json", job);
  EXPECT_TRUE(is_said(tests::run(folder.path(), {}, "register")->results, "the job says 150.0"));
}

}  // namespace
}  // namespace adit
