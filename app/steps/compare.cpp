// The surface against an earlier job's, faces, layers, and how even the surface is.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/placed_tiles.h"
#include "app/run_job.h"
#include "app/step.h"
#include "core/foundation/error.h"
#include "core/profiling/uncertainty.h"
#include "io/atomic_file.h"
#include "io/deviation_map_file.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

bool wanted(const JobState& state) {
  return state.has_scans() && state.has_design() && state.results.registration.in_site &&
         (state.job.before || state.job.face || state.job.straightedge);
}

std::string depends_on(const JobState& state) {
  const Job& job = state.job;
  std::string text = "compare 6|" + state.keys.at("profile") + "|" + state.before_key + (job.face ? "|face" : "") +
                     (job.driven_up_chainage ? "" : "|down");
  if (job.before)
    text += "|" + short_number(job.before->layer.minimum_m) + "," + short_number(job.before->layer.nominal_m);
  if (job.before)
    for (const std::string& sector : job.before->layer.sectors) text += "|layer " + sector;
  for (const Sector& sector : job.sectors)
    text += "|" + sector.name + "," + short_number(sector.from_deg) + "," + short_number(sector.to_deg);
  if (job.straightedge)
    text += "|" + short_number(job.straightedge->length_m) + "," + short_number(job.straightedge->limit_ratio);
  for (const JobRound& round : job.rounds)
    text += "|" + std::to_string(round.number) + "," + short_number(round.from_m) + "," + short_number(round.to_m) +
            "," + short_number(round.drilled_m);
  return text;
}

/// The earlier job as its own run left it.
std::shared_ptr<JobState> taken_up(const JobState& state, Progress& progress) {
  RunOptions options;
  options.out = before_out(state);
  options.last_step = "register";
  options.only_take_up = true;
  const auto before = run_job(before_file(state), options, progress);
  const auto key = before->keys.find("register");
  if (key == before->keys.end() || before->results.registration.scans.empty())
    throw Error("the earlier job has changed since it was run", before->file.string(),
                "run it again: adit register " + before->file.string());
  if (!before->results.registration.in_site)
    throw Error("the earlier job does not stand in the site: nothing ties it to control", before->file.string(),
                "give it control points, or a pose, and run it again");
  return before;
}

/// What asks for a person in the earlier job asks for one here.
void carry_decisions(const JobState& before, CompareResult& result) {
  for (const Findings* findings : {&before.results.import.findings, &before.results.registration.findings})
    for (const Finding& finding : *findings)
      if (finding.severity == Severity::decision)
        result.findings.push_back({Severity::decision, "earlier job, " + finding.subject, finding.words, finding.mend});
}

/// An edge that could be laid nowhere, or that shows more than is permitted.
void judge(const UndulationDirection& direction, const UndulationResult& undulation, const std::string& way,
           CompareResult& result) {
  char words[200];
  if (direction.places == 0) {
    std::snprintf(words, sizeof words,
                  "an edge of %.2f m could be laid nowhere %s: nothing was measured without a gap over its length",
                  undulation.straightedge_m, way.c_str());
    result.findings.push_back({Severity::warning, "straightedge", words, "use a shorter one, or scan more"});
  } else if (undulation.limit_ratio > 0.0 && direction.over_limit > 0.0) {
    std::snprintf(words, sizeof words, "%.1f %% of the places %s exceed the limit of %.3f; the greatest ratio is %.3f",
                  100.0 * direction.over_limit, way.c_str(), undulation.limit_ratio, direction.max_ratio);
    result.findings.push_back({Severity::warning, "straightedge", words, "look at \"undulation\" in results.json"});
  }
}

/// Scans of the earlier job in this job's local frame.
std::vector<PlacedTiles> placed_here(const JobState& before, const JobState& state) {
  std::vector<PlacedTiles> scans = placed_tiles(before);
  const Eigen::Vector3d shift = before.results.import.origin.position - state.results.import.origin.position;
  for (PlacedTiles& scan : scans) scan.local_from_scan.translation() += shift;
  return scans;
}

