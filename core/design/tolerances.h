#pragma once
// What a contract permits: limits by sector and rock class, with their source and who has verified them.

#include <string>
#include <vector>

namespace adit {

enum class ToleranceVerdict {
  kept,
  broken,     ///< by more than two sigmas
  undecided,  ///< beyond a limit, but by less than that
  not_shown,  ///< nothing beyond, but too little was seen
};
const char* words_of(ToleranceVerdict verdict);

/// Limits against the reference line; what is not limited is a million kilometres.
struct ToleranceRow {
  static constexpr double unlimited = 1e9;
  std::string rock_class = "any";
  std::string sector = "any";
  double mean_overbreak_m = unlimited;  ///< overbreak volume over the surface
  double max_overbreak_m = unlimited;
  double max_underbreak_m = unlimited;        ///< depth of rock left inside the line
  double max_underbreak_area_m2 = unlimited;  ///< of one piece of rock left inside the line
};

struct ToleranceSet {
  std::string name;
  std::string source;       ///< contract or standard, with its place
  std::string verified_by;  ///< empty: nobody has compared the set with its source
  std::vector<ToleranceRow> rows;
};

/// A rock class holds from a chainage up to the next one.
struct RockClassFrom {
  double from_m = 0.0;
  std::string rock_class;
  bool operator==(const RockClassFrom&) const = default;
};

/// The class that holds at a chainage; "any" before the first one.
std::string rock_class_at(const std::vector<RockClassFrom>& classes, double chainage_m);

/// The row for a sector and a class: the first one that names both, else the class alone, else the sector alone, else
/// "any" and "any". Null when the set says nothing.
const ToleranceRow* row_for(const ToleranceSet& set, const std::string& rock_class, const std::string& sector);

}  // namespace adit
