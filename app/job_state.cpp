#include "app/job_state.h"

#include <algorithm>
#include <cmath>

#include "app/job_checks.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "core/foundation/parallel.h"
#include "io/camera_file.h"
#include "io/job_json.h"
#include "io/read_axis.h"
#include "io/read_control.h"
#include "io/read_profile.h"
#include "io/read_rings.h"
#include "io/sha256.h"
#include "io/targets_csv.h"
#include "io/text_file.h"
#include "io/tolerances_json.h"
#include "io/truth_json.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const Job& job) {
  std::vector<std::string> files;
  for (const JobScan& scan : job.scans) {
    files.push_back(scan.file);
    for (const JobPicture& picture : scan.pictures) files.push_back(picture.file);
  }
  for (const JobCamera& camera : job.cameras) files.push_back(camera.file);
  for (const JobProfile& profile : job.profiles)
    if (!profile.file.empty()) files.push_back(profile.file);
  if (job.rings) files.push_back(job.rings->file);
  if (job.tolerances && !job.tolerances->file.empty()) files.push_back(job.tolerances->file);
  for (const std::string* file : {&job.control, &job.targets, &job.alignment, &job.landmarks.file})
    if (!file->empty()) files.push_back(*file);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

/// No run may write over what it reads, wherever its folder is and whatever a link in it stands for.
void expect_inputs_apart(const JobState& state, const std::vector<std::string>& files) {
  std::error_code ignored;
  const auto real = [&](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path, ignored), ignored); };
  std::vector<fs::path> inputs = {real(state.file)};
  for (const std::string& name : files) inputs.push_back(real(state.folder / name));
  for (const fs::path& input : inputs) {
    const auto refuse = [&] {
      throw Error("a run would write over this input", input.string(), "move it, or choose another folder with --out");
    };
    for (const char* name : {"mesh.ply", "map.png", "registration.csv", "sections.csv", "volumes.csv", "sectors.csv",
                             "rings.csv", "clearance.csv", "zones.csv", "circles.csv", "face.csv", "layer.csv",
                             "tolerances.csv", "results.json", "report.pdf", ".lock"})
      if (real(state.out / name) == input) refuse();
    for (const char* name : {"import", "steps", "report", "figures"}) {
      const fs::path below = input.lexically_relative(real(state.out / name));
      if (!below.empty() && *below.begin() != "..") refuse();
    }
  }
}

void add(const Findings& more, Findings& findings) {
  findings.insert(findings.end(), more.begin(), more.end());
}

void read_alignment(JobState& state) {
  const Job& job = state.job;
  if (job.alignment.empty()) return;
  const io::AxisFile file = io::read_axis(state.folder / job.alignment, job.alignment_start_m);
  state.alignment = io::choose_alignment(file, job.alignment_name);
  add(file.findings, state.input_findings);
  const io::AxisOfFile& axis = io::named_axis(file, job.alignment_name);
  if (job.turned_by_cant && axis.cant_refusal) throw Error(*axis.cant_refusal);
  add(axis.findings, state.input_findings);
}

/// Profiles stand upright: where the axis has cant, that must not pass unseen.
void look_at_cant(JobState& state) {
  constexpr double reported_m = 1e-3;
  if (!state.has_design()) return;
  if (state.job.turned_by_cant && state.alignment->cant().empty())
    throw Error("\"cant\" turns the profile, and the axis has none", state.file.string(),
                "leave it out, or export the axis with its cant");
  const JobChainage stretch = state.stretch();
  const double strongest_m = state.alignment->cant().strongest_m(stretch.from_m, stretch.to_m);
  if (strongest_m < reported_m) return;
  if (state.job.turned_by_cant) {
    state.input_findings.push_back(
        {Severity::note, "alignment " + state.alignment->name(),
         "the profile is turned with its cant of up to " + short_number(std::round(1000.0 * strongest_m)) + " mm", ""});
    return;
  }
  state.input_findings.push_back({Severity::warning, "alignment " + state.alignment->name(),
                                  "it has a cant of up to " + short_number(std::round(1000.0 * strongest_m)) +
                                      " mm here; the profile is not turned with it",
                                  "write \"cant\": \"turns_profile\" if it should be"});
}

void read_control(JobState& state) {
  if (state.job.control.empty()) return;
  io::ControlFile file = io::read_control(state.folder / state.job.control);
  state.control = std::move(file.points);
  add(file.findings, state.input_findings);
}

void read_profiles(JobState& state) {
  for (std::size_t i = 0; i < state.job.profiles.size(); ++i) {
    const JobProfile& profile = state.job.profiles[i];
    std::vector<ProfileFrom> read;
    if (profile.library.empty())
      read = io::read_profiles(state.folder / profile.file, profile.layer, profile.sizes, profile.from_m,
                               profile.interpolated);
    else
      read = {{profile.from_m, io::library_profile(profile.library, profile.sizes), profile.interpolated}};
    for (ProfileFrom& one : read) state.profiles.push_back(std::move(one));
  }
  // A file of sections may change from each to the next: the last of all has none to change into.
  const bool of_sections = state.profiles.size() > state.job.profiles.size();
  if (of_sections && !state.profiles.empty()) state.profiles.back().interpolated = false;
}

