#include "core/profiling/tolerance_check.h"

#include <algorithm>
#include <cmath>

#include "core/profiling/uncertainty.h"

namespace adit {
namespace {

constexpr double left_inside_m = 0.01;  // less is noise, not rock that was left
constexpr int pieces = 5;               // of a cell

struct CellPlace {
  int check = -1;  ///< which check it belongs to; none for cells beyond the line's end or without limits
  double area_m2 = 0.0;
  double over_m = 0.0;
  double two_sigma_m = 0.0;
  bool measured = false;
};

/// Over the overbreak of one check: area times what moves it.
struct MeanMoves {
  double across_m2 = 0.0, up_m2 = 0.0, distance_m2 = 0.0;
  double sigma_m3(const SurfaceSigma& sigma) const {
    return std::hypot(across_m2 * sigma.across_m, up_m2 * sigma.up_m, distance_m2 * sigma.distance_m);
  }
};

struct Checker {
  const DeviationMap& map;
  const DesignTunnel& design;
  const DesignLine& line;
  const std::vector<Sector>& sectors;
  const ToleranceSet& set;
  const std::vector<RockClassFrom>& classes;
  SurfaceSigma sigma;
  std::vector<ToleranceCheck> checks;
  std::vector<MeanMoves> moves;  ///< of each check
  std::vector<CellPlace> places;

  int check_of(const std::string& rock_class, const Eigen::Vector2d& normal) {
    const std::string& sector = sectors[sector_of(sectors, normal)].name;
    for (std::size_t i = 0; i < checks.size(); ++i)
      if (checks[i].rock_class == rock_class && checks[i].sector == sector) return static_cast<int>(i);
    const ToleranceRow* row = row_for(set, rock_class, sector);
    if (row == nullptr) return -1;
    ToleranceCheck check;
    check.rock_class = rock_class;
    check.sector = sector;
    check.limits = *row;
    checks.push_back(check);
    moves.emplace_back();
    return static_cast<int>(checks.size() - 1);
  }

  void add_row(std::size_t r) {
    const double chainage_m = map.row_chainage(r);
    const ProfileStretch stretch(design.profile_at(chainage_m));
    const std::string rock_class = rock_class_at(classes, chainage_m);
    const double offset_m = design.line_at(line, chainage_m).offset_m;
    for (std::size_t c = 0; c < stretch.columns(map.step_q_m); ++c) {
      const double q0 = static_cast<double>(c) * map.step_q_m;
      const double q1 = std::min(q0 + map.step_q_m, stretch.length_m());
      const MapCell& cell = map.cell(r, c);
      CellPlace& place = places[r * map.columns + c];
      if (cell.kind == CellKind::opening) continue;
      // A cell at the border of a sector is counted in pieces; as rock left inside it belongs where its middle is.
      for (int piece = 0; piece < pieces; ++piece) {
        const double a = q0 + (q1 - q0) * piece / pieces, b = q0 + (q1 - q0) * (piece + 1) / pieces;
        const Eigen::Vector2d normal = stretch.at(0.5 * (a + b)).normal;
        CellPlace part;
        part.check = check_of(rock_class, normal);
        if (piece == pieces / 2) place.check = part.check;
        if (part.check < 0) continue;
        part.area_m2 = stretch.line_length_m(a, b) * map.step_s_m;
        part.measured = cell.kind == CellKind::measured;
        if (part.measured) measure(part, cell, normal, offset_m);
        add_cell(part, chainage_m);
        place.area_m2 += part.area_m2;
        place.measured = part.measured;
        place.over_m = part.over_m;
        place.two_sigma_m = part.two_sigma_m;
      }
    }
  }

  void measure(CellPlace& place, const MapCell& cell, const Eigen::Vector2d& normal, double offset_m) {
    const auto incidence = static_cast<double>(cell.incidence);
    place.over_m = static_cast<double>(cell.deviation_m) - offset_m;
    place.two_sigma_m = 2.0 * std::hypot(std::sqrt(noise_squared_m2(cell)), sigma.along_normal(normal, incidence));
    if (place.over_m <= 0.0) return;
    MeanMoves& moved = moves[static_cast<std::size_t>(place.check)];
    moved.across_m2 += place.area_m2 * normal.x();
    moved.up_m2 += place.area_m2 * normal.y();
    moved.distance_m2 += place.area_m2 * incidence;
  }

