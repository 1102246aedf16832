// Scan files into point stores; the project origin.

#include <cctype>
#include <cstdio>

#include "app/step.h"
#include "core/cleaning/no_returns.h"
#include "core/foundation/error.h"
#include "io/scan_formats.h"

namespace adit::app {
namespace {

std::filesystem::path store_file(const JobState& state, std::size_t scan) {
  std::string name = state.job.scans[scan].name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
  return state.out / "import" / (std::to_string(scan + 1) + "-" + name.substr(0, 60) + ".points");
}

std::string depends_on(const JobState& state) {
  std::string text = "import 1";
  for (const JobScan& scan : state.job.scans)
    text += "|" + scan.name + "|" + scan.file + "|" + state.input_sha256.at(scan.file);
  text += "|" + state.job.control + "|" + state.job.alignment;
  return text;
}

io::ScanData only_scan(const JobState& state, const JobScan& scan, Progress& progress) {
  std::vector<io::ScanData> scans = io::read_scans(state.folder / scan.file, {}, progress);
  if (scans.size() != 1)
    throw Error("the file holds " + std::to_string(scans.size()) + " scans; a job names one file for each scan",
                (state.folder / scan.file).string(), "take them apart with adit convert --scan N");
  return std::move(scans.front());
}

/// A scan in millimetres is hundreds of metres wide in every direction, and no tunnel is.
void check_unit(const PointCloud& cloud, const std::string& file) {
  constexpr double widest_tunnel_m = 400.0;
  const double narrowest_m = middle_extent(cloud).minCoeff();
  if (narrowest_m <= widest_tunnel_m) return;
  char words[120];
  std::snprintf(words, sizeof words,
                "the points spread over %.0f m in every direction: the file seems to be in millimetres", narrowest_m);
  throw Error(words, file, "export in metres");
}

void import_scan(JobState& state, std::size_t index, Progress& progress) {
  const JobScan& scan = state.job.scans[index];
  Progress reading = progress.part(0.6, "reading " + scan.file);
  io::ScanData data = only_scan(state, scan, reading);
  data.name = scan.name;
  if (data.offset.isZero()) data.no_returns += remove_no_returns(data.cloud);
  const std::string file = (state.folder / scan.file).string();
  if (data.cloud.empty())
    throw Error("no point is left after taking out pulses without echo", file, "check the export");
  check_unit(data.cloud, file);
  Progress writing = progress.part(0.4, "storing " + scan.name);
  io::write_point_store(store_file(state, index), std::move(data), state.input_sha256.at(scan.file), writing);
}

void open_stores(JobState& state) {
  state.stores.clear();
  for (std::size_t i = 0; i < state.job.scans.size(); ++i) {
    auto store = std::make_shared<io::PointStore>(store_file(state, i));
    if (store->source_sha256() != state.input_sha256.at(state.job.scans[i].file) ||
        store->name() != state.job.scans[i].name)
      throw Error("the stored points are those of another file", store_file(state, i).string(), "run the import again");
    state.stores.push_back(std::move(store));
  }
}

/// Whole metres near the first thing that has site coordinates.
ProjectOrigin origin_of(const JobState& state) {
  for (const JobScan& scan : state.job.scans)
    if (scan.position) return origin_near(*scan.position);
  for (const auto& store : state.stores) {
    if (store->file_pose()) return origin_near(*store->file_pose() * store->offset());
    if (!store->offset().isZero()) return origin_near(store->offset());
  }
  if (!state.control.empty()) return origin_near(state.control.front().position);
  if (state.alignment) return origin_near(state.alignment->to_site({state.stretch().from_m, 0.0, 0.0}));
  return {};
}

std::uint64_t points_of(const JobState& state, const std::string& file) {
  for (std::size_t i = 0; i < state.job.scans.size(); ++i)
    if (state.job.scans[i].file == file) return state.stores[i]->points();
  return 0;
}

void summarise(JobState& state) {
  ImportResult result;
  result.origin = origin_of(state);
  for (const auto& [file, sha256] : state.input_sha256) result.inputs.push_back({file, sha256, points_of(state, file)});
  for (const auto& store : state.stores) {
    result.scans.push_back({store->name(), store->offset(), store->points(), store->no_returns()});
    if (store->no_returns() > 0)
      result.findings.push_back({Severity::note, "scan " + store->name(),
                                 std::to_string(store->no_returns()) + " pulses without an echo were left out", ""});
    if (!store->offset().isZero() && !store->file_pose())
      result.findings.push_back({Severity::note, "scan " + store->name(),
                                 "the file does not say where the scanner stood; ranges are not limited", ""});
  }
  for (std::size_t i = 0; i < state.stores.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (state.stores[i]->source_sha256() == state.stores[k]->source_sha256())
        result.findings.push_back({Severity::decision, "scan " + state.stores[i]->name(),
                                   "its file has the same content as that of scan " + state.stores[k]->name(),
                                   "name the file of the other station"});
  result.findings.insert(result.findings.end(), state.input_findings.begin(), state.input_findings.end());
  state.results.import = std::move(result);
}

void make_design(JobState& state) {
  if (state.has_design())
    state.design = DesignTunnel(*state.alignment, state.profiles, state.job.lines)
                       .relative_to(state.results.import.origin.position);
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  std::filesystem::create_directories(state.out / "import");
  const double share = 1.0 / static_cast<double>(state.job.scans.size());
  for (std::size_t i = 0; i < state.job.scans.size(); ++i) {
    Progress part = progress.part(share, "reading " + state.job.scans[i].file);
    import_scan(state, i, part);
  }
  open_stores(state);
  summarise(state);
  make_design(state);
  return {};  // stores carry their own checksums
}

void take_up(JobState& state, Progress& progress) {
  open_stores(state);
  for (const auto& store : state.stores) store->expect_intact(progress);
  summarise(state);
  make_design(state);
}

bool wanted(const JobState&) {
  return true;
}

}  // namespace

Step import_step() {
  return {"import", "importing the scans", 0.20, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
