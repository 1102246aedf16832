#include "io/tolerances_json.h"

#include "core/foundation/error.h"
#include "io/json_place.h"
#include "io/library_files.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

double limit(const JsonPlace& row, const char* key, double most, const char* unit) {
  return row.has(key) ? row.at(key).number_between(0.0, most, unit) : ToleranceRow::unlimited;
}

ToleranceRow read_row(const JsonPlace& place) {
  constexpr double most_m = 20.0, most_m2 = 1e4;
  place.only_keys(
      {"rock_class", "sector", "mean_overbreak_m", "max_overbreak_m", "max_underbreak_m", "max_underbreak_area_m2"});
  ToleranceRow row;
  row.rock_class = place.text_or("rock_class", "any");
  row.sector = place.text_or("sector", "any");
  row.mean_overbreak_m = limit(place, "mean_overbreak_m", most_m, "m");
  row.max_overbreak_m = limit(place, "max_overbreak_m", most_m, "m");
  row.max_underbreak_m = limit(place, "max_underbreak_m", most_m, "m");
  row.max_underbreak_area_m2 = limit(place, "max_underbreak_area_m2", most_m2, "m2");
  const auto unlimited = [](double value) { return value >= ToleranceRow::unlimited; };
  if (unlimited(row.mean_overbreak_m) && unlimited(row.max_overbreak_m) && unlimited(row.max_underbreak_m) &&
      unlimited(row.max_underbreak_area_m2))
    place.refuse("the row limits nothing", "write one of its limits");
  return row;
}

ToleranceSet set_of(const JsonPlace& place) {
  place.only_keys({"name", "source", "verified_by", "rows"});
  ToleranceSet set;
  set.name = place.at("name").text();
  set.source = place.at("source").text();
  if (set.name.size() > 100 || set.source.size() > 300)
    place.refuse("the name or the source is longer than fits on a sheet", "write at most 100 and 300 letters");
  if (set.name.empty()) place.at("name").refuse("a set needs a name", "every verdict names it: write one");
  if (set.source.empty()) place.at("source").refuse("a set needs its source", "name the contract or the standard");
  set.verified_by = place.text_or("verified_by", "");
  for (const JsonPlace& one : place.at("rows").items()) {
    const ToleranceRow row = read_row(one);
    for (const ToleranceRow& other : set.rows)
      if (other.rock_class == row.rock_class && other.sector == row.sector)
        one.refuse("two rows are for rock class " + row.rock_class + " and sector " + row.sector, "remove one");
    set.rows.push_back(row);
  }
  if (set.rows.empty()) place.at("rows").refuse("the set has no row", "write one");
  return set;
}

}  // namespace

ToleranceSet read_tolerances(const std::filesystem::path& file) {
  const nlohmann::json root = parse_json_file(file);
  return set_of(JsonPlace(root, file.string()));
}

ToleranceSet library_tolerances(const std::string& name) {
  for (const LibraryFile& file : tolerance_files())
    if (name == file.name) {
      const nlohmann::json root = nlohmann::json::parse(file.json);
      return set_of(JsonPlace(root, "the library's " + name));
    }
  throw Error("there are no tolerances " + quoted_word(name), "the tolerance library",
              "name one of " + names_of(tolerance_files()));
}

}  // namespace adit::io
