#include "render/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "core/foundation/error.h"
#include "render/page.h"
#include "render/picture.h"
#include "render/report_pages.h"
#include "tests/render/golden.h"
#include "tests/render/sample_job.h"

using namespace adit;
using namespace adit::render;

namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

std::size_t pages_of(const std::string& pdf) {
  return count(pdf, "/Type /Page\n") + count(pdf, "/Type /Page ");
}

bool has(const ReportFiles& files, const std::string& name) {
  return std::any_of(files.pictures.begin(), files.pictures.end(),
                     [&](const ReportPicture& p) { return p.name == name; });
}

const tests::SampleJob& sample_job() {
  static const tests::SampleJob sample;
  return sample;
}

ReportFiles report_of(const ReportContent& content) {
  const auto context = make_osmesa_context();
  Progress progress;
  return draw_report(content, *context, progress);
}

}  // namespace

TEST(ReportSlow, EverythingIsDrawnAndTheBytesAreTheSameTwice) {
  const tests::SampleJob& sample = sample_job();
  const ReportFiles first = report_of(sample.content);
  tests::keep_for_a_look("report.pdf", first.pdf);
  for (const ReportPicture& picture : first.pictures)
    if (picture.name.find("section") == std::string::npos || picture.name == "section_146.00.png")
      tests::keep_for_a_look(picture.name, picture.png);
  // Title, registration, volumes, sections' table, map, two pages of views, 41 sections by six, provenance.
  EXPECT_GE(pages_of(first.pdf), 15U);
  EXPECT_LE(pages_of(first.pdf), 20U);
  for (const char* name : {"map.png", "volumes.png", "scans_above.png", "scans_along.png", "deviation_above.png",
                           "deviation_along.png", "section_100.00.png", "section_180.00.png"})
    EXPECT_TRUE(has(first, name)) << name;
  for (const ReportPicture& picture : first.pictures)
    EXPECT_GT(picture_from_png(picture.png).width, 300) << picture.name;
  const ReportFiles second = report_of(sample.content);
  EXPECT_EQ(first.pdf, second.pdf);
  ASSERT_EQ(first.pictures.size(), second.pictures.size());
  for (std::size_t i = 0; i < first.pictures.size(); ++i)
    EXPECT_EQ(first.pictures[i].png, second.pictures[i].png) << first.pictures[i].name;
}

TEST(Report, LeavesOutWhatIsAbsentAndSaysSo) {
  Job job;
  Results results;
  ReportContent content;
  content.job = &job;
  content.results = &results;
  EXPECT_EQ(absent_parts(content).size(), 8U);
  const ReportFiles files = report_of(content);
  tests::keep_for_a_look("report_empty.pdf", files.pdf);
  EXPECT_TRUE(files.pictures.empty());
  EXPECT_LE(pages_of(files.pdf), 4U);
  EXPECT_GE(pages_of(files.pdf), 3U);
}

TEST(Report, OneScanWithoutDesign) {
  const tests::SampleJob& sample = sample_job();
  Results results;
  results.registration.accepted = true;
  results.registration.scans = {sample.results.registration.scans.front()};
  ReportContent content;
  content.job = &sample.job;
  content.results = &results;
  content.clouds = {sample.content.clouds.front()};
  const ReportFiles files = report_of(content);
  EXPECT_TRUE(has(files, "scans_above.png"));
  EXPECT_FALSE(has(files, "map.png"));
  EXPECT_TRUE(is_accepted(results));
}

TEST(Report, ManyWarningsFlowOverPages) {
  Job job;
  Results results;
  for (int i = 0; i < 150; ++i)
    results.import.findings.push_back(
        {i % 2 == 0 ? Severity::warning : Severity::decision, "section " + std::to_string(i),
         "seen to 30 % only, and these words go on for more than one line of the table", "scan again"});
  ReportContent content;
  content.job = &job;
  content.results = &results;
  EXPECT_FALSE(is_accepted(results));
  EXPECT_GE(pages_of(report_of(content).pdf), 6U);
}

TEST(Report, OneEndlessWarningDoesNotHang) {
  Job job;
  Results results;
  std::string endless;
  for (int i = 0; i < 4000; ++i) endless += "word ";
  results.import.findings.push_back({Severity::warning, "file", endless, ""});
  ReportContent content;
  content.job = &job;
  content.results = &results;
  EXPECT_LE(pages_of(report_of(content).pdf), 8U);
}

TEST(Report, RefusesWhatItCannotDraw) {
  ReportContent content;
  const auto context = make_osmesa_context();
  Progress progress;
  EXPECT_THROW(draw_report(content, *context, progress), Error);
  Job job;
  Results results;
  content.job = &job;
  content.results = &results;
  content.date = "soon";
  EXPECT_THROW(draw_report(content, *context, progress), Error);
}

TEST(Report, CanBeCancelled) {
  const tests::SampleJob& sample = sample_job();
  const std::atomic<bool> cancelled{true};
  ProgressTarget target(nullptr, &cancelled);
  Progress progress(target);
  const auto context = make_osmesa_context();
  EXPECT_THROW(draw_report(sample.content, *context, progress), Cancelled);
}

TEST(PageFlow, TakesRoomAndTurnsPages) {
  Canvas canvas = Canvas::raster(a4_width_mm, a4_height_mm, 30);
  PageFlow flow(canvas, {"job", "", "", "0.1.0", "2024-05-31", 2});
  flow.start("First");
  const double room = flow.room().height;
  const Rect first = flow.take(room - 20.0);
  EXPECT_NEAR(flow.room().height, 20.0, 1e-9);
  const Rect second = flow.take(40.0);
  EXPECT_EQ(flow.pages(), 2);
  EXPECT_NEAR(second.top, first.top, 1e-9);
}
