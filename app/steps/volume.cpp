// Volumes of the stretch and of every round, against every line.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "app/step.h"
#include "core/profiling/mesh_volume.h"
#include "io/atomic_file.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

bool wanted(const JobState& state) {
  return state.has_scans() && state.has_design() && state.results.registration.in_site;
}

std::string depends_on(const JobState& state) {
  std::string text = "volume 12|" + state.keys.at("profile");
  if (const auto surface = state.keys.find("surface"); surface != state.keys.end()) text += "|" + surface->second;
  for (const JobRound& round : state.job.rounds)
    text += "|" + std::to_string(round.number) + "," + short_number(round.from_m) + "," + short_number(round.to_m) +
            "," + short_number(round.drilled_m);
  for (const Sector& sector : state.job.sectors)
    text += "|" + sector.name + "," + short_number(sector.from_deg) + "," + short_number(sector.to_deg);
  for (const ReasonZone& zone : state.job.zones)
    text += "|" + short_number(zone.from_m) + "," + short_number(zone.to_m) + "," + short_number(zone.from_deg) + "," +
            short_number(zone.to_deg) + zone.reason + zone.note;
  if (state.tolerances) {
    const JobTolerances& wanted = *state.job.tolerances;
    text += "|" + (wanted.file.empty() ? "library " + wanted.library : state.input_sha256.at(wanted.file));
    for (const RockClassFrom& rock : wanted.rock_classes) text += "|" + short_number(rock.from_m) + rock.rock_class;
  }
  return text + "|" + short_number(state.job.swell);
}

/// The mesh's own opinion; where it is far from the slices a person should look.
void add_mesh(const std::optional<MeshInTunnel>& mesh, const std::string& subject, Volume& volume, Findings& findings) {
  constexpr double far_share = 0.005, far_sigmas = 3.0;
  if (!mesh) return;
  volume.mesh = mesh->between(volume.from_m, volume.to_m);
  const double off_m3 = volume.mesh.excavated_m3 - volume.slices.excavated_m3;
  const double far_m3 = far_share * volume.slices.excavated_m3 + far_sigmas * volume.sigma_excavated_m3;
  if (!volume.mesh.closed || std::abs(off_m3) <= far_m3) return;
  char words[160];
  std::snprintf(words, sizeof words,
                "the surface mesh holds %.2f m3 %s than the slices; %.1f m2 of its holes were closed by triangles",
                std::abs(off_m3), off_m3 > 0.0 ? "more" : "less", volume.mesh.filled_m2);
  findings.push_back({Severity::warning, subject, words, "look at the sections where much was not seen"});
}

/// The sectors of a volume; what they lack to its whole is a fault unless the outline folds.
void add_sectors(const JobState& state, const DesignLine& line, const std::string& subject, Volume& volume,
                 Findings& findings) {
  constexpr double least_m3 = 0.01, share = 0.005;
  volume.sectors = sector_volumes(*state.map, *state.design, line, state.job.sectors, volume.from_m, volume.to_m,
                                  state.job.options.profiling.gap_m);
  double over = 0.0;
  for (const SectorVolume& sector : volume.sectors) over += sector.overbreak_m3;
  const double off = over - volume.slices.overbreak_m3;
  if (std::abs(off) <= least_m3 + share * volume.slices.overbreak_m3) return;
  findings.push_back({Severity::warning, subject,
                      "the overbreak of its sectors differs from the whole by " +
                          short_number(std::round(off * 100.0) / 100.0) + " m3: its outline folds over itself",
                      "use the whole; look at the sections where rock stands behind rock"});
}

void add_round(JobState& state, const JobRound& round, const std::optional<MeshInTunnel>& mesh, VolumeResult& result,
               Progress& progress) {
  const DeviationMap& map = *state.map;
  const double from = std::max(round.from_m, map.from_m);
  const double to = std::min(round.to_m, map.to_m);
  const std::string subject = "round " + std::to_string(round.number);
  if (to - from < 0.01) {
    result.findings.push_back(
        {Severity::warning, subject, "lies outside the profiled chainage and has no volumes", "extend \"chainage\""});
    return;
  }
  if (to - from < round.to_m - round.from_m - 1e-6) {
    char words[120];
    std::snprintf(words, sizeof words, "is profiled from %.3f to %.3f only, not over its whole length", from, to);
    result.findings.push_back({Severity::warning, subject, words, "extend \"chainage\""});
  }
  RoundVolume volume;
  volume.number = round.number;
  volume.drilled_m = round.drilled_m;
  volume.volume = compute_volume(map, *state.design, state.job.lines.front(), from, to, state.stretch().interval_m,
                                 state.results.registration, state.job.options.profiling, progress);
  volume.pull_m = round.to_m - round.from_m;
  if (round.drilled_m > 0.0 && volume.pull_m > 1.2 * round.drilled_m)
    result.findings.push_back({Severity::warning, subject, "is much longer than it was drilled: its pull is over 120 %",
                               "check \"drilled\" and the ends of the round"});
  volume.loose_m3 = state.job.swell * volume.volume.slices.excavated_m3;
  volume.review =
      review_round(map, *state.design, state.job.lines.front(), from, to, state.job.options.profiling.gap_m);
  add_sectors(state, state.job.lines.front(), subject, volume.volume, result.findings);
  add_mesh(mesh, subject, volume.volume, result.findings);
  result.rounds.push_back(std::move(volume));
}

