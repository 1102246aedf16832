#include "core/design/tolerances.h"

namespace adit {

const char* words_of(ToleranceVerdict verdict) {
  switch (verdict) {
    case ToleranceVerdict::kept:
      return "kept";
    case ToleranceVerdict::broken:
      return "broken";
    case ToleranceVerdict::undecided:
      return "undecided";
    case ToleranceVerdict::not_shown:
      break;
  }
  return "not shown";
}

std::string rock_class_at(const std::vector<RockClassFrom>& classes, double chainage_m) {
  std::string name = "any";
  for (const RockClassFrom& one : classes)
    if (one.from_m <= chainage_m) name = one.rock_class;
  return name;
}

const ToleranceRow* row_for(const ToleranceSet& set, const std::string& rock_class, const std::string& sector) {
  const auto find = [&](const std::string& wanted_class, const std::string& wanted_sector) -> const ToleranceRow* {
    for (const ToleranceRow& row : set.rows)
      if (row.rock_class == wanted_class && row.sector == wanted_sector) return &row;
    return nullptr;
  };
  for (const auto* row : {find(rock_class, sector), find(rock_class, "any"), find("any", sector), find("any", "any")})
    if (row != nullptr) return row;
  return nullptr;
}

}  // namespace adit
