#include "app/run_job.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <functional>
#include <map>

#include "app/truth_comparison.h"
#include "app/version.h"
#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/csv_tables.h"
#include "io/results_json.h"
#include "io/review_tables.h"
#include "io/sha256.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr double opening_share = 0.02;
constexpr double steps_share = 0.97;

std::uint64_t half_of_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::uint64_t{4} << 30;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) / 2;
}

/// Holds out/.lock while a run writes there.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) {
    const fs::path file = folder / ".lock";
    descriptor_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
      throw Error(std::string("the folder cannot be written (") + std::strerror(errno) + ")", folder.string(),
                  errno == ENOSPC ? "free some space, or choose another with --out" : "choose another with --out");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(descriptor_);
    throw Error("another run is writing to this folder", folder.string(),
                "wait for it to end, or choose another with --out");
  }
  ~FolderLock() { ::close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

bool taken_up(JobState& state, const Step& step, const std::string& key, Progress& progress) {
  if (!StepRecord(state.out, step.name).holds(key, progress)) return false;
  try {
    step.take_up(state, progress);
    return true;
  } catch (const Error&) {
    return false;  // what an earlier run left is not whole: the step simply runs again
  }
}

void run_step(JobState& state, const Step& step, const std::string& key, const StepContext& context,
              Progress& progress) {
  const StepRecord record(state.out, step.name);
  record.remove();
  try {
    record.write(key, step.run(state, context, progress), progress);
  } catch (const Error& error) {
    throw error.where().empty() ? error.at(step.name) : error;
  }
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

bool has_circles(const ProfileResult& profile) {
  return std::any_of(profile.sections.begin(), profile.sections.end(),
                     [](const Section& section) { return section.circle.there; });
}

/// A table that not every job asks for: one that an earlier run left may not stay when this job no longer does.
void write_table(const fs::path& file, bool asked_for, const std::function<std::string()>& text) {
  std::error_code ignored;
  if (asked_for)
    io::write_file_atomically(file, text());
  else
    fs::remove(file, ignored);
}

void write_results(const JobState& state) {
  const Results& results = state.results;
  const Job& job = state.job;
  io::write_file_atomically(state.out / "results.json", io::results_text(results));
  if (state.has_scans()) io::write_file_atomically(state.out / "registration.csv", io::registration_csv(results));
  if (results.profile) {
    io::write_file_atomically(state.out / "sections.csv", io::sections_csv(results));
    write_table(state.out / "circles.csv", has_circles(*results.profile), [&] { return io::circles_csv(results); });
  }
  if (results.volume) {
    io::write_file_atomically(state.out / "volumes.csv", io::volumes_csv(results));
    io::write_file_atomically(state.out / "sectors.csv", io::sectors_csv(results));
  }
  if (results.volume || job.zones.empty())
    write_table(state.out / "zones.csv", !job.zones.empty(), [&] { return io::zones_csv(results); });
  if (results.volume || !job.tolerances)
    write_table(state.out / "tolerances.csv", job.tolerances.has_value(), [&] { return io::tolerances_csv(results); });
  if (results.compare || !job.face)
    write_table(state.out / "face.csv", job.face, [&] { return io::face_csv(*results.compare); });
  if (results.compare || !job.before)
    write_table(state.out / "layer.csv", job.before.has_value(), [&] { return io::layer_csv(*results.compare); });
  if (results.rings) io::write_file_atomically(state.out / "rings.csv", io::rings_csv(results));
}

void create_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Error("this is a file, not a folder", folder.string(), "choose another with --out");
  fs::create_directories(folder, error);
  if (error)
    throw Error("the folder cannot be made: " + error.message(), folder.string(),
                error == std::errc::no_space_on_device ? "free some space, or choose another with --out"
                                                       : "choose another with --out");
}

/// A simulated job against its truth, unless it stands in a frame of its own.
void compare_where_it_stands(JobState& state) {
  if (state.truth && state.results.registration.in_site)
    state.results.truth = compare_with_truth(state.results, *state.truth);
}

/// One step, or what an earlier run left of it. False when it is stale and nothing may run.
bool do_step(JobState& state, const Step& step, const RunOptions& options, Progress& progress) {
  if (step.name == "report") compare_where_it_stands(state);
  const std::string key = io::sha256_of_bytes(step.depends_on(state));
  state.keys[step.name] = key;
  const auto start = Clock::now();
  const bool fresh = taken_up(state, step, key, progress);
  if (!fresh && options.only_take_up) return false;
  if (!fresh) run_step(state, step, key, options.context, progress);
  state.results.timing.push_back({step.name, std::chrono::duration<double>(Clock::now() - start).count(), fresh});
  return true;
}

/// Results for people that stand in the folder and belong to a step that is not up to date or no longer wanted.
Findings stale_files(const JobState& state, const std::vector<Step>& steps, std::size_t first_stale) {
  const std::map<std::string, const char*> file_of_step{{"surface", "mesh.ply"},
                                                        {"profile", "sections.csv"},
                                                        {"volume", "volumes.csv"},
                                                        {"rings", "rings.csv"},
                                                        {"report", "report.pdf"}};
  Findings findings;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i < first_stale && steps[i].wanted(state)) continue;
    const auto file = file_of_step.find(steps[i].name);
    std::error_code ignored;
    if (file != file_of_step.end() && fs::exists(state.out / file->second, ignored))
      findings.push_back({Severity::warning, file->second, "comes from an earlier run and does not show these numbers",
                          "renew it with adit run"});
  }
  return findings;
}

}  // namespace