FaceMap face_of(const JobState& state, const std::vector<PlacedTiles>& scans, const std::string& epoch,
                CompareResult& result, Progress& progress) {
  FaceOptions options;
  options.least_range_m = state.job.options.profiling.least_range_m;
  options.most_range_m = state.job.options.profiling.most_range_m;
  FaceMap face = find_face(scans, ChainageIndex(scans, state.design->alignment()), *state.design, options, progress);
  const std::string drive = state.job.driven_up_chainage ? "up-chainage" : "down-chainage";
  if (face.cells.empty()) {
    result.findings.push_back({Severity::warning, "face " + epoch,
                               "no face was seen: looking " + drive + " too little of the profile ends at one place",
                               "scan the face, or look whether \"drive\" is the right way"});
    return face;
  }
  const FaceSummary summary = summarise(face);
  if (summary.share() >= 0.8) return face;
  char words[200];
  std::snprintf(
      words, sizeof words,
      "only %.0f %% of it was seen (%.1f m2 are hidden by muck, or rock left at its foot); its mean is that of "
      "the seen part",
      100.0 * summary.share(), summary.hidden_m2);
  result.findings.push_back({Severity::warning, "face " + epoch, words, "scan it after mucking"});
  return face;
}

/// The round that lies between the faces, the longest part of it at least.
const JobRound* round_between(const Job& job, const FaceVolume& between) {
  const JobRound* best = nullptr;
  double most_m = 0.5 * (between.to_m - between.from_m);
  for (const JobRound& round : job.rounds) {
    const double common_m = std::min(round.to_m, between.to_m) - std::max(round.from_m, between.from_m);
    if (common_m <= most_m) continue;
    most_m = common_m;
    best = &round;
  }
  return best;
}

/// The walls between two faces, whatever stretch the job profiles.
DeviationMap map_between(const JobState& state, const CompareResult& result, Progress& progress) {
  constexpr double known_walls_m = 12.0, beyond_m = 0.3;  // two or three rounds
  const FaceSummary first = summarise(result.face_before), second = summarise(result.face);
  const Alignment& axis = state.design->alignment();
  const double from_m = std::max(axis.from_m(), std::min(first.least_m, second.least_m) - known_walls_m);
  const double to_m = std::min(axis.to_m(), std::max(first.greatest_m, second.greatest_m) + beyond_m);
  return map_deviations(placed_tiles(state), *state.design, from_m, to_m, state.job.options.profiling, progress,
                        state.memory_bytes / 4)
      .map;
}

void compare_faces(const JobState& state, const JobState& before, CompareResult& result, Progress& progress) {
  if (result.face.cells.empty() || result.face_before.cells.empty()) return;
  result.between = volume_between(result.face_before, result.face, map_between(state, result, progress), *state.design,
                                  state.job.lines.front(), common_sigma(before.results.registration).along_m,
                                  common_sigma(state.results.registration).along_m, state.results.registration,
                                  state.job.options.profiling, progress);
  if (!result.between.whole) {
    result.findings.push_back(
        {Severity::warning, "faces",
         "the axis ends before one of them, or nothing of the walls behind them was seen: there is "
         "no volume between them",
         "export a longer axis, or scan the walls near the face"});
    return;
  }
  if (result.between.contour_share < 0.8) {
    char words[200];
    std::snprintf(words, sizeof words,
                  "of the walls between them %.0f %% of the length was seen; the rest has the outline of the nearest "
                  "walls that were, and the volume's sigma says how far outlines differ",
                  100.0 * result.between.contour_share);
    result.findings.push_back({Severity::warning, "faces", words, "scan from nearer to the face"});
  }
  if (result.between.advance_m < 0.0) {
    char words[120];
    std::snprintf(words, sizeof words, "the face of the earlier job stands %.2f m farther on than this job's",
                  -result.between.advance_m);
    result.findings.push_back(
        {Severity::decision, "faces", words, "exchange the jobs, or state \"drive\": \"down_chainage\""});
  }
  const JobRound* round = round_between(state.job, result.between);
  if (round == nullptr || round->drilled_m <= 0.0) return;
  result.round = round->number;
  result.drilled_m = round->drilled_m;
  result.left =
      rock_left(result.face, summarise(result.face_before).mean_m, round->drilled_m, state.job.driven_up_chainage);
}

