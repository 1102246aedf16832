#include "app/job_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "app/landmarks.h"
#include "app/scan_places.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "core/profiling/overbreak.h"

namespace adit::app {
namespace {

constexpr double tolerance_m = 1e-3;
constexpr double farthest_from_axis_m = 20000.0;  // no guess or control point of a tunnel lies farther from its axis
constexpr double farthest_profile_m = 100.0;      // nor does its profile
constexpr double most_cells = 2e8;                // of the deviation map; 16 bytes each

std::string job_key(const JobState& state, const std::string& key) {
  return state.file.string() + ": " + key;
}

void check_range(const JobState& state, const std::string& key, double from_m, double to_m) {
  const Alignment& axis = *state.alignment;
  if (from_m >= axis.from_m() - tolerance_m && to_m <= axis.to_m() + tolerance_m) return;
  char words[200];
  std::snprintf(words, sizeof words, " lies outside the axis \"%s\", which runs from %.3f to %.3f",
                axis.name().substr(0, 80).c_str(), axis.from_m(), axis.to_m());
  throw Error(short_number(from_m) + " to " + short_number(to_m) + words, job_key(state, key),
              "choose chainages on the axis");
}

void check_near_axis(const JobState& state, const Eigen::Vector3d& place, const std::string& what,
                     const std::string& where) {
  const double distance = distance_to_axis_m(*state.alignment, place.head<2>());
  if (distance <= farthest_from_axis_m) return;
  const bool swapped = distance_to_axis_m(*state.alignment, {place.y(), place.x()}) <= farthest_from_axis_m;
  char words[100];
  std::snprintf(words, sizeof words, " lies %.0f km from the axis", distance / 1000.0);
  throw Error(what + words, where,
              swapped ? "east and north seem to be swapped, here or in " + state.job.alignment
                      : "check its coordinates, and those of " + state.job.alignment);
}

/// Coordinates that all lie off the axis, and all near it once east and north change places. East and north of a
/// country differ by so much that one place tells; in a local grid only all together do.
void check_not_swapped(const JobState& state, const std::vector<Eigen::Vector3d>& places, const std::string& what,
                       const std::string& where) {
  const auto near = [&](double east, double north) {
    return distance_to_axis_m(*state.alignment, {east, north}) <= farthest_scan_from_axis_m;
  };
  const auto seems_swapped = [&](const Eigen::Vector3d& p) { return !near(p.x(), p.y()) && near(p.y(), p.x()); };
  if (places.empty() || !std::all_of(places.begin(), places.end(), seems_swapped)) return;
  char words[100];
  std::snprintf(words, sizeof words, " lie far from the axis, the first %.0f m",
                distance_to_axis_m(*state.alignment, places.front().head<2>()));
  throw Error(what + words, where, "east and north seem to be swapped, here or in " + state.job.alignment);
}

/// Landmarks of another grid, or with a lost digit, would take the whole survey with them.
void check_landmarks(const JobState& state) {
  constexpr double farthest_m = 1000.0;
  std::vector<Eigen::Vector3d> places, others;
  for (const auto& [id, place] : state.landmarks) places.push_back(place);
  for (const ControlPoint& point : state.control) others.push_back(point.position);
  for (const JobScan& scan : state.job.scans)
    if (scan.position) others.push_back(*scan.position);
  const std::string file = (state.folder / state.job.landmarks.file).string();
  if (state.alignment) {
    for (const auto& [id, place] : state.landmarks) check_near_axis(state, place, "target " + std::to_string(id), file);
    check_not_swapped(state, places, "the targets", file);
  }
  if (places.empty() || others.empty()) return;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& place : places)
    for (const Eigen::Vector3d& other : others) nearest_m = std::min(nearest_m, (place - other).norm());
  if (nearest_m <= farthest_m) return;
  char words[100];
  std::snprintf(words, sizeof words, "no target lies within %.1f km of the job's poses and control",
                nearest_m / 1000.0);
  throw Error(words, file, "check whether both are of one coordinate system");
}

/// "7" and "007" are one coded target.
void check_coded_control(const JobState& state) {
  if (!state.job.scan_targets.coded) return;
  std::map<int, std::string> named;
  for (const ControlPoint& point : state.control)
    if (const auto id = target_id(point.id))
      if (const auto [first, is_new] = named.emplace(*id, point.id); !is_new)
        throw Error(
            "control points " + first->second + " and " + point.id + " are both coded target " + std::to_string(*id),
            (state.folder / state.job.control).string(), "keep one of them");
}

void check_places(const JobState& state) {
  std::vector<Eigen::Vector3d> scans, control;
  for (std::size_t i = 0; i < state.job.scans.size(); ++i) {
    const auto& position = state.job.scans[i].position;
    if (!position) continue;
    scans.push_back(*position);
    check_near_axis(state, *position, "scan " + state.job.scans[i].name,
                    job_key(state, "scans[" + std::to_string(i) + "].pose.position"));
  }
  check_not_swapped(state, scans, "the positions of the scans", job_key(state, "scans"));
  const std::string control_file = (state.folder / state.job.control).string();
  for (const ControlPoint& point : state.control) {
    control.push_back(point.position);
    check_near_axis(state, point.position, "control point " + point.id, control_file);
  }
  check_not_swapped(state, control, "the control points", control_file);
}

void check_profiles(const JobState& state) {
  if (state.profiles.back().from_m > state.alignment->to_m() + tolerance_m)
    throw Error("a profile holds from beyond the end of the axis", job_key(state, "profile"),
                "choose a \"from\" on the axis, or leave that profile out");
  for (std::size_t i = 0; i < state.profiles.size(); ++i) {
    const double distance = state.profiles[i].profile.box().exteriorDistance(Eigen::Vector2d(0.0, 0.0));
    if (distance <= farthest_profile_m) continue;
    char words[100];
    std::snprintf(words, sizeof words, "the profile lies %.0f m from the axis", distance);
    const bool one_each = state.profiles.size() == state.job.profiles.size() && !state.job.profiles[i].file.empty();
    throw Error(words, one_each ? (state.folder / state.job.profiles[i].file).string() : job_key(state, "profile"),
                "draw it about the axis: offsets and heights are counted from there");
  }
  if (state.profiles.front().interpolated && state.profiles.front().from_m <= -1e9)
    throw Error("a profile that changes into the next one needs its \"from\"", job_key(state, "profile"),
                "write the chainage from which it changes");
  if (state.stretch().from_m >= state.profiles.front().from_m - tolerance_m) return;
  char words[120];
  std::snprintf(words, sizeof words, "no profile holds before %.3f, and the job begins at %.3f",
                state.profiles.front().from_m, state.stretch().from_m);
  throw Error(words, job_key(state, "profile"), "give the first profile a smaller \"from\"");
}

/// Lines that vanish and maps that no memory holds.
void check_lines_and_cells(const JobState& state) {
  const JobChainage stretch = state.stretch();
  const auto& options = state.job.options.profiling;
  double longest = 0.0;
  for (const ProfileFrom& profile : state.profiles) {
    longest = std::max(longest, profile.profile.length_m());
    for (std::size_t i = 0; i < state.job.lines.size(); ++i) {
      try {
        DesignLine line = state.job.lines[i];
        static_cast<void>(line_polygon(profile.profile, line));
        double longest_round_m = 0.0;
        for (const JobRound& round : state.job.rounds)
          longest_round_m = std::max(longest_round_m, round.to_m - round.from_m);
        line.offset_m += line.growth_per_m * longest_round_m;
        if (line.growth_per_m != 0.0) static_cast<void>(line_polygon(profile.profile, line));
      } catch (const Error& error) {
        throw Error(error.what_is_wrong(), job_key(state, "lines[" + std::to_string(i) + "].offset"), error.mend());
      }
    }
  }
  const double cells = (stretch.to_m - stretch.from_m) / options.slice_m * longest / options.cell_m;
  if (cells <= most_cells) return;
  char words[120];
  std::snprintf(words, sizeof words, "the deviation map would hold %.0f million cells, %.0f million are the most",
                cells / 1e6, most_cells / 1e6);
  throw Error(words, job_key(state, "chainage"),
              "choose a shorter stretch, or larger slice_m and cell_m in options.profiling");
}

/// A name that nothing bears would leave its limits unused.
void check_tolerance_names(const JobState& state) {
  if (!state.tolerances) return;
  const auto& rows = state.tolerances->rows;
  const auto& sectors = state.job.sectors;
  const std::string set = "the tolerances \"" + state.tolerances->name + "\"";
  for (const ToleranceRow& row : rows)
    if (row.sector != "any" &&
        std::none_of(sectors.begin(), sectors.end(), [&](const Sector& sector) { return sector.name == row.sector; }))
      throw Error(
          set + " limit the sector \"" + row.sector + "\", which the job does not have", job_key(state, "tolerances"),
          "name it as in \"sectors\": " + [&] {
            std::string names;
            for (const Sector& sector : sectors) names += (names.empty() ? "" : ", ") + sector.name;
            return names;
          }());
  for (const RockClassFrom& rock : state.job.tolerances->rock_classes)
    if (rock.rock_class != "any" && std::none_of(rows.begin(), rows.end(), [&](const ToleranceRow& row) {
          return row.rock_class == rock.rock_class;
        }))
      throw Error(set + " do not know the rock class \"" + rock.rock_class + "\"",
                  job_key(state, "tolerances.rock_classes"), "write \"any\", or a class of the set");
}

void check_design(const JobState& state) {
  const Job& job = state.job;
  const std::string file = state.file.string();
  if (!job.profiles.empty() && !state.alignment)
    throw Error("\"profile\" without \"alignment\"", file, "name the alignment file, too");
  if (job.chainage && !state.has_design())
    throw Error("\"chainage\" without \"alignment\" and \"profile\"", file, "name both files, too");
  if (job.alignment_start_m && !state.alignment)
    throw Error("\"alignment_start\" without \"alignment\"", file, "name the alignment file, too");
  const bool for_volumes = job.turned_by_cant || job.swell > 0.0 || job.sectors != standard_sectors() ||
                           !job.zones.empty() || job.tolerances || job.before || job.face || job.straightedge;
  if (for_volumes && !state.has_design())
    throw Error(
        "\"cant\", \"swell\", \"sectors\", \"zones\", \"tolerances\", \"before\", \"face\" or \"straightedge\" without \"alignment\" and \"profile\"",
        file, "name both files, too");
  if (job.swell > 0.0 && job.rounds.empty())
    throw Error("\"swell\" without \"rounds\"", file, "it is used for the loose volume of rounds");
  for (std::size_t i = 0; i < job.lines.size(); ++i)
    if (job.lines[i].growth_per_m != 0.0 && job.rounds.empty())
      throw Error("the line \"" + job.lines[i].name + "\" grows with every round, and there are no \"rounds\"",
                  job_key(state, "lines[" + std::to_string(i) + "].look_out_per_m"), "list the rounds");
  check_tolerance_names(state);
  check_coded_control(state);
  check_landmarks(state);
  if (!state.alignment) return;
  if (job.chainage) check_range(state, "chainage", job.chainage->from_m, job.chainage->to_m);
  for (std::size_t i = 0; i < job.zones.size(); ++i)
    check_range(state, "zones[" + std::to_string(i) + "]", job.zones[i].from_m, job.zones[i].to_m);
  for (std::size_t i = 0; i < job.rounds.size(); ++i)
    check_range(state, "rounds[" + std::to_string(i) + "]", job.rounds[i].from_m, job.rounds[i].to_m);
  check_places(state);
  if (!state.has_design()) return;
  check_profiles(state);
  check_lines_and_cells(state);
}

void check_targets(const JobState& state) {
  const std::string file = (state.folder / state.job.targets).string();
  for (const auto& target : state.targets) {
    const bool known_scan = std::any_of(state.job.scans.begin(), state.job.scans.end(),
                                        [&](const JobScan& scan) { return scan.name == target.scan; });
    if (!known_scan)
      throw Error("target " + target.id + " belongs to scan \"" + target.scan + "\", which the job does not have", file,
                  "use the names of the job's scans");
    const bool known_point = std::any_of(state.control.begin(), state.control.end(),
                                         [&](const ControlPoint& point) { return point.id == target.id; });
    if (!known_point)
      throw Error("target " + target.id + " of scan " + target.scan + " has no control point", file,
                  "add it to " + state.job.control + " or remove the target");
  }
}

/// Control that lies a long way from all poses of the job: another grid, another unit, or exchanged columns.
void check_control_near_scans(const JobState& state) {
  constexpr double farthest_m = 1000.0;
  const auto nearest_m = [&](bool exchanged) {
    double nearest = std::numeric_limits<double>::max();
    for (const JobScan& scan : state.job.scans)
      for (const ControlPoint& point : state.control) {
        if (!scan.position) continue;
        const Eigen::Vector2d plan = point.position.head<2>();
        const Eigen::Vector2d place = exchanged ? Eigen::Vector2d(plan.y(), plan.x()) : plan;
        nearest = std::min(nearest, (place - scan.position->head<2>()).norm());
      }
    return nearest;
  };
  const bool any_pose =
      std::any_of(state.job.scans.begin(), state.job.scans.end(), [](const JobScan& scan) { return scan.position; });
  if (state.control.empty() || !any_pose || nearest_m(false) <= farthest_m) return;
  char words[100];
  std::snprintf(words, sizeof words, "the control points lie %.1f km from the poses of the scans",
                nearest_m(false) / 1000.0);
  throw Error(words, (state.folder / state.job.control).string(),
              nearest_m(true) <= farthest_m ? "east and north seem to be exchanged, here or in the poses"
                                            : "write both in one grid and in metres");
}

}  // namespace

void check_job(const JobState& state) {
  check_design(state);
  check_targets(state);
  check_control_near_scans(state);
}

}  // namespace adit::app
