// The window's own frames, with no X server: a job is opened, run, cancelled and looked at by the names of widgets.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>

#include "app/demo.h"
#include "tests/temporary_folder.h"
#include "tests/ui/headless_window.h"

namespace adit::ui {
namespace {

using tests::HeadlessWindow;
using Outcome = app::JobRunner::Outcome;
using Clock = std::chrono::steady_clock;

constexpr int width = 1440;
constexpr int height = 900;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Different colours in a part of a picture, coarsely.
std::size_t colours_in(const render::Picture& picture, int left, int top, int right, int bottom) {
  std::set<int> colours;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const auto p = picture.pixel(x, y);
      colours.insert((p[0] >> 4) << 8 | (p[1] >> 4) << 4 | p[2] >> 4);
    }
  return colours.size();
}

/// Share of pixels that differ.
double difference(const render::Picture& a, const render::Picture& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    if (a.rgba[i] != b.rgba[i] || a.rgba[i + 1] != b.rgba[i + 1] || a.rgba[i + 2] != b.rgba[i + 2]) ++different;
  return 4.0 * static_cast<double>(different) / static_cast<double>(a.rgba.size());
}

void keep(const render::Picture& picture, const std::string& name) {
  std::filesystem::create_directories(ADIT_UI_PICTURES);
  std::ofstream(std::filesystem::path(ADIT_UI_PICTURES) / name, std::ios::binary) << render::png_bytes(picture);
}

app::DemoOptions small_job() {
  app::DemoOptions options;
  options.stations = 2;
  options.points = 150000;
  return options;
}

TEST(Window, StartsWithAFieldForAJob) {
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context());
  for (int i = 0; i < 3; ++i) window.frame(workspace);
  ASSERT_TRUE(workspace.script().place("Open").has_value());
  EXPECT_FALSE(workspace.script().place("Open")->enabled) << "no path yet";
  EXPECT_FALSE(workspace.script().place("Run").has_value());
  keep(window.picture(), "ui_start.png");
  EXPECT_GT(colours_in(window.picture(), 0, 0, width, height), 5U);
}

TEST(Window, ABrokenJobIsSaidInTheWindow) {
  const tests::TemporaryFolder folder;
  const auto job = folder.write("job.json", "{ \"adit\": 1, \"name\": \"x\", \"scans\": [ { \"nam\": \"S1\" } ] }");
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context());
  workspace.open(job);
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_NE(workspace.error().find("job.json"), std::string::npos) << workspace.error();
  EXPECT_EQ(workspace.state(), nullptr);
  // It can be tried again, looked at from all sides, and left.
  workspace.script().click("Run");
  for (const char* tab : {"Map", "Sections", "Registration", "Volumes", "3D view"}) workspace.script().click(tab);
  ASSERT_TRUE(window.settle(workspace)) << "waits for " << workspace.script().waits_for();
  EXPECT_EQ(workspace.outcome(), Outcome::failed);
  keep(window.picture(), "ui_broken_job.png");
  workspace.script().click("Close job");
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_FALSE(workspace.has_job());
}

TEST(Window, AMissingJobIsSaidInTheWindow) {
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context());
  workspace.open("/nowhere/at/all");
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_NE(workspace.error().find("/nowhere/at/all"), std::string::npos) << workspace.error();
}

class WindowSlow : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<tests::TemporaryFolder>();
    Progress silent;
    app::make_demo(job(), small_job(), silent);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::filesystem::path job() { return folder_->path() / "demo"; }

  static std::unique_ptr<tests::TemporaryFolder> folder_;
};
std::unique_ptr<tests::TemporaryFolder> WindowSlow::folder_;

TEST_F(WindowSlow, CancelAnswersWithinASecond) {
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context(), folder_->path() / "cancelled");
  workspace.open(job());
  ASSERT_TRUE(window.settle(workspace));
  // In every step of a run; what is finished is taken up by the next.
  for (const double fraction : {0.03, 0.2, 0.45, 0.6, 0.75, 0.9}) {
    workspace.script().click("Run");
    window.frame(workspace);
    ASSERT_EQ(workspace.doing(), Workspace::Doing::running);
    const auto running = [&] { return workspace.doing() == Workspace::Doing::running; };
    window.frames_until(
        workspace, [&] { return !running() || workspace.fraction() >= fraction; }, 120.0);
    if (!running()) break;  // a fast machine
    const std::string where = workspace.message();
    workspace.script().click("Cancel");
    const auto start = Clock::now();
    ASSERT_TRUE(window.frames_until(
        workspace, [&] { return workspace.outcome() != Outcome::none; }, 10.0));
    EXPECT_LT(seconds_since(start), 1.0) << where;
    if (workspace.outcome() == Outcome::done) break;  // it was just ending
    EXPECT_EQ(workspace.outcome(), Outcome::cancelled);
    std::printf("cancelled in %.3f s while %s\n", seconds_since(start), where.c_str());
    ASSERT_TRUE(window.settle(workspace));
  }
}

