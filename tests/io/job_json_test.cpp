#include "io/job_json.h"
#include "core/georeference/camera_rig.h"

#include <gtest/gtest.h>

#include "core/georeference/camera_rig.h"
#include "io/atomic_file.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

TEST(JobJson, EverythingOfTheDesignComesBackFromItsText) {
  const tests::TemporaryFolder folder;
  for (const char* file : {"s1.ply", "axis.xml", "profile.dxf", "t.json", "earlier.json"})
    write_file_atomically(folder.path() / file, "x");
  Job job;
  job.name = "whole";
  job.scans = {{"S1", "s1.ply", 0, std::nullopt, {}, {}}};
  job.alignment = "axis.xml";
  job.profiles = {{0.0, "profile.dxf", "", "", {}, false}};
  job.lines = {{"excavation", 0.0}, {"envelope", 0.05, 0.06}, {"clearance", -0.2, 0.0, true}};
  job.chainage = JobChainage{10.0, 30.0, 2.0};
  job.rounds = {{7, 12.0, 16.0, 4.2}};
  job.driven_up_chainage = false;
  job.sections = JobSections::both;
  job.zones = {{12.0, 13.0, -30.0, 60.0, "geological", "clay"}, {14.0, 15.0, -180.0, 180.0, "technical", ""}};
  job.tolerances = JobTolerances{"t.json", "", {{10.0, "A"}, {20.0, "B"}}};
  job.before = JobBefore{"earlier.json", "earlier_out", {0.05, 0.07, {"upper"}}};
  job.face = true;
  job.straightedge = JobStraightedge{3.0, 0.2};
  job.sectors = {{"upper", -90.0, 90.0}, {"lower", 90.0, -90.0}};
  job.swell = 1.6;
  write_file_atomically(folder.path() / "job.json", job_text(job));
  const Job back = read_job(folder.path() / "job.json");
  EXPECT_EQ(job_text(back), job_text(job));
  EXPECT_EQ(back.lines, job.lines);
  EXPECT_EQ(back.zones, job.zones);
  EXPECT_FALSE(back.driven_up_chainage);
  EXPECT_EQ(back.sections, JobSections::both);
  EXPECT_EQ(back.tolerances->rock_classes, job.tolerances->rock_classes);
  EXPECT_EQ(back.before->layer, job.before->layer);
  EXPECT_EQ(back.before->out, "earlier_out");
  EXPECT_EQ(back.straightedge->limit_ratio, 0.2);
  EXPECT_EQ(back.sectors, job.sectors);
}

TEST(JobJson, TargetsCamerasAndPicturesComeBackFromTheirText) {
  const tests::TemporaryFolder folder;
  for (const char* file : {"s1.ply", "a.png", "b.png", "cam.yaml", "landmarks.csv", "control.csv", "targets.csv"})
    write_file_atomically(folder.path() / file, "x");
  Job job;
  job.name = "pictures";
  job.scans = {{"S1", "s1.ply", 0, std::nullopt, {}, {{"a.png", "left"}, {"b.png", "right"}}}};
  job.control = "control.csv";
  job.targets = "targets.csv";
  job.scan_targets = {0.145, true, false};
  job.cameras = {{"left", "cam.yaml", {0.1, 0.2, 0.3}, {0.5, -0.25, 0.125}, 0.004, 0.001},
                 {"right", "cam.yaml", {0.1, -0.2, 0.3}, {}, 0.002, 0.0005}};
  job.landmarks = {"landmarks.csv", 0.001, true};
  write_file_atomically(folder.path() / "job.json", job_text(job));
  const Job back = read_job(folder.path() / "job.json");
  EXPECT_EQ(job_text(back), job_text(job));
  ASSERT_EQ(back.cameras.size(), 2U);
  EXPECT_NEAR(back.cameras[0].angles.pitch_rad, -0.25, 1e-12);
  EXPECT_NEAR(back.cameras[0].sigma_rad, 0.001, 1e-12);
  EXPECT_EQ(back.scans[0].pictures[1].camera, "right");
  EXPECT_TRUE(back.landmarks.no_others);
  EXPECT_EQ(back.targets, "targets.csv");
  EXPECT_EQ(back.scan_targets.sphere_diameter_m, 0.145);
  EXPECT_TRUE(back.scan_targets.quarters);
  EXPECT_FALSE(back.scan_targets.coded);
}

TEST(JobJson, ALeverArmOfTheResultsIsTheSameOneByAngles) {
  const tests::TemporaryFolder folder;
  for (const char* file : {"s1.ply", "cam.yaml"}) write_file_atomically(folder.path() / file, "x");
  const YawPitchRoll angles{0.5, -0.25, 0.125};
  const Pose lever = lever_arm({0.1, -0.2, 0.3}, angles);
  std::string numbers, rounded;
  for (int i = 0; i < 16; ++i) {
    char number[40];
    std::snprintf(number, sizeof number, "%s%.17g", i == 0 ? "" : ", ", lever.matrix()(i / 4, i % 4));
    numbers += number;
    std::snprintf(number, sizeof number, "%s%.4f", i == 0 ? "" : ", ", lever.matrix()(i / 4, i % 4));
    rounded += number;
  }
  const auto job_of = [&](const std::string& sixteen) {
    write_file_atomically(folder.path() / "job.json",
                          R"({"adit": 1, "name": "lever", "scans": [{"name": "S1", "file": "s1.ply"}],
                              "cameras": [{"file": "cam.yaml", "scan_from_camera": [)" +
                              sixteen + "]}]}");
    return read_job(folder.path() / "job.json");
  };
  const Job job = job_of(numbers);
  ASSERT_EQ(job.cameras.size(), 1U);
  const JobCamera& camera = job.cameras.front();
  EXPECT_TRUE(lever_arm(camera.position, camera.angles).isApprox(lever, 1e-12));
  EXPECT_NEAR(camera.angles.roll_rad, 0.125, 1e-12);
  // With digits cut off, as people copy them.
  const JobCamera near = job_of(rounded).cameras.front();
  EXPECT_LT(rotation_between_rad(lever_arm(near.position, near.angles), lever), 2e-4);
}

}  // namespace
}  // namespace adit::io
