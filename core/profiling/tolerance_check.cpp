#include "core/profiling/tolerance_check.h"

#include <algorithm>

namespace adit {
namespace {

constexpr double left_inside_m = 0.01;  // less is noise, not rock that was left

struct CellPlace {
  int check = -1;  ///< which check it belongs to; none for cells beyond the line's end or without limits
  double area_m2 = 0.0;
  double over_m = 0.0;
  bool measured = false;
};

struct Checker {
  const DeviationMap& map;
  const DesignTunnel& design;
  const DesignLine& line;
  const std::vector<Sector>& sectors;
  const ToleranceSet& set;
  const std::vector<RockClassFrom>& classes;
  std::vector<ToleranceCheck> checks;
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
      place.check = check_of(rock_class, stretch.at(0.5 * (q0 + q1)).normal);
      if (place.check < 0) continue;
      place.area_m2 = stretch.line_length_m(q0, q1) * map.step_s_m;
      place.measured = cell.kind == CellKind::measured;
      if (place.measured) place.over_m = static_cast<double>(cell.deviation_m) - offset_m;
      add_cell(place, chainage_m);
    }
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
    if (place.over_m > check.limits.max_overbreak_m) check.over_limit_m2 += place.area_m2;
    if (-place.over_m > check.limits.max_underbreak_m) check.under_limit_m2 += place.area_m2;
  }

  bool is_left(std::size_t cell) const {
    return places[cell].check >= 0 && places[cell].measured && places[cell].over_m < -left_inside_m;
  }

  /// The area of the patch of rock left inside the line that a cell belongs to, within its check. Its cells are then
  /// taken out.
  double take_patch(std::size_t first) {
    const int check = places[first].check;
    std::vector<std::size_t> patch{first};
    places[first].measured = false;
    double area_m2 = 0.0;
    const auto add = [&](std::size_t other) {
      if (!is_left(other) || places[other].check != check) return;
      places[other].measured = false;
      patch.push_back(other);
    };
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::size_t row = patch[i] / map.columns, column = patch[i] % map.columns;
      area_m2 += places[patch[i]].area_m2;
      if (column > 0) add(patch[i] - 1);
      if (column + 1 < map.columns) add(patch[i] + 1);
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
                                             const ToleranceSet& set, const std::vector<RockClassFrom>& classes) {
  Checker checker{map, design, line, sectors, set, classes, {}, std::vector<CellPlace>(map.cells.size())};
  for (std::size_t r = 0; r < map.rows; ++r) checker.add_row(r);
  for (std::size_t i = 0; i < checker.places.size(); ++i) {
    if (!checker.is_left(i)) continue;
    ToleranceCheck& check = checker.checks[static_cast<std::size_t>(checker.places[i].check)];
    check.max_underbreak_area_m2 = std::max(check.max_underbreak_area_m2, checker.take_patch(i));
  }
  for (ToleranceCheck& check : checker.checks)
    if (check.measured_m2 > 0.0) check.mean_overbreak_m /= check.measured_m2;
  std::vector<ToleranceCheck> ordered;
  for (const std::string& rock_class : classes_of(checker.checks))
    for (const Sector& sector : sectors)
      for (const ToleranceCheck& check : checker.checks)
        if (check.rock_class == rock_class && check.sector == sector.name) ordered.push_back(check);
  return ordered;
}

}  // namespace adit