void compare_surfaces(JobState& state, const JobState& before, const std::vector<PlacedTiles>& scans,
                      CompareResult& result, Progress& progress) {
  const DeviationMap& map = *state.map;
  const MapResult earlier = map_deviations(scans, *state.design, map.from_m, map.to_m, state.job.options.profiling,
                                           progress, state.memory_bytes / 4);
  const Job& job = state.job;
  MapChange change = compare_maps(earlier.map, map, *state.design, job.before->layer, job.sectors,
                                  before.results.registration, state.results.registration, job.options.profiling);
  result.layer = std::move(change.layer);
  result.change = change.change;
  state.change = std::move(change.thickness);
  if (job.before->layer.nominal_m > 0.0 && result.layer.below_minimum > 0.0) {
    char thin[200];
    std::snprintf(thin, sizeof thin, "%.1f %% of %zu square metres are thinner than the minimum of %.0f mm%s",
                  100.0 * result.layer.below_minimum, result.layer.blocks.size(), 1e3 * result.layer.design.minimum_m,
                  job.before->layer.sectors.empty() ? ", the floor and what was left bare on purpose among them" : "");
    result.findings.push_back({Severity::warning, "layer", thin,
                               job.before->layer.sectors.empty()
                                   ? "state the \"sectors\" that get the layer; look at report/layer.png and layer.csv"
                                   : "look at report/layer.png and layer.csv"});
  }
  const double share = result.layer.surface_m2 > 0.0 ? result.layer.measured_m2 / result.layer.surface_m2 : 0.0;
  if (share >= 0.6) return;
  char words[160];
  std::snprintf(words, sizeof words, "only %.0f %% of the surface was measured in both jobs", 100.0 * share);
  result.findings.push_back({Severity::warning, "layer", words, "profile the stretch that both have scanned"});
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  CompareResult result;
  LeftFiles left{"steps/compare.json"};
  Progress facing = progress.part(0.3, "looking for the face");
  if (state.job.face) result.face = face_of(state, placed_tiles(state), "of this job", result, facing);
  if (state.job.before) {
    Progress reading = progress.part(0.1, "taking up the earlier job");
    const auto before = taken_up(state, reading);
    result.before = before->job.name;
    carry_decisions(*before, result);
    const std::vector<PlacedTiles> scans = placed_here(*before, state);
    Progress comparing = progress.part(0.5, "comparing with the earlier job");
    if (state.job.face) {
      result.face_before = face_of(state, scans, "of the earlier job", result, comparing);
      compare_faces(state, *before, result, comparing);
    }
    compare_surfaces(state, *before, scans, result, comparing);
    io::write_deviation_map(state.out / "steps" / "change.bin", *state.change);
    left.emplace_back("steps/change.bin");
  }
  if (state.job.straightedge) {
    result.undulation =
        undulation(*state.map, *state.design, state.job.straightedge->length_m, state.job.straightedge->limit_ratio);
    judge(result.undulation.along, result.undulation, "along the axis", result);
    judge(result.undulation.around, result.undulation, "around the profile", result);
  }
  state.results.compare = std::move(result);
  io::write_file_atomically(step_file(state, "compare"), io::step_text(*state.results.compare));
  return left;
}

void take_up(JobState& state, Progress&) {
  CompareResult result;
  io::read_step_text(io::read_text_file(step_file(state, "compare")), result);
  if (state.job.before) state.change = io::read_deviation_map(state.out / "steps" / "change.bin");
  state.results.compare = std::move(result);
}

}  // namespace

Step compare_step() {
  return {"compare", "comparing", 0.08, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
