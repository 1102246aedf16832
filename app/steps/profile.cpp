// The deviation map and the sections at every interval.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/placed_tiles.h"
#include "app/step.h"
#include "core/foundation/parallel.h"
#include "core/profiling/uncertainty.h"
#include "io/atomic_file.h"
#include "io/deviation_map_file.h"
#include "io/review_tables.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

bool wanted(const JobState& state) {
  return state.has_scans() && state.has_design() && state.results.registration.in_site;
}

std::string depends_on(const JobState& state) {
  std::string text = "profile 9|" + state.keys.at("register") + "|" + state.input_sha256.at(state.job.alignment);
  text += state.profiles_text();
  for (const DesignLine& line : state.job.lines)
    text += "|" + line.name + short_number(line.offset_m) + "," + short_number(line.growth_per_m) +
            (line.clearance ? " clear" : "");
  const bool grows = std::any_of(state.job.lines.begin(), state.job.lines.end(),
                                 [](const DesignLine& line) { return line.growth_per_m != 0.0; });
  if (grows) {
    text += state.job.driven_up_chainage ? "" : "|down";
    for (const JobRound& round : state.job.rounds) text += "|" + short_number(round.from_m) + short_number(round.to_m);
  }
  if (state.job.sections == JobSections::both) text += "|both planes";
  const JobChainage stretch = state.stretch();
  text +=
      "|" + short_number(stretch.from_m) + "|" + short_number(stretch.to_m) + "|" + short_number(stretch.interval_m);
  return text + "|" + options_text(state.job.options.profiling);
}

std::vector<Section> sections_of(const JobState& state, const DeviationMap& map, const DesignTunnel& design) {
  const JobChainage stretch = state.stretch();
  const auto chainages = section_chainages(stretch.from_m, stretch.to_m, stretch.interval_m);
  const SurfaceSigma together = surface_sigma(state.results.registration, state.job.options.profiling);
  std::vector<Section> sections(chainages.size());
  parallel_for_each_index(
      chainages.size(),
      [&](std::size_t i) {
        sections[i] = cut_section(map, design, chainages[i], state.job.options.profiling);
        sections[i].axis_site = state.results.import.origin.to_site(sections[i].axis_site);
        SectionCircle& circle = sections[i].circle;
        circle.sigma_center_m = std::hypot(circle.sigma_center_m, std::max(together.across_m, together.up_m));
        circle.sigma_radius_m = std::hypot(circle.sigma_radius_m, together.distance_m);
      },
      1);
  return sections;
}

void cut_sections(const JobState& state, ProfileResult& result) {
  result.sections = sections_of(state, *state.map, *state.design);
  if (state.square_map)
    result.square_sections = sections_of(state, *state.square_map, state.design->standing(SectionPlane::square));
}

constexpr double least_coverage = 0.6;  // volumes of a stretch that was seen less than this are not to be trusted

/// What helps against cells that were not seen. Where most of them hold points, only too few, larger cells do.
std::string mend_of_coverage(const DeviationMap& map, std::uint64_t sparse_cells, const std::string& otherwise) {
  const auto measured = static_cast<std::uint64_t>(std::count_if(
      map.cells.begin(), map.cells.end(), [](const MapCell& cell) { return cell.kind == CellKind::measured; }));
  if (sparse_cells <= measured) return otherwise;
  char words[160];
  std::snprintf(words, sizeof words,
                "the scans are too sparse for cells of %.2f x %.2f m: enlarge slice_m and cell_m in options.profiling",
                map.step_s_m, map.step_q_m);
  return words;
}

void report_weak_coverage(ProfileResult& result, const DeviationMap& map, std::uint64_t sparse_cells) {
  std::size_t weak = 0;
  double worst = 1.0, worst_chainage = 0.0, sum = 0.0;
  for (const Section& section : result.sections) {
    const double coverage = section.lines.front().coverage;
    if (coverage < 0.8) ++weak;
    sum += coverage;
    if (coverage < worst) {
      worst = coverage;
      worst_chainage = section.chainage_m;
    }
  }
  if (weak == 0) return;
  char words[160];
  std::snprintf(words, sizeof words,
                "%zu of %zu sections were seen to less than 80 %%; the least is %.0f %% at chainage %.2f", weak,
                result.sections.size(), 100.0 * worst, worst_chainage);
  result.findings.push_back(
      {Severity::warning, "sections", words, mend_of_coverage(map, sparse_cells, "add a scan there")});
  const double mean = sum / static_cast<double>(result.sections.size());
  if (mean >= least_coverage) return;
  std::snprintf(
      words, sizeof words,
      "only %.0f %% of the stretch was seen; the rest counts as excavated to the line, which nobody has measured",
      100.0 * mean);
  result.findings.push_back(
      {Severity::decision, "coverage", words,
       mend_of_coverage(map, sparse_cells, "shorten \"chainage\" to what was scanned, or scan the rest")});
}

/// Circles are given of every section of a round design, but not every section is one.
void report_poor_circles(ProfileResult& result) {
  constexpr double poor_share = 0.02;  // of the radius: rock that was drilled and blasted well is rounder
  std::size_t poor = 0, circles = 0;
  const Section* worst = nullptr;
  for (const Section& section : result.sections) {
    if (!section.circle.there) continue;
    ++circles;
    if (section.circle.rms_m <= poor_share * section.circle.radius_m) continue;
    ++poor;
    if (worst == nullptr || section.circle.rms_m > worst->circle.rms_m) worst = &section;
  }
  if (worst == nullptr) return;
  char words[200];
  std::snprintf(words, sizeof words,
                "%zu of %zu lie off by more than 2 %% of the radius (rms), the most %.0f mm at chainage %.2f: their "
                "radius and centre say little",
                poor, circles, 1e3 * worst->circle.rms_m, worst->chainage_m);
  result.findings.push_back({Severity::warning, "best circles", words, "look at circles.csv and at these sections"});
}

