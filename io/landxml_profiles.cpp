#include "io/landxml_profiles.h"

#include <set>

#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/landxml_node.h"

namespace adit::io {
namespace {

constexpr double repeated_m = 1e-3;

/// "Lining" or, where the section says a side, "Lining/left".
std::string full_name(const LandXmlNode& surface) {
  const std::string side = surface.text("side");
  return surface.text("name") + (side.empty() || side == "both" ? "" : "/" + side);
}

std::vector<Eigen::Vector2d> points_of(const LandXmlNode& surface) {
  std::vector<Eigen::Vector2d> points;
  const LandXmlUnits& units = surface.units();
  for (const LandXmlNode& node : surface.children("CrossSectPnt")) {
    const std::string format = node.text("dataFormat");
    if (!format.empty() && format != "Offset Elevation")
      node.fail("points as \"" + format + "\" are not read", "export them as \"Offset Elevation\"");
    const std::vector<double> numbers = node.numbers(2);
    points.emplace_back(numbers[0] * units.metres_per_unit, numbers[1] * units.elevation_metres_per_unit);
  }
  return points;
}

bool is_closed(const LandXmlNode& surface, const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 3) return false;
  return surface.text("closedArea") == "true" || (points.back() - points.front()).norm() < repeated_m;
}

Profile profile_of(const LandXmlNode& surface, std::vector<Eigen::Vector2d> points) {
  if ((points.back() - points.front()).norm() < repeated_m) points.pop_back();
  std::vector<ProfileSegment> segments;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const Eigen::Vector2d& next = points[(i + 1) % points.size()]; (next - points[i]).norm() >= repeated_m)
      segments.push_back({points[i], next, 0.0});
  try {
    return {full_name(surface), std::move(segments)};
  } catch (const Error& error) {
    throw Error(error.what_is_wrong(), surface.place(), error.mend());
  }
}

struct Search {
  std::string wanted;
  std::set<std::string> closed_names;  ///< all there are, for the refusal

  std::vector<ProfileFrom> in_alignment(const LandXmlNode& alignment) {
    std::vector<ProfileFrom> profiles;
    for (const LandXmlNode& sections : alignment.children("CrossSects"))
      for (const LandXmlNode& section : sections.children("CrossSect")) add_section(section, profiles);
    return profiles;
  }

  void add_section(const LandXmlNode& section, std::vector<ProfileFrom>& profiles) {
    bool found = false;
    for (const LandXmlNode& surface : section.children("DesignCrossSectSurf")) {
      std::vector<Eigen::Vector2d> points = points_of(surface);
      if (!is_closed(surface, points)) continue;
      closed_names.insert(full_name(surface));
      if (!wanted.empty() && wanted != surface.text("name") && wanted != full_name(surface)) continue;
      if (found)
        surface.fail("this section has more than one closed surface" +
                         (wanted.empty() ? std::string() : " \"" + wanted + "\"") + ", this one is \"" +
                         full_name(surface) + "\"",
                     "name one in \"layer\", with its side where it has one: \"name/left\"");
      found = true;
      const double from_m = section.length_m("sta");
      if (!profiles.empty() && from_m <= profiles.back().from_m)
        section.fail("its station " + short_number(from_m) + " m does not lie behind that of the section before it",
                     "put the sections in order");
      profiles.push_back({from_m, profile_of(surface, std::move(points)), false});
    }
  }
};

}  // namespace

std::vector<ProfileFrom> read_landxml_profiles(const std::filesystem::path& file, const std::string& surface) {
  const LandXmlDocument document(file);
  const LandXmlNode root(document, document.xml.document_element());
  Search search{surface, {}};
  std::vector<ProfileFrom> profiles;
  for (const LandXmlNode& group : root.children("Alignments"))
    for (const LandXmlNode& alignment : group.children("Alignment")) {
      std::vector<ProfileFrom> more = search.in_alignment(alignment);
      if (!more.empty() && !profiles.empty())
        alignment.fail("more than one alignment of the file has such sections", "export one alignment alone");
      if (!more.empty()) profiles = std::move(more);
    }
  if (!profiles.empty()) return profiles;
  std::string names;
  for (const std::string& name : search.closed_names) names += (names.empty() ? "" : ", ") + name;
  throw Error("the file has no closed DesignCrossSectSurf" + (surface.empty() ? "" : " \"" + surface + "\""),
              file.string(), names.empty() ? "export the design sections with closed areas" : "name one of " + names);
}

}  // namespace adit::io