  void add_cell(const CellPlace& place, double chainage_m) {
    ToleranceCheck& check = checks[static_cast<std::size_t>(place.check)];
    check.surface_m2 += place.area_m2;
    if (!place.measured) return;
    check.measured_m2 += place.area_m2;
    check.mean_overbreak_m += place.area_m2 * std::max(place.over_m, 0.0);  // divided at the end
    if (place.over_m > check.max_overbreak_m) {
      check.max_overbreak_m = place.over_m;
      check.max_overbreak_chainage_m = chainage_m;
    }
    if (-place.over_m > check.max_underbreak_m) {
      check.max_underbreak_m = -place.over_m;
      check.max_underbreak_chainage_m = chainage_m;
    }
    check.sure_overbreak_m = std::max(check.sure_overbreak_m, place.over_m - place.two_sigma_m);
    check.sure_underbreak_m = std::max(check.sure_underbreak_m, -place.over_m - place.two_sigma_m);
    if (place.over_m > check.limits.max_overbreak_m) check.over_limit_m2 += place.area_m2;
    if (-place.over_m > check.limits.max_underbreak_m) check.under_limit_m2 += place.area_m2;
  }

  /// Rock left inside the line; `surely`: by more than two sigmas.
  bool is_left(std::size_t cell, bool surely) const {
    const CellPlace& place = places[cell];
    const double least_m = left_inside_m + (surely ? place.two_sigma_m : 0.0);
    return place.check >= 0 && place.measured && place.over_m < -least_m;
  }

  /// The largest patch of rock left inside the line, for each check.
  std::vector<double> largest_patches_m2(bool surely) const {
    std::vector<double> largest_m2(checks.size(), 0.0);
    std::vector<char> taken(places.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (taken[i] != 0 || !is_left(i, surely)) continue;
      double& most_m2 = largest_m2[static_cast<std::size_t>(places[i].check)];
      most_m2 = std::max(most_m2, patch_m2(i, surely, taken));
    }
    return largest_m2;
  }

  /// The area of the patch that a cell belongs to, within its check. Its cells are then taken.
  double patch_m2(std::size_t first, bool surely, std::vector<char>& taken) const {
    const int check = places[first].check;
    std::vector<std::size_t> patch{first};
    taken[first] = 1;
    double area_m2 = 0.0;
    const auto add = [&](std::size_t other) {
      if (taken[other] != 0 || !is_left(other, surely) || places[other].check != check) return;
      taken[other] = 1;
      patch.push_back(other);
    };
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::size_t row = patch[i] / map.columns, column = patch[i] % map.columns;
      area_m2 += places[patch[i]].area_m2;
      // The map is opened at the middle of the floor: its first and last column are neighbours.
      add(row * map.columns + (column + map.columns - 1) % map.columns);
      add(row * map.columns + (column + 1) % map.columns);
      if (row > 0) add(patch[i] - map.columns);
      if (row + 1 < map.rows) add(patch[i] + map.columns);
    }
    return area_m2;
  }
};

/// Each once, as they first appear.
std::vector<std::string> classes_of(const std::vector<ToleranceCheck>& checks) {
  std::vector<std::string> classes;
  for (const ToleranceCheck& check : checks)
    if (std::find(classes.begin(), classes.end(), check.rock_class) == classes.end())
      classes.push_back(check.rock_class);
  return classes;
}

}  // namespace

std::vector<ToleranceCheck> check_tolerances(const DeviationMap& map, const DesignTunnel& design,
                                             const DesignLine& line, const std::vector<Sector>& sectors,
                                             const ToleranceSet& set, const std::vector<RockClassFrom>& classes,
                                             const RegistrationResult& registration, const ProfilingOptions& options) {
  Checker checker{map,
                  design,
                  line,
                  sectors,
                  set,
                  classes,
                  surface_sigma(registration, options),
                  {},
                  {},
                  std::vector<CellPlace>(map.cells.size())};
  for (std::size_t r = 0; r < map.rows; ++r) checker.add_row(r);
  const std::vector<double> patches_m2 = checker.largest_patches_m2(false), sure_m2 = checker.largest_patches_m2(true);
  for (std::size_t i = 0; i < checker.checks.size(); ++i) {
    ToleranceCheck& check = checker.checks[i];
    check.max_underbreak_area_m2 = patches_m2[i];
    check.sure_underbreak_area_m2 = sure_m2[i];
    if (check.measured_m2 <= 0.0) continue;
    check.mean_overbreak_m /= check.measured_m2;
    const double sigma_m = checker.moves[i].sigma_m3(checker.sigma) / check.measured_m2;
    check.sure_mean_overbreak_m = std::max(0.0, check.mean_overbreak_m - 2.0 * sigma_m);
  }
  std::vector<ToleranceCheck> ordered;
  for (const std::string& rock_class : classes_of(checker.checks))
    for (const Sector& sector : sectors)
      for (const ToleranceCheck& check : checker.checks)
        if (check.rock_class == rock_class && check.sector == sector.name) ordered.push_back(check);
  return ordered;
}

}  // namespace adit
