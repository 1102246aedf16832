#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/cleaning/no_returns.h"
#include "core/foundation/angle.h"
#include "core/geometry/nearest_neighbours.h"
#include "core/geometry/statistics.h"
#include "io/scan_formats.h"
#include "tests/app/run.h"
#include "tests/real_data.h"
#include "tests/temporary_folder.h"

namespace adit {
namespace {

using tests::TemporaryFolder;

TEST(RealJobsData, CorridorRunsToAReportAndItsWallsFallTogether) {
  ADIT_NEED_REAL_DATA();
  const TemporaryFolder folder;
  const auto state = tests::run(tests::real_data() / "corridor" / "job.json", folder / "out");
  ASSERT_EQ(state->results.registration.pairs.size(), 3U);
  for (const PairResult& pair : state->results.registration.pairs) {
    EXPECT_TRUE(pair.used);
    EXPECT_LT(pair.median_m, 0.030) << pair.source << " " << pair.target;  // from the walls, on the other scan's planes
    EXPECT_GT(pair.overlap, 0.3);
  }
  // The odometry is 2 to 3 cm and up to a degree off, and the pairs leave their loop 1.4 degrees open.
  for (std::size_t i = 0; i < 3; ++i) {
    const JobScan& scan = state->job.scans[i];
    const Pose odometry = make_pose(*scan.position, scan.angles);
    const Pose found = site_from_scan(state->results, i);
    EXPECT_LT(distance_between_m(found, odometry), 0.06) << scan.name;
    const PoseSigma& sigma = state->results.registration.scans[i].sigma;
    const double known_deg = deg_from_rad(std::hypot(sigma.roll_rad, sigma.pitch_rad, sigma.yaw_rad));
    EXPECT_LT(deg_from_rad(rotation_between_rad(found, odometry)), 1.0 + 2.0 * known_deg) << scan.name;
    EXPECT_LT(known_deg, 0.5) << scan.name;
  }
  // The floor and both walls stand about 2.5 m apart where the corridor is closed.
  ASSERT_TRUE(state->results.profile);
  double least_width = 1e9;
  for (const Section& section : state->results.profile->sections) {
    double left = -1e9, right = 1e9;
    for (const OutlinePoint& p : section.outline) {
      if (p.kind != CellKind::measured || p.position.y() < 1.2 || p.position.y() > 1.6) continue;
      if (p.position.x() < 0.0) left = std::max(left, p.position.x());
      if (p.position.x() > 0.0) right = std::min(right, p.position.x());
    }
    if (left > -1e8 && right < 1e8) least_width = std::min(least_width, right - left);
  }
  EXPECT_NEAR(least_width, 2.5, 0.25);
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "out" / "report.pdf"));
  // The pulses without an echo are gone and said.
  for (const ImportedScan& scan : state->results.import.scans) EXPECT_GT(scan.no_returns, 1000U);
}

TEST(RealJobsData, AWrongGuessInTheCorridorIsNamedAndMovesNothing) {
  ADIT_NEED_REAL_DATA();
  const auto poses = [](std::size_t wrong, const Eigen::Vector3d& off_m) {
    const TemporaryFolder folder;
    std::filesystem::copy(tests::real_data() / "corridor", folder.path(), std::filesystem::copy_options::recursive);
    nlohmann::json job = nlohmann::json::parse(std::ifstream(tests::real_data() / "corridor" / "job.json"));
    for (std::size_t i = 0; i < 3; ++i)
      job["scans"][wrong]["pose"]["position"][i] =
          job["scans"][wrong]["pose"]["position"][i].get<double>() + off_m[static_cast<Eigen::Index>(i)];
    std::filesystem::remove(folder / "job.json");
    folder.write("job.json", job.dump());
    const auto state = tests::run(folder.path(), {}, "register");
    std::vector<Pose> from_first;
    for (std::size_t i = 1; i < 3; ++i)
      from_first.push_back(site_from_scan(state->results, 0).inverse() * site_from_scan(state->results, i));
    const Findings& findings = state->results.registration.findings;
    const bool named = std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
      return f.subject == "scan S" + std::to_string(wrong + 1) && f.words.find("set aside") != std::string::npos;
    });
    EXPECT_EQ(named, !off_m.isZero());
    return from_first;
  };
  const std::vector<Pose> right = poses(0, Eigen::Vector3d::Zero());
  for (const std::size_t wrong : {0U, 1U, 2U})
    for (const Eigen::Vector3d& off_m : {Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(0, 5, 0)}) {
      const std::vector<Pose> found = poses(wrong, off_m);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(distance_between_m(found[i], right[i]), 0.02) << wrong;  // its sigma is 28 mm
        EXPECT_LT(deg_from_rad(rotation_between_rad(found[i], right[i])), 0.1) << wrong;
      }
    }
}

