#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/text_file.h"
#include "tests/app/run.h"
#include "tests/temporary_folder.h"

namespace adit {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

bool is_said(const Results& results, const std::string& subject, const std::string& words) {
  const Findings findings = all_findings(results);
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
    return f.severity == Severity::decision && f.subject.find(subject) != std::string::npos &&
           f.words.find(words) != std::string::npos;
  });
}

/// The table with one target 20 cm beside where it hangs.
void move_landmark(const fs::path& file, const std::string& id) {
  std::istringstream lines(io::read_text_file(file));
  std::string line, text;
  while (std::getline(lines, line)) {
    if (line.rfind(id + ",", 0) == 0) {
      const std::size_t comma = line.find(',') + 1;
      const double east = std::stod(line.substr(comma)) + 0.2;
      char number[40];
      std::snprintf(number, sizeof number, "%.4f", east);
      line = id + "," + number + line.substr(line.find(',', comma));
    }
    text += line + "\n";
  }
  io::write_file_atomically(file, text);
}

TEST(PictureJobSlow, PicturesPlaceTheScansOfADemoWithoutControl) {
  const TemporaryFolder folder;
  app::DemoOptions options;
  options.points = 60000;
  options.stations = 2;
  options.control = false;
  options.pictures_in = [] { return render::make_osmesa_context(); };
  Progress progress;
  app::make_demo(folder.path(), options, progress);
  const auto state = tests::run(folder.path(), {}, "register");
  const RegistrationResult& result = state->results.registration;
  ASSERT_EQ(result.pictures.size(), 2U);
  for (const PictureResult& picture : result.pictures) {
    EXPECT_TRUE(picture.used);
    EXPECT_GE(picture.targets.size(), 6U);
    EXPECT_TRUE(picture.rejected.empty());
  }
  EXPECT_EQ(result.scans[0].placed_by, "clouds and pictures");
  EXPECT_DOUBLE_EQ(result.datum_sigma_m, 0.0);
  ASSERT_TRUE(state->results.truth);
  EXPECT_LT(state->results.truth->worst_position_error_m, 0.010);
  EXPECT_LT(deg_from_rad(state->results.truth->worst_rotation_error_rad), 0.05);

  // A target that has moved is named, and a picture of another station, too.
  move_landmark(folder / "landmarks.csv", result.pictures[0].targets[2]);
  const auto moved = tests::run(folder.path(), {}, "register");
  EXPECT_EQ(moved->results.registration.pictures[0].rejected, std::vector{result.pictures[0].targets[2]});
  EXPECT_TRUE(is_said(moved->results, "target " + result.pictures[0].targets[2], "beside its surveyed place"));
  EXPECT_LT(moved->results.truth->worst_position_error_m, 0.010);
  const std::string first = io::read_text_file(folder / "pictures" / "S1.png");
  io::write_file_atomically(folder / "pictures" / "S1.png", io::read_text_file(folder / "pictures" / "S2.png"));
  EXPECT_THROW(tests::run(folder.path(), {}, "register"), Error);  // a copy under another name
  io::write_file_atomically(folder / "pictures" / "S2.png", first);
  const auto exchanged = tests::run(folder.path(), {}, "register");
  EXPECT_TRUE(needs_a_person(exchanged->results));
  EXPECT_FALSE(exchanged->results.registration.accepted);
}

}  // namespace
}  // namespace adit