TEST_F(WindowSlow, RunsAndShowsAJob) {
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context());
  workspace.open(job());
  ASSERT_TRUE(window.settle(workspace));
  ASSERT_NE(workspace.state(), nullptr);
  EXPECT_TRUE(workspace.error().empty()) << workspace.error();
  EXPECT_TRUE(workspace.state()->results.registration.scans.empty()) << "opening runs nothing";
  EXPECT_FALSE(workspace.section_index().has_value());

  ASSERT_TRUE(window.click(workspace, "Run"));
  EXPECT_EQ(workspace.doing(), Workspace::Doing::running) << "by the mouse";
  double fraction = 0.0;
  bool back = false, said = false;
  render::Picture running;
  const bool ended = window.frames_until(
      workspace,
      [&] {
        back = back || workspace.fraction() < fraction;
        fraction = workspace.fraction();
        said = said || !workspace.message().empty();
        if (fraction > 0.3 && running.width == 0) running = window.picture();
        return workspace.doing() == Workspace::Doing::nothing;
      },
      300.0);
  ASSERT_TRUE(ended);
  if (running.width > 0) keep(running, "ui_running.png");
  EXPECT_FALSE(back) << "the bar went back";
  EXPECT_TRUE(said);
  ASSERT_EQ(workspace.outcome(), Outcome::done) << workspace.error();
  EXPECT_TRUE(std::filesystem::exists(job() / "out" / "report.pdf"));
  ASSERT_TRUE(window.settle(workspace));
  ASSERT_TRUE(workspace.section_index().has_value());
  EXPECT_EQ(workspace.state()->results.registration.scans.size(), 2U);

  const render::Picture scans = window.picture();
  keep(scans, "ui.png");
  EXPECT_GT(colours_in(scans, 400, 60, width, height - 40), 20U) << "the 3D view is blank";

  for (const char* widget : {"Deviation", "Fit"}) workspace.script().click(widget);
  ASSERT_TRUE(window.settle(workspace));
  const render::Picture deviation = window.picture();
  keep(deviation, "ui_deviation.png");
  EXPECT_GT(difference(scans, deviation), 0.02);
  window.drag(workspace, 900.0F, 450.0F, 150.0F, 40.0F);
  window.wheel(workspace, 900.0F, 450.0F, 2.0F);
  EXPECT_GT(difference(deviation, window.picture()), 0.02) << "the mouse turns the scene";
  workspace.script().click("Along");
  ASSERT_TRUE(window.settle(workspace));
  keep(window.picture(), "ui_along.png");
  for (const char* widget : {"Scans", "    S2", "Top"}) workspace.script().click(widget);
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_EQ(workspace.scan(), 1U);
  keep(window.picture(), "ui_top.png");
}

TEST_F(WindowSlow, TakesUpWhatWasRunAndShowsEveryPanel) {
  {
    app::RunOptions options;
    options.context = HeadlessWindow::step_context();
    Progress silent;
    app::run_job(job(), options, silent);  // everything is up to date when the test before has run
  }
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context());
  workspace.open(job());
  ASSERT_TRUE(window.settle(workspace));
  ASSERT_TRUE(workspace.section_index().has_value()) << workspace.error();
  ASSERT_TRUE(workspace.state()->results.volume.has_value());
  for (const StepTime& time : workspace.state()->results.timing) EXPECT_TRUE(time.fresh) << time.step;

  const Overview overview = overview_of(*workspace.state());
  std::size_t points = 0;
  for (const auto& cloud : overview.clouds) points += cloud.points.size();
  EXPECT_GT(points, 100000U);
  EXPECT_LE(points, overview_points + 100U);
  const Eigen::Vector3d middle = workspace.state()->results.import.origin.to_local(workspace.section()->axis_site);
  for (const Eigen::Vector3d& p : ring_of(*workspace.state(), *workspace.section()))
    EXPECT_LT((p - middle).norm(), 9.0) << "the section stands about its axis";

  render::Picture before = window.picture();
  for (const char* tab : {"Map", "Sections", "Registration", "Volumes"}) {
    workspace.script().click(tab);
    ASSERT_TRUE(window.settle(workspace)) << "waits for " << workspace.script().waits_for();
    const render::Picture now = window.picture();
    keep(now, std::string("ui_") + tab + ".png");
    EXPECT_GT(difference(before, now), 0.02) << tab;
    EXPECT_GT(colours_in(now, 400, 60, width, height - 40), 5U) << tab;
    before = now;
  }

  // The cursor: by the slider, by the buttons, by a click on the map.
  workspace.script().click("Sections");
  workspace.script().set("##section", 3);
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_EQ(workspace.section_index(), 3U);
  workspace.script().click("Next");
  workspace.script().click("Next");
  workspace.script().click("Previous");
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_EQ(workspace.section_index(), 4U);
  workspace.script().click("Map");
  ASSERT_TRUE(window.settle(workspace));
  window.click_at(workspace, 1300.0F, 200.0F);
  EXPECT_GT(*workspace.section_index(), 10U);
}

TEST_F(WindowSlow, AnotherJobReplacesTheOneThatRuns) {
  HeadlessWindow window(width, height);
  Workspace workspace(HeadlessWindow::step_context(), folder_->path() / "left");
  workspace.open(job());
  ASSERT_TRUE(window.settle(workspace));
  workspace.script().click("Run");
  for (int i = 0; i < 5; ++i) window.frame(workspace);
  const auto start = Clock::now();
  workspace.open("/nowhere/at/all");  // a folder dropped onto the window
  EXPECT_LT(seconds_since(start), 1.0);
  ASSERT_TRUE(window.settle(workspace));
  EXPECT_EQ(workspace.state(), nullptr) << "the old job is not shown under the new name";
}

}  // namespace
}  // namespace adit::ui