TEST(RealJobsData, RoomRegistersToItsKnownPose) {
  ADIT_NEED_REAL_DATA();
  const TemporaryFolder folder;
  for (const char* name : {"room_scan1.pcd", "room_scan2.pcd"})
    std::filesystem::copy_file(tests::real_data() / "room" / name, folder / name);
  folder.write("job.json", R"({"adit": 1, "scans": [
    {"name": "R1", "file": "room_scan1.pcd", "pose": {"position": [0, 0, 0]}},
    {"name": "R2", "file": "room_scan2.pcd", "pose": {"position": [1.79, 0.72, 0], "yaw_pitch_roll_deg": [39.7, 0, 0]}}]})");
  const auto state = tests::run(folder.path(), {}, "register");
  const Pose pose = site_from_scan(state->results, 0).inverse() * site_from_scan(state->results, 1);
  EXPECT_NEAR(pose.translation().x(), 1.966, 0.010);
  EXPECT_NEAR(pose.translation().y(), 0.056, 0.010);
  EXPECT_NEAR(pose.translation().z(), 0.020, 0.010);
  EXPECT_NEAR(deg_from_rad(yaw_pitch_roll(pose).yaw_rad), 40.8, 0.2);
}

/// Rings of a metro tunnel as they were published, by name: centre, chainage, deviations, radius [m].
std::map<std::string, std::vector<double>> published_rings(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>> rings;
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);  // header
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string name, number;
    std::getline(fields, name, ',');
    while (std::getline(fields, number, ',')) rings[name.substr(1)].push_back(std::stod(number));  // "R12"
  }
  return rings;
}

TEST(RealJobsData, RingsOfAMetroTunnelMeetWhatWasPublished) {
  ADIT_NEED_REAL_DATA();
  const std::filesystem::path source = tests::real_data() / "rings" / "wriggle_metro_bangkok";
  const TemporaryFolder folder;
  for (const char* name : {"derived_axis.csv", "derived_points.csv"})
    std::filesystem::copy_file(source / name, folder / name);
  folder.write("job.json", R"({"adit": 1, "alignment": "derived_axis.csv", "rings": "derived_points.csv"})");
  const auto state = tests::run(folder / "job.json");
  const auto published = published_rings(source / "derived_result.csv");
  ASSERT_EQ(state->results.rings->rings.size(), 46U);
  EXPECT_EQ(published.size(), 46U);
  for (const RingResult& ring : state->results.rings->rings) {
    const std::vector<double>& p = published.at(ring.ring);
    EXPECT_LT((ring.center - Eigen::Vector3d(p[0], p[1], p[2])).norm(), 0.0035) << ring.ring;
    EXPECT_NEAR(ring.chainage_m, p[3], 0.0035) << ring.ring;
    EXPECT_NEAR(ring.horizontal_deviation_m, p[4], 0.0005) << ring.ring;
    EXPECT_NEAR(ring.vertical_deviation_m, p[5], 0.0005) << ring.ring;
    EXPECT_NEAR(ring.radius_m, p[6], 0.0005) << ring.ring;
  }
  EXPECT_FALSE(needs_a_person(state->results));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/report.pdf"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/rings.csv"));
  const auto again = tests::run(folder / "job.json");  // taken up, with its numbers that are none
  EXPECT_EQ(again->results.rings->rings.size(), 46U);
  EXPECT_TRUE(again->results.timing.at(1).fresh);
}

}  // namespace
}  // namespace adit
