#include "io/profile_json.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/expression.h"
#include "io/json_place.h"
#include "io/library_files.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

std::string names_of(const ProfileSizes& sizes) {
  std::string words;
  for (const auto& [name, value] : sizes) words += (words.empty() ? "" : ", ") + name + " " + short_number(value);
  return words;
}

double value_of(const JsonPlace& place, const ProfileSizes& sizes) {
  if (!place.is_text()) return place.number();
  try {
    return evaluate(place.text(), sizes);
  } catch (const Error& error) {
    place.refuse(error.what_is_wrong(), "correct the formula, or the sizes");
  }
}

Eigen::Vector2d point_of(const JsonPlace& place, const ProfileSizes& sizes) {
  const std::vector<JsonPlace> parts = place.items();
  if (parts.size() != 2) place.refuse("a place needs two numbers", "write [offset, height]");
  return {value_of(parts[0], sizes), value_of(parts[1], sizes)};
}

/// tan(sweep / 4) of the arc from a to b through a third place.
double bulge_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& through,
                     const JsonPlace& place) {
  const Eigen::Vector2d to_a = a - through, to_b = b - through;
  const double cross = to_a.x() * to_b.y() - to_a.y() * to_b.x();
  const double angle = std::atan2(std::abs(cross), to_a.dot(to_b));  // seen from the third place: half the rest
  if (to_a.norm() == 0.0 || to_b.norm() == 0.0) place.refuse("\"through\" is an end of the arc", "name another place");
  // The inscribed angle stands over the other part of the circle: sweep = 2 pi - 2 angle.
  const double bulge = std::tan(0.5 * (pi - angle));
  return cross > 0.0 ? -bulge : bulge;
}

/// The shorter arc from a to b about a centre.
double bulge_about(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& center,
                   const JsonPlace& place) {
  const Eigen::Vector2d from = a - center, to = b - center;
  constexpr double same_m = 1e-3;
  if (std::abs(from.norm() - to.norm()) > same_m)
    place.refuse("both ends of the arc must lie as far from its center: " + short_number(from.norm()) + " and " +
                     short_number(to.norm()) + " m",
                 "correct the center");
  return std::tan(0.25 * std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to)));
}

ProfileSegment segment_of(const JsonPlace& place, const Eigen::Vector2d& from, const ProfileSizes& sizes) {
  place.only_keys({"line", "arc", "through", "center", "bulge"});
  if (place.has("line") == place.has("arc"))
    place.refuse("a piece is a line or an arc", "write one of \"line\", \"arc\"");
  ProfileSegment segment{from, point_of(place.at(place.has("line") ? "line" : "arc"), sizes), 0.0};
  const int ways = (place.has("through") ? 1 : 0) + (place.has("center") ? 1 : 0) + (place.has("bulge") ? 1 : 0);
  if (ways != (place.has("arc") ? 1 : 0))
    place.refuse("an arc needs one of \"through\", \"center\", \"bulge\", a line none", "write it so");
  if (place.has("through"))
    segment.bulge = bulge_through(from, segment.end, point_of(place.at("through"), sizes), place);
  if (place.has("center")) segment.bulge = bulge_about(from, segment.end, point_of(place.at("center"), sizes), place);
  if (place.has("bulge")) segment.bulge = value_of(place.at("bulge"), sizes);
  return segment;
}

ProfileSizes own_sizes(const JsonPlace& root) {
  ProfileSizes sizes;
  if (!root.has("sizes")) return sizes;
  for (const std::string& name : root.at("sizes").keys()) sizes[name] = root.at("sizes").at(name).number();
  return sizes;
}

/// What sizes must not fall below, each a size and a formula.
void check_limits(const JsonPlace& place, const ProfileSizes& sizes, const std::string& file) {
  for (const JsonPlace& pair : place.items()) {
    const std::vector<JsonPlace> parts = pair.items();
    if (parts.size() != 2 || sizes.find(parts[0].text()) == sizes.end())
      pair.refuse("a size and a formula are needed", "write [\"height\", \"wall_height\"]");
    const double least = value_of(parts[1], sizes), value = sizes.at(parts[0].text());
    if (value < least)
      throw Error("the size " + parts[0].text() + " is " + short_number(value), file,
                  "it must be at least " + short_number(least));
  }
}

Profile profile_of(const nlohmann::json& json, const std::string& file, const ProfileSizes& given) {
  const JsonPlace root(json, file);
  root.only_keys({"name", "sizes", "at_least", "where", "start", "pieces"});
  ProfileSizes sizes = own_sizes(root);
  for (const auto& [name, value] : given) {
    if (sizes.find(name) == sizes.end())
      throw Error("the profile has no size " + quoted_word(name), file,
                  sizes.empty() ? "it takes none" : "it takes " + names_of(sizes));
    sizes[name] = value;
  }
  const std::string stated = names_of(sizes);
  if (root.has("at_least")) check_limits(root.at("at_least"), sizes, file);
  if (root.has("where"))
    for (const JsonPlace& pair : root.at("where").items()) {
      const std::vector<JsonPlace> parts = pair.items();
      if (parts.size() != 2) pair.refuse("a name and a formula are needed", "write [\"r\", \"width/2\"]");
      if (sizes.find(parts[0].text()) != sizes.end())
        parts[0].refuse("this name is taken by a size or an earlier formula", "choose another one");
      sizes[parts[0].text()] = value_of(parts[1], sizes);
    }
  std::vector<ProfileSegment> segments;
  Eigen::Vector2d at = point_of(root.at("start"), sizes);
  for (const JsonPlace& piece : root.at("pieces").items()) {
    const ProfileSegment segment = segment_of(piece, at, sizes);
    at = segment.end;
    if ((segment.end - segment.start).norm() > 1e-6) segments.push_back(segment);  // sizes may make a piece vanish
  }
  try {
    return Profile(root.text_or("name", file) + (stated.empty() ? "" : " (" + stated + ")"), segments);
  } catch (const Error& error) {
    throw Error(error.what_is_wrong() + (stated.empty() ? "" : " (sizes " + stated + ")"), file, error.mend());
  }
}

}  // namespace

Profile read_profile_json(const std::filesystem::path& file, const ProfileSizes& sizes) {
  return profile_of(parse_json_file(file), file.string(), sizes);
}

Profile library_profile(const std::string& name, const ProfileSizes& sizes) {
  for (const LibraryFile& file : profile_files())
    if (name == file.name) return profile_of(nlohmann::json::parse(file.json), "the library's " + name, sizes);
  throw Error("there is no profile " + quoted_word(name), "the profile library",
              "name one of " + names_of(profile_files()));
}

std::vector<std::string> library_profiles() {
  std::vector<std::string> lines;
  for (const LibraryFile& file : profile_files()) {
    const nlohmann::json json = nlohmann::json::parse(file.json);
    lines.push_back(std::string(file.name) + " (" + names_of(own_sizes(JsonPlace(json, file.name))) + ")");
  }
  return lines;
}

}  // namespace adit::io