void add_zones(const JobState& state, VolumeResult& result) {
  result.zones = zone_volumes(*state.map, *state.design, state.job.lines.front(), state.job.zones,
                              state.job.options.profiling.gap_m);
  for (std::size_t i = 0; i < result.zones.size(); ++i)
    if (result.zones[i].amounts.surface_m2 <= 0.0)
      result.findings.push_back({Severity::warning, "zone " + std::to_string(i + 1),
                                 "lies outside the profiled chainage and has no volume", "extend \"chainage\""});
}

Finding tolerance_finding(const ToleranceCheck& check, const DesignLine& line) {
  std::string words = "rock class " + check.rock_class + ", against " + line.name + ": ";
  if (check.beyond()) {
    const auto add = [&](const char* what, double value, double sure, double limit, const char* unit) {
      if (value <= limit) return;
      char one[160];
      std::snprintf(one, sizeof one, "%s %.4f %s of %.4f %s permitted%s", what, value, unit, limit, unit,
                    sure > limit ? "" : " (undecided: less than two sigmas)");
      words += (words.ends_with(": ") ? "" : ", ") + std::string(one);
    };
    const ToleranceRow& limits = check.limits;
    add("mean overbreak", check.mean_overbreak_m, check.sure_mean_overbreak_m, limits.mean_overbreak_m, "m");
    add("overbreak", check.max_overbreak_m, check.sure_overbreak_m, limits.max_overbreak_m, "m");
    add("underbreak", check.max_underbreak_m, check.sure_underbreak_m, limits.max_underbreak_m, "m");
    add("a piece left inside", check.max_underbreak_area_m2, check.sure_underbreak_area_m2,
        limits.max_underbreak_area_m2, "m2");
    return {Severity::warning, "tolerance of " + check.sector, words, "look at the map and at tolerances.csv"};
  }
  char seen[120];
  std::snprintf(seen, sizeof seen, "nothing beyond its tolerance, but only %.0f %% of it was seen",
                100.0 * check.coverage());
  return {Severity::warning, "tolerance of " + check.sector, words + seen, "scan the rest"};
}

void add_tolerances(const JobState& state, VolumeResult& result) {
  if (!state.tolerances) return;
  const ToleranceSet& set = *state.tolerances;
  result.tolerances = {
      set.name, set.source, set.verified_by,
      check_tolerances(*state.map, *state.design, state.job.lines.front(), state.job.sectors, set,
                       state.job.tolerances->rock_classes, state.results.registration, state.job.options.profiling)};
  if (result.tolerances.checks.empty())
    result.findings.push_back({Severity::warning, "tolerances " + set.name,
                               "none of its rows is for a rock class of this stretch: nothing was checked",
                               "state \"rock_classes\", or add a row for \"any\""});
  for (const ToleranceCheck& check : result.tolerances.checks)
    if (check.verdict() != ToleranceVerdict::kept)
      result.findings.push_back(tolerance_finding(check, state.job.lines.front()));
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  VolumeResult result;
  const DeviationMap& map = *state.map;
  std::optional<MeshInTunnel> mesh;
  if (state.mesh) mesh.emplace(state.mesh->mesh, *state.design);
  const double share = 1.0 / static_cast<double>(state.job.lines.size() + state.job.rounds.size());
  for (const DesignLine& line : state.job.lines) {
    if (line.clearance) continue;  // nothing is measured against it
    Progress part = progress.part(share, "volumes against " + line.name);
    result.lines.push_back(compute_volume(map, *state.design, line, map.from_m, map.to_m, state.stretch().interval_m,
                                          state.results.registration, state.job.options.profiling, part));
    add_sectors(state, line, "volume " + line.name, result.lines.back(), result.findings);
    if (result.lines.size() == 1) add_mesh(mesh, "volume " + line.name, result.lines.back(), result.findings);
    const Volume& volume = result.lines.back();
    if (std::abs(volume.closure_m3) > 1e-3)
      result.findings.push_back(
          {Severity::decision, "volume " + line.name,
           "excavated less design differs from over less under by " + short_number(volume.closure_m3) + " m3",
           "report this as a fault of Adit"});
  }
  for (const JobRound& round : state.job.rounds) {
    Progress part = progress.part(share, "round " + std::to_string(round.number));
    add_round(state, round, mesh, result, part);
  }
  add_zones(state, result);
  add_tolerances(state, result);
  state.results.volume = std::move(result);
  io::write_file_atomically(step_file(state, "volume"), io::step_text(*state.results.volume));
  return {"steps/volume.json"};
}

void take_up(JobState& state, Progress&) {
  VolumeResult result;
  io::read_step_text(io::read_text_file(step_file(state, "volume")), result);
  state.results.volume = std::move(result);
}

}  // namespace

Step volume_step() {
  return {"volume", "computing volumes", 0.06, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
