// report.pdf and its pictures.

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <set>
#include <string>

#include "app/pair_sections.h"
#include "app/placed_tiles.h"
#include "app/step.h"
#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "render/report.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t overview_points = 120000;  // a scan
constexpr std::size_t most_pair_sections = 12;

bool wanted(const JobState&) {
  return true;
}

std::string depends_on(const JobState& state) {
  std::string text =
      "report 4|" + state.results.version + "|" + state.job.name + "|" + state.job.client + "|" + state.job.surveyor;
  for (const auto& [step, key] : state.keys) text += "|" + step + key;
  const auto truth = state.input_sha256.find("truth.json");
  return text + (truth == state.input_sha256.end() ? "" : "|" + truth->second);
}

/// Today, or the day of SOURCE_DATE_EPOCH for reports that must come out the same.
std::string report_date() {
  std::time_t now = std::time(nullptr);
  if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH"))
    now = static_cast<std::time_t>(std::strtoll(fixed, nullptr, 10));
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

render::OverviewCloud overview(const JobState& state, std::size_t scan) {
  render::OverviewCloud cloud;
  cloud.name = state.job.scans[scan].name;
  const io::PointStore& store = *state.stores[scan];
  const double share = std::min(
      1.0, static_cast<double>(overview_points) / static_cast<double>(std::max<std::uint64_t>(store.points(), 1)));
  const Pose& pose = state.results.registration.scans[scan].local_from_scan;
  const bool limited = scanner_at_origin(store);
  for (std::size_t tile = 0; tile < store.tile_count(); ++tile) {
    const auto prefix = static_cast<std::size_t>(share * static_cast<double>(store.point_count(tile)));
    for (const auto& p : store.positions(tile, prefix))
      if (!limited || static_cast<double>(p.norm()) <= state.job.options.profiling.most_range_m)
        cloud.points.push_back((pose * p.cast<double>()).cast<float>());
  }
  return cloud;
}

render::ReportContent content_of(const JobState& state, Progress& progress) {
  render::ReportContent content;
  content.job = &state.job;
  content.results = &state.results;
  if (state.design) content.design = &*state.design;
  if (state.map) content.map = &*state.map;
  if (state.change) content.change = &*state.change;
  if (state.mesh) {
    content.mesh = &state.mesh->mesh;
    content.mesh_deviations_m = state.mesh->deviation_m;
  }
  for (std::size_t i = 0; i < state.stores.size(); ++i)
    if (state.results.registration.scans[i].placed) content.clouds.push_back(overview(state, i));
  content.pair_sections = pair_sections(state, most_pair_sections, progress);
  for (ControlPoint point : state.control) {
    point.position = state.results.import.origin.to_local(point.position);
    content.control.push_back(point);
  }
  std::set<std::string> seen;
  for (const PictureResult& picture : state.results.registration.pictures) {
    seen.insert(picture.targets.begin(), picture.targets.end());
    seen.insert(picture.rejected.begin(), picture.rejected.end());
  }
  for (const auto& [id, site] : state.landmarks)
    if (seen.count(std::to_string(id)) > 0)
      content.landmarks.push_back({std::to_string(id), state.results.import.origin.to_local(site)});
  content.date = report_date();
  return content;
}

/// Those that this report may not draw again; what else lies there is not ours to touch.
void remove_old_pictures(const fs::path& folder) {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ours =
        (name.starts_with("section_") && name.ends_with(".png")) || name == "face.png" || name == "layer.png";
    if (ours && entry.is_regular_file()) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file);
}

LeftFiles run(JobState& state, const StepContext& context, Progress& progress) {
  if (!context.make_gl_context) throw Error("this program has no way to draw 3D pictures", "report", "use adit report");
  const auto gl = context.make_gl_context();
  Progress reading = progress.part(0.2, "reading points for the report");
  const render::ReportContent content = content_of(state, reading);
  Progress drawing = progress.part(0.8, "drawing the report");
  const render::ReportFiles files = render::draw_report(content, *gl, drawing);
  fs::create_directories(state.out / "report");
  remove_old_pictures(state.out / "report");
  LeftFiles left;
  for (const auto& picture : files.pictures) {
    left.push_back(picture.name == "map.png" ? fs::path(picture.name) : fs::path("report") / picture.name);
    io::write_file_atomically(state.out / left.back(), picture.png);
  }
  left.emplace_back("report.pdf");
  io::write_file_atomically(state.out / left.back(), files.pdf);
  return left;
}

void take_up(JobState&, Progress&) {}

}  // namespace

Step report_step() {
  return {"report", "drawing the report", 0.12, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