void read_rings(JobState& state) {
  if (!state.job.rings) return;
  if (!state.alignment)
    throw Error("\"rings\" without \"alignment\"", state.file.string(), "name the axis the rings belong to");
  io::RingFile file = io::read_rings(state.folder / state.job.rings->file, state.job.rings->target_offset_m);
  state.ring_points = std::move(file.points);
  add(file.findings, state.input_findings);
}

void read_tolerances(JobState& state) {
  if (!state.job.tolerances) return;
  const JobTolerances& wanted = *state.job.tolerances;
  state.tolerances =
      wanted.library.empty() ? io::read_tolerances(state.folder / wanted.file) : io::library_tolerances(wanted.library);
  if (state.tolerances->verified_by.empty())
    state.input_findings.push_back({Severity::warning, "tolerances " + state.tolerances->name,
                                    "nobody has verified this set against its source (" + state.tolerances->source +
                                        "): its verdicts are for trying out",
                                    "compare it with the contract and write \"verified_by\" into the file"});
}

/// The earlier job must have been run; whether it still holds is seen when it is taken up.
void look_at_before(JobState& state, Progress& progress) {
  if (!state.job.before) return;
  const fs::path file = before_file(state);
  std::error_code ignored;
  if (fs::equivalent(file, state.file, ignored))
    throw Error("a job cannot be compared with itself", state.file.string() + ": before", "name the earlier job");
  const auto real = [&](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path, ignored), ignored); };
  if (real(before_out(state)) == real(state.out))
    throw Error("the earlier job's results and this job's would lie in one folder", real(state.out).string(),
                "give one of them another with --out, and name the earlier one's in before.out");
  const fs::path out = before_out(state);
  const fs::path key = out / "steps" / "register.key";
  if (!fs::exists(key, ignored))
    throw Error("the earlier job has not been run", file.string(),
                "run it first: adit register " + file.string() +
                    (state.job.before->out.empty() ? "" : " --out " + out.string()));
  // All that its poses rest on, so that nothing is taken up when any of it has changed or is damaged.
  const JobState before = open_job(file, out, progress, Earlier::left_alone);
  state.before_key = io::read_text_file(key) + "|" + io::sha256_of_file(file, progress);
  for (const auto& [name, sha256] : before.input_sha256) state.before_key += "|" + name + sha256;
  std::vector<fs::path> left{out / "steps" / "register.json"};
  if (fs::is_directory(out / "import", ignored))
    for (const auto& entry : fs::directory_iterator(out / "import")) left.push_back(entry.path());
  std::sort(left.begin(), left.end());
  for (const fs::path& one : left)
    state.before_key += "|" + one.filename().string() +
                        (fs::exists(one, ignored) ? std::to_string(fs::file_size(one, ignored)) : " is gone");
}

}  // namespace

std::filesystem::path before_file(const JobState& state) {
  const fs::path file = state.folder / state.job.before->job;
  return fs::is_directory(file) ? file / "job.json" : file;
}

std::filesystem::path before_out(const JobState& state) {
  if (!state.job.before->out.empty()) return state.folder / state.job.before->out;
  return before_file(state).parent_path() / "out";
}

JobChainage JobState::stretch() const {
  if (job.chainage) return *job.chainage;
  return {alignment->from_m(), alignment->to_m(), 1.0};
}

std::string JobState::profiles_text() const {
  std::string text = job.turned_by_cant ? "|turned by cant" : "";
  if (job.sections == JobSections::square) text += "|square";
  for (const JobProfile& profile : job.profiles) {
    text += "|" + (profile.library.empty() ? input_sha256.at(profile.file) : "library " + profile.library) +
            profile.layer + short_number(profile.from_m) + (profile.interpolated ? " to next" : "");
    for (const auto& [name, size] : profile.sizes) text += " " + name + "=" + short_number(size);
  }
  return text;
}

JobState open_job(const fs::path& job_file, const fs::path& out, Progress& progress, Earlier earlier) {
  const fs::path file = fs::is_directory(job_file) ? job_file / "job.json" : job_file;
  JobState state;
  state.file = file;
  state.job = io::read_job(file);
  state.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  state.out = out.empty() ? state.folder / "out" : out;
  read_alignment(state);
  read_profiles(state);
  read_control(state);
  read_rings(state);
  read_tolerances(state);
  if (earlier == Earlier::looked_at) look_at_before(state, progress);
  for (const JobCamera& camera : state.job.cameras) state.lenses.push_back(io::read_camera(state.folder / camera.file));
  if (!state.job.landmarks.file.empty()) state.landmarks = read_landmarks(state.folder / state.job.landmarks.file);
  if (!state.job.targets.empty()) state.targets = io::read_targets_csv(state.folder / state.job.targets);
  look_at_cant(state);
  check_job(state);
  const fs::path truth = state.folder / "truth.json";
  if (fs::exists(truth)) {
    state.truth = io::read_truth(truth);
    state.input_sha256["truth.json"] = io::sha256_of_file(truth, progress);
  }
  const std::vector<std::string> files = files_of(state.job);
  expect_inputs_apart(state, files);
  for (const std::string& name : files) state.input_stamp[name] = io::stamp_of(state.folder / name);
  std::vector<std::string> hashes(files.size());
  parallel_for_each_index(
      files.size(), [&](std::size_t i) { hashes[i] = io::sha256_of_file(state.folder / files[i], progress); }, 1);
  for (std::size_t i = 0; i < files.size(); ++i) state.input_sha256[files[i]] = hashes[i];
  return state;
}

}  // namespace adit::app
