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

  // A coded target that was moved since it was surveyed is named and not used.
  const auto coded = std::find_if(results.targets.found.begin(), results.targets.found.end(),
                                  [](const FoundTarget& target) { return target.kind == TargetKind::coded; });
  ASSERT_NE(coded, results.targets.found.end());
  const std::string id = coded->id;
  io::write_file_atomically(folder / "control.csv", with_point_moved(io::read_text_file(folder / "control.csv"), id));
  const auto moved = tests::run(folder.path(), {}, "register");
  EXPECT_TRUE(needs_a_person(moved->results));
  const Findings findings = all_findings(moved->results);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.severity == Severity::decision &&
           finding.words.find("coded target " + id + " lies ") != std::string::npos;
  }));
  EXPECT_LT(moved->results.truth->worst_position_error_m, 0.004);
}

}  // namespace
}  // namespace adit