std::vector<double> step_bounds(const JobState& state) {
  const std::vector<Step> steps = all_steps();
  double total = 0.0;
  for (const Step& step : steps) total += step.wanted(state) ? step.share : 0.0;
  std::vector<double> bounds{opening_share};
  for (const Step& step : steps)
    bounds.push_back(bounds.back() + (step.wanted(state) ? steps_share * step.share / total : 0.0));
  return bounds;
}

std::shared_ptr<JobState> run_job(const fs::path& job_file, const RunOptions& options, Progress& progress) {
  Progress opening = progress.part(opening_share, "reading the job");
  auto state = std::make_shared<JobState>(open_job(job_file, options.out, opening));
  state->results.version = version;
  state->memory_bytes = options.memory_bytes > 0 ? options.memory_bytes : half_of_memory();
  std::optional<FolderLock> lock;
  if (!options.only_take_up) {
    create_folder(state->out);
    lock.emplace(state->out);
    create_folder(state->out / "steps");
    for (const char* folder : {"", "steps", "import", "report"}) io::remove_leftovers(state->out / folder);
  }
  const std::vector<Step> steps = all_steps();
  const std::vector<double> bounds = step_bounds(*state);
  RunOptions present = options;
  std::size_t done = 0;
  for (; done < steps.size(); ++done) {
    const Step& step = steps[done];
    if (step.wanted(*state)) {
      Progress part = progress.part(bounds[done + 1] - bounds[done], step.message);
      if (!do_step(*state, step, present, part)) break;
    } else if (step.name == options.last_step && !state->has_design()) {
      throw Error("the job has no alignment and profile, which \"" + step.name + "\" needs", job_file.string(),
                  "name both files in job.json");
    } else if (step.name == options.last_step && step.name == "compare") {
      throw Error("the job has nothing to compare", job_file.string(),
                  "name an earlier job in \"before\", or ask for \"face\" or \"straightedge\"");
    }
    if (step.name == options.last_step) present.only_take_up = true;  // what later steps left may still hold
  }
  state->results.earlier = stale_files(*state, steps, done);
  if (!state->results.truth) compare_where_it_stands(*state);
  state->results.peak_memory_bytes = peak_memory_bytes();
  if (!options.only_take_up) write_results(*state);
  return state;
}

}  // namespace adit::app
