// Scan files into point stores; the project origin.

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "app/file_name.h"
#include "app/placed_tiles.h"
#include "app/step.h"
#include "core/foundation/error.h"
#include "core/geometry/point_cloud.h"
#include "io/scan_formats.h"
#include "io/store_writer.h"

namespace adit::app {
namespace {

std::filesystem::path store_file(const JobState& state, std::size_t scan) {
  return state.out / "import" /
         (std::to_string(scan + 1) + "-" + in_file_name(state.job.scans[scan].name, 60) + ".points");
}

std::string depends_on(const JobState& state) {
  std::string text = "import 2|" + options_text(state.job.options.import);
  for (const JobScan& scan : state.job.scans)
    text +=
        "|" + scan.name + "|" + scan.file + "|" + std::to_string(scan.number) + "|" + state.input_sha256.at(scan.file);
  text += "|" + state.job.control + "|" + state.job.alignment;
  return text;
}

io::StoreOptions store_options(const JobState& state, const JobScan& scan) {
  io::StoreOptions options;
  options.name = scan.name;
  options.source_sha256 = state.input_sha256.at(scan.file);
  options.scan = static_cast<std::uint64_t>(scan.number);
  options.keep = state.job.options.import.keep == "float32" ? io::Keep::float32 : io::Keep::tenth_millimetre;
  return options;
}

/// True when the store is what an import with these options would make.
bool is_made_with(const io::PointStore& store, const io::StoreOptions& options) {
  const io::PointStoreHeader& header = store.header();
  return header.name == options.name && header.source_sha256 == options.source_sha256 && header.keep == options.keep &&
         header.source_scan == options.scan;
}

/// An import that was cut short left whole stores behind: they need not be made again.
bool is_made_already(const std::filesystem::path& file, const io::StoreOptions& options, const Progress& progress) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  try {
    const io::PointStore store(file);
    if (!is_made_with(store, options)) return false;
    store.expect_intact(progress);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// A scan in millimetres is hundreds of metres wide in every direction, and no tunnel is.
void check_unit(const io::PointStore& store, const std::string& file) {
  constexpr double widest_tunnel_m = 400.0;
  constexpr std::size_t enough_points = 100000;
  const std::size_t of_a_tile = enough_points / store.tile_count() + 1;
  PointCloud overview;
  for (std::size_t tile = 0; tile < store.tile_count(); ++tile) {
    const auto points = store.positions(tile, std::min(of_a_tile, io::overview_points(store.point_count(tile))));
    overview.points.insert(overview.points.end(), points.begin(), points.end());
  }
  const double narrowest_m = middle_extent(overview).minCoeff();
  if (narrowest_m <= widest_tunnel_m) return;
  char words[120];
  std::snprintf(words, sizeof words,
                "the points spread over %.0f m in every direction: the file seems to be in millimetres", narrowest_m);
  throw Error(words, file, "export in metres");
}

void refuse_several_scans(const std::vector<std::string>& names, const std::string& file) {
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < 5; ++i) list += (i > 0 ? ", " : "") + names[i];
  throw Error("the file holds " + std::to_string(names.size()) + " scans (" + list + (names.size() > 5 ? ", ..." : "") +
                  "); a scan of a job is one of them",
              file, "add \"scan\": 1 (2, 3, ...) beside \"file\", and one entry for each");
}

/// The store of a scan, written but for its name.
std::unique_ptr<io::StoreWriter> written_store(const JobState& state, const JobScan& scan,
                                               const std::filesystem::path& target, const io::StoreOptions& options,
                                               Progress& progress) {
  const std::filesystem::path file = state.folder / scan.file;
  auto writer = std::make_unique<io::StoreWriter>(target, options);
  Progress reading = progress.part(0.6, "reading " + scan.file);
  io::stream_scans(file, {}, *writer, reading);
  if (scan.number == 0 && writer->scans_seen().size() > 1) refuse_several_scans(writer->scans_seen(), file.string());
  if (static_cast<std::size_t>(scan.number) > writer->scans_seen().size())
    throw Error("there is no scan " + std::to_string(scan.number) + "; the file holds " +
                    std::to_string(writer->scans_seen().size()),
                file.string(), "correct \"scan\" in the job");
  if (io::stamp_of(file) != state.input_stamp.at(scan.file))
    throw Error("the file changed while it was being read", file.string(), "wait until it is whole, then run again");
  Progress writing = progress.part(0.4, "storing " + scan.name);
  writer->write(writing);
  return writer;
}

/// Null when an earlier import has made the store.
std::unique_ptr<io::StoreWriter> import_scan(const JobState& state, std::size_t index, Progress& progress) {
  const JobScan& scan = state.job.scans[index];
  const std::filesystem::path target = store_file(state, index);
  const io::StoreOptions options = store_options(state, scan);
  if (is_made_already(target, options, progress)) return nullptr;
  return written_store(state, scan, target, options, progress);
}

/// Waits for the disk, then looks at the points.
void finish_scan(const JobState& state, std::size_t index, std::unique_ptr<io::StoreWriter> written) {
  if (written) written->commit();
  written.reset();
  check_unit(io::PointStore(store_file(state, index)), (state.folder / state.job.scans[index].file).string());
}

/// Several scans at once, as many as there are threads and memory for; the next one is read while the disk takes in the
/// last. The first bad one in the order of the job is what is reported, whichever was read first.
void import_scans(const JobState& state, Progress& progress) {
  constexpr std::uint64_t bytes_a_scan = 150'000'000;  // runs, their fronts, and tiles on their way
  const std::size_t scans = state.job.scans.size();
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const auto fit = static_cast<std::size_t>(std::max<std::uint64_t>(1, state.memory_bytes / bytes_a_scan));
  const std::size_t at_once = std::min({scans, threads, fit});
  std::vector<Progress> parts;
  for (const JobScan& scan : state.job.scans)
    parts.push_back(progress.part(1.0 / static_cast<double>(scans), "reading " + scan.file));
  std::vector<std::exception_ptr> errors(scans);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  const auto keep_error_of = [&](std::size_t i, const auto& part) {
    try {
      part();
    } catch (...) {
      errors[i] = std::current_exception();
      failed = true;
    }
  };
  const auto work = [&] {
    std::future<void> finishing;  // its destructor waits
    for (std::size_t i = next++; i < scans && !failed; i = next++) {
      keep_error_of(i, [&] {
        finishing = std::async(std::launch::async, [&, i, written = import_scan(state, i, parts[i])]() mutable {
          keep_error_of(i, [&] { finish_scan(state, i, std::move(written)); });
        });
      });
    }
  };
  tbb::task_group group;
  for (std::size_t k = 0; k < at_once; ++k) group.run(work);
  group.wait();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

void open_stores(JobState& state) {
  state.stores.clear();
  for (std::size_t i = 0; i < state.job.scans.size(); ++i) {
    auto store = std::make_shared<io::PointStore>(store_file(state, i));
    if (!is_made_with(*store, store_options(state, state.job.scans[i])))
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
  if (!state.landmarks.empty()) return origin_near(state.landmarks.begin()->second);
  if (!state.ring_points.empty()) return origin_near(state.ring_points.front().place.position);
  if (state.alignment) return origin_near(state.alignment->to_site({state.stretch().from_m, 0.0, 0.0}));
  return {};
}

std::uint64_t points_of(const JobState& state, const std::string& file) {
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < state.job.scans.size(); ++i)
    if (state.job.scans[i].file == file) points += state.stores[i]->points();
  return points;
}

/// An earlier scan of the job with the same points.
std::optional<std::size_t> earlier_twin(const JobState& state, std::size_t i) {
  const auto number = [&](std::size_t scan) { return std::max(1, state.job.scans[scan].number); };
  for (std::size_t k = 0; k < i; ++k)
    if (state.stores[i]->source_sha256() == state.stores[k]->source_sha256() && number(i) == number(k)) return k;
  return std::nullopt;
}

Finding twin_finding(const JobState& state, std::size_t i, std::size_t twin) {
  const std::string other = "scan " + state.stores[twin]->name();
  if (state.job.scans[i].file == state.job.scans[twin].file)
    return {Severity::decision, "scan " + state.stores[i]->name(), "it is the same scan of the same file as " + other,
            "correct its \"scan\" or \"file\" in the job"};
  return {Severity::decision, "scan " + state.stores[i]->name(), "its file has the same content as that of " + other,
          "name the file of the other station"};
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
    if (!scanner_at_origin(*store) && !store->file_pose())
      result.findings.push_back({Severity::note, "scan " + store->name(),
                                 "the file does not say where the scanner stood; ranges are not limited", ""});
  }
  for (std::size_t i = 0; i < state.stores.size(); ++i)
    if (const auto twin = earlier_twin(state, i)) result.findings.push_back(twin_finding(state, i, *twin));
  result.findings.insert(result.findings.end(), state.input_findings.begin(), state.input_findings.end());
  state.results.import = std::move(result);
}

void make_design(JobState& state) {
  if (!state.has_design()) return;
  Drive drive;
  drive.up_chainage = state.job.driven_up_chainage;
  for (const JobRound& round : state.job.rounds) drive.rounds.push_back({round.from_m, round.to_m});
  state.design =
      DesignTunnel(*state.alignment, state.profiles, state.job.lines, state.job.turned_by_cant)
          .driven(drive)
          .standing(state.job.sections == JobSections::square ? SectionPlane::square : SectionPlane::vertical)
          .relative_to(state.results.import.origin.position);
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  std::filesystem::create_directories(state.out / "import");
  import_scans(state, progress);
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