Finding intrusion_finding(const ClearanceResult& clearance, bool all_listed) {
  const auto deepest =
      std::max_element(clearance.intrusions.begin(), clearance.intrusions.end(),
                       [](const Intrusion& a, const Intrusion& b) { return a.deepest.inside_m < b.deepest.inside_m; });
  const bool cut = std::any_of(clearance.intrusions.begin(), clearance.intrusions.end(),
                               [](const Intrusion& intrusion) { return intrusion.cut; });
  char words[320];
  std::snprintf(
      words, sizeof words,
      "%llu points in %zu places lie inside it, the deepest by %.3f m at chainage %.2f, offset %.2f, height %.2f%s%s",
      static_cast<unsigned long long>(clearance.points), clearance.intrusions.size(), deepest->deepest.inside_m,
      deepest->deepest.at.s_m, deepest->deepest.at.x_m, deepest->deepest.at.z_m,
      cut ? "; places that reach an end of the stretch may go on beyond it" : "",
      all_listed ? "" : "; clearance.csv lists the first million of them");
  return {Severity::decision, "clearance line " + clearance.line, words,
          "look at clearance.csv: rock, or equipment that will be taken away?"};
}

/// The clearance lines of the job, with every point inside them in clearance.csv.
void check_clearances(JobState& state, ProfileResult& result, Progress& progress) {
  std::filesystem::remove(state.out / "clearance.csv");
  std::vector<DesignLine> lines;
  for (const DesignLine& line : state.job.lines)
    if (line.clearance) lines.push_back(line);
  if (lines.empty()) return;
  const std::vector<PlacedTiles> scans = placed_tiles(state);
  const ChainageIndex index(scans, state.design->alignment());
  const ProfilingOptions& options = state.job.options.profiling;
  const ProjectOrigin& origin = state.results.import.origin;
  std::string csv = io::clearance_csv_header();
  for (const DesignLine& line : lines) {
    Progress part = progress.part(1.0 / static_cast<double>(lines.size()), "clearance " + line.name);
    ClearanceResult clearance =
        find_intrusions(scans, index, *state.design, line, state.stretch().from_m, state.stretch().to_m,
                        options.least_range_m, options.most_range_m, part);
    for (Intrusion& intrusion : clearance.intrusions) intrusion.deepest_site = origin.to_site(intrusion.deepest_site);
    for (const ClearancePoint& point : clearance.list)
      csv += io::clearance_csv_row(clearance, point, scans[point.scan].name,
                                   origin.to_site(state.design->to_site(point.at)),
                                   state.design->alignment().stations().displayed_m(point.at.s_m));
    if (clearance.points > 0)
      result.findings.push_back(intrusion_finding(clearance, clearance.list.size() == clearance.points));
    clearance.list.clear();
    result.clearances.push_back(std::move(clearance));
  }
  io::write_file_atomically(state.out / "clearance.csv", csv);
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  const JobChainage stretch = state.stretch();
  Progress mapping = progress.part(0.5, "mapping deviations");
  MapResult mapped = map_deviations(placed_tiles(state), *state.design, stretch.from_m, stretch.to_m,
                                    state.job.options.profiling, mapping, state.memory_bytes / 4);
  state.map = std::move(mapped.map);
  ProfileResult result;
  result.points_used = mapped.points_used;
  result.points_inside = mapped.points_inside;
  result.points_outside = mapped.points_outside;
  result.findings = std::move(mapped.findings);
  if (state.job.sections == JobSections::both) {
    Progress leaning = progress.part(0.2, "mapping deviations square to the axis");
    state.square_map = map_deviations(placed_tiles(state), state.design->standing(SectionPlane::square), stretch.from_m,
                                      stretch.to_m, state.job.options.profiling, leaning, state.memory_bytes / 4)
                           .map;
  }
  Progress cutting = progress.part(0.1, "cutting sections");
  cut_sections(state, result);
  report_weak_coverage(result, *state.map, mapped.sparse_cells);
  report_poor_circles(result);
  Progress clearing = progress.part(0.2, "checking the clearance");
  check_clearances(state, result, clearing);
  LeftFiles left{"steps/map.bin", "steps/profile.json"};
  if (!result.clearances.empty()) left.emplace_back("clearance.csv");
  if (state.square_map) {
    io::write_deviation_map(state.out / "steps" / "map_square.bin", *state.square_map);
    left.emplace_back("steps/map_square.bin");
  }
  state.results.profile = std::move(result);
  io::write_deviation_map(state.out / "steps" / "map.bin", *state.map);
  io::write_file_atomically(step_file(state, "profile"), io::step_text(*state.results.profile));
  return left;
}

void take_up(JobState& state, Progress&) {
  ProfileResult result;
  io::read_step_text(io::read_text_file(step_file(state, "profile")), result);
  state.map = io::read_deviation_map(state.out / "steps" / "map.bin");
  if (state.job.sections == JobSections::both)
    state.square_map = io::read_deviation_map(state.out / "steps" / "map_square.bin");
  cut_sections(state, result);
  state.results.profile = std::move(result);
}

}  // namespace

Step profile_step() {
  return {"profile", "profiling", 0.12, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
