#include "app/job_state.h"

#include <algorithm>

#include "core/foundation/error.h"
#include "io/control_csv.h"
#include "io/job_json.h"
#include "io/landxml.h"
#include "io/read_profile.h"
#include "io/sha256.h"
#include "io/targets_csv.h"
#include "io/truth_json.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const Job& job) {
  std::vector<std::string> files;
  for (const JobScan& scan : job.scans) files.push_back(scan.file);
  for (const JobProfile& profile : job.profiles) files.push_back(profile.file);
  for (const std::string* file : {&job.control, &job.targets, &job.alignment})
    if (!file->empty()) files.push_back(*file);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

void read_alignment(JobState& state) {
  const Job& job = state.job;
  if (job.alignment.empty()) return;
  const io::LandXmlFile file = io::read_landxml(state.folder / job.alignment);
  state.alignment = io::choose_alignment(file, job.alignment_name);
  state.input_findings.insert(state.input_findings.end(), file.findings.begin(), file.findings.end());
  for (const auto& alignment : file.alignments)
    if (alignment.name == state.alignment->name())
      state.input_findings.insert(state.input_findings.end(), alignment.findings.begin(), alignment.findings.end());
}

void check_range(const JobState& state, const std::string& key, double from_m, double to_m) {
  constexpr double tolerance_m = 1e-3;
  const Alignment& axis = *state.alignment;
  if (from_m >= axis.from_m() - tolerance_m && to_m <= axis.to_m() + tolerance_m) return;
  char words[200];
  std::snprintf(words, sizeof words, "%.3f to %.3f lies outside the axis \"%s\", which runs from %.3f to %.3f", from_m,
                to_m, axis.name().c_str(), axis.from_m(), axis.to_m());
  throw Error(words, state.file.string() + ": " + key, "choose chainages on the axis");
}

void check_design(const JobState& state) {
  const Job& job = state.job;
  const std::string file = state.file.string();
  if (!job.profiles.empty() && !state.alignment)
    throw Error("\"profile\" without \"alignment\"", file, "name the alignment file, too");
  if (job.chainage && !state.has_design())
    throw Error("\"chainage\" without \"alignment\" and \"profile\"", file, "name both files, too");
  if (!state.alignment) return;
  if (job.chainage) check_range(state, "chainage", job.chainage->from_m, job.chainage->to_m);
  for (std::size_t i = 0; i < job.rounds.size(); ++i)
    check_range(state, "rounds[" + std::to_string(i) + "]", job.rounds[i].from_m, job.rounds[i].to_m);
}

void check_targets(const JobState& state) {
  for (const auto& target : state.targets) {
    const bool known_scan = std::any_of(state.job.scans.begin(), state.job.scans.end(),
                                        [&](const JobScan& scan) { return scan.name == target.scan; });
    if (!known_scan)
      throw Error("target " + target.id + " belongs to scan \"" + target.scan + "\", which the job does not have",
                  (state.folder / state.job.targets).string(), "use the names of the job's scans");
    const bool known_point = std::any_of(state.control.begin(), state.control.end(),
                                         [&](const ControlPoint& point) { return point.id == target.id; });
    if (!known_point)
      throw Error("target " + target.id + " of scan " + target.scan + " has no control point",
                  (state.folder / state.job.targets).string(),
                  "add it to " + state.job.control + " or remove the target");
  }
}

}  // namespace

JobChainage JobState::stretch() const {
  if (job.chainage) return *job.chainage;
  return {alignment->from_m(), alignment->to_m(), 1.0};
}

JobState open_job(const fs::path& job_file, const fs::path& out, Progress& progress) {
  const fs::path file = fs::is_directory(job_file) ? job_file / "job.json" : job_file;
  JobState state;
  state.file = file;
  state.job = io::read_job(file);
  state.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  state.out = out.empty() ? state.folder / "out" : out;
  read_alignment(state);
  for (const JobProfile& profile : state.job.profiles)
    state.profiles.push_back({profile.from_m, io::read_profile(state.folder / profile.file, profile.layer)});
  if (!state.job.control.empty()) state.control = io::read_control_csv(state.folder / state.job.control);
  if (!state.job.targets.empty()) state.targets = io::read_targets_csv(state.folder / state.job.targets);
  check_design(state);
  check_targets(state);
  const fs::path truth = state.folder / "truth.json";
  if (fs::exists(truth)) {
    state.truth = io::read_truth(truth);
    state.input_sha256["truth.json"] = io::sha256_of_file(truth, progress);
  }
  for (const std::string& name : files_of(state.job)) {
    progress.check();
    state.input_sha256[name] = io::sha256_of_file(state.folder / name, progress);
  }
  return state;
}

}  // namespace adit::app
