#include "io/ifc_alignment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/foundation/options.h"
#include "io/ifc_segments.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

/// What nests within what (IfcRelNests), in order.
using Nesting = std::map<std::uint64_t, std::vector<std::uint64_t>>;

Nesting nesting_of(const IfcText& text) {
  Nesting nesting;
  for (const IfcInstance* relation : text.named("IFCRELNESTS"))
    for (const std::uint64_t child : relation->references_at(5)) nesting[relation->reference_at(4)].push_back(child);
  return nesting;
}

std::vector<const IfcInstance*> children(const IfcText& text, const Nesting& nesting, const IfcInstance& parent,
                                         const std::string& name) {
  std::vector<const IfcInstance*> found;
  const auto nested = nesting.find(parent.number);
  if (nested == nesting.end()) return found;
  for (const std::uint64_t number : nested->second) {
    const auto child = text.instances.find(number);
    if (child != text.instances.end() && child->second.name == name) found.push_back(&child->second);
  }
  return found;
}

/// The design parameters of the segments nested in a layout.
IfcSegments segments_of(const IfcText& text, const Nesting& nesting, const IfcInstance& layout) {
  IfcSegments segments;
  for (const IfcInstance* segment : children(text, nesting, layout, "IFCALIGNMENTSEGMENT"))
    segments.push_back(&text.at(segment->reference_at(7), *segment));
  return segments;
}

/// The only child of that kind; none when there is none.
const IfcInstance* layout_of(const IfcText& text, const Nesting& nesting, const IfcInstance& alignment,
                             const std::string& name) {
  const auto found = children(text, nesting, alignment, name);
  if (found.size() > 1)
    found[1]->fail("the alignment has " + std::to_string(found.size()) + " of " + name, "leave the one to be built");
  return found.empty() ? nullptr : found.front();
}

/// A station referent: Pset_Stationing with the station, the incoming one where it jumps, and where it stands.
struct Referent {
  double along_m = 0.0;
  double station_m = 0.0;
  bool decreasing = false;
};

const IfcInstance* property_of(const IfcText& text, const IfcInstance& set, const std::string& name) {
  for (const std::uint64_t number : set.references_at(4)) {
    const auto found = text.instances.find(number);
    if (found != text.instances.end() && found->second.word_at(0) == name) return &found->second;
  }
  return nullptr;
}

/// Distance along the basis curve of a referent's linear placement; 0 when it has none.
double along_of(const IfcText& text, const IfcInstance& referent, const IfcUnits& units) {
  const auto next = [&](const IfcInstance& from, std::size_t i) -> const IfcInstance* {
    const auto found = text.instances.find(from.reference_at(i));
    return found == text.instances.end() ? nullptr : &found->second;
  };
  const IfcInstance* placement = next(referent, 5);
  if (placement == nullptr || placement->name != "IFCLINEARPLACEMENT") return 0.0;
  const IfcInstance* relative = next(*placement, 1);
  const IfcInstance* distance = relative == nullptr ? nullptr : next(*relative, 0);
  if (distance == nullptr || distance->name != "IFCPOINTBYDISTANCEEXPRESSION")
    placement->fail("the place of a station referent is not understood", "export it with its distance along the axis");
  return distance->number_at(0) * units.metres_per_unit;
}

std::vector<Referent> referents_of(const IfcText& text, const Nesting& nesting, const IfcInstance& alignment,
                                   const IfcUnits& units) {
  std::vector<Referent> found;
  for (const IfcInstance* referent : children(text, nesting, alignment, "IFCREFERENT"))
    for (const IfcInstance* relation : text.named("IFCRELDEFINESBYPROPERTIES")) {
      const auto objects = relation->references_at(4);
      if (std::find(objects.begin(), objects.end(), referent->number) == objects.end()) continue;
      const IfcInstance& set = text.at(relation->reference_at(5), *relation);
      const IfcInstance* station = set.word_at(2) == "Pset_Stationing" ? property_of(text, set, "Station") : nullptr;
      if (station == nullptr) continue;
      const IfcInstance* increasing = property_of(text, set, "HasIncreasingStation");
      found.push_back({along_of(text, *referent, units), station->number_at(2) * units.metres_per_unit,
                       increasing != nullptr && increasing->word_at(2) == "F"});
    }
  std::sort(found.begin(), found.end(), [](const Referent& a, const Referent& b) { return a.along_m < b.along_m; });
  return found;
}

/// Chainage of the start and the jumps behind it.
std::pair<double, StationEquations> stations_of(const std::vector<Referent>& referents, double draft_start_m,
                                                const std::string& subject, Findings& findings) {
  if (referents.empty()) return {draft_start_m, {}};
  constexpr double same_m = 1e-3;
  const double start_m = referents.front().station_m - referents.front().along_m;
  std::vector<StationEquation> equations;
  double ahead_m = start_m, since_m = 0.0;
  for (const Referent& referent : referents) {
    const double foretold = ahead_m + referent.along_m - since_m;
    if (std::abs(foretold - referent.station_m) <= same_m && !referent.decreasing) continue;
    equations.push_back({start_m + referent.along_m, referent.station_m, referent.decreasing});
    ahead_m = referent.station_m;
    since_m = referent.along_m;
    findings.push_back({Severity::warning, subject,
                        "stations go on from " + short_number(referent.station_m) + " at chainage " +
                            short_number(start_m + referent.along_m),
                        "the chainage counts on; both stand beside every number"});
  }
  return {start_m, StationEquations(std::move(equations))};
}

AxisOfFile read_alignment(const IfcText& text, const Nesting& nesting, const IfcUnits& units,
                          const IfcInstance& alignment, std::size_t number) {
  AxisOfFile read;
  read.name = alignment.word_at(2).empty() ? "alignment " + std::to_string(number) : alignment.word_at(2);
  const std::string subject = "alignment " + read.name;
  try {
    const IfcInstance* horizontal = layout_of(text, nesting, alignment, "IFCALIGNMENTHORIZONTAL");
    const IfcSegments plan = horizontal == nullptr ? IfcSegments{} : segments_of(text, nesting, *horizontal);
    if (plan.empty())
      alignment.fail("it has no horizontal segments" +
                         std::string(alignment.reference_at(6) != 0 ? ": it is drawn as a curve only" : ""),
                     "export it with IfcAlignmentHorizontal and its segments");
    const IfcFrame frame = read_ifc_frame(text, alignment, units);
    auto [start_m, stations] =
        stations_of(referents_of(text, nesting, alignment, units),
                    horizontal->number_or(7, 0.0) * units.metres_per_unit, subject, read.findings);
    HorizontalAlignment axis = plan_of(text, plan, units, frame, start_m, subject, read.findings);
    VerticalAlignment grade;
    try {
      if (const IfcInstance* vertical = layout_of(text, nesting, alignment, "IFCALIGNMENTVERTICAL"))
        grade =
            grade_of(segments_of(text, nesting, *vertical), units, frame.shift_m.z(), start_m, subject, read.findings);
    } catch (const Error& error) {
      read.grade_refusal.emplace(subject + ": " + error.what_is_wrong(),
                                 error.where().empty() ? text.file : error.where(), error.mend());
    }
    Cant cant;
    try {
      if (const IfcInstance* layout = layout_of(text, nesting, alignment, "IFCALIGNMENTCANT"))
        cant = cant_of(segments_of(text, nesting, *layout), units, layout->number_at(7), start_m);
    } catch (const Error& error) {
      read.cant_refusal = error;
      read.findings.push_back(
          {Severity::warning, subject, "its cant is not honoured: " + error.what_is_wrong(), error.mend()});
    }
    read.axis.emplace(read.name, std::move(axis), std::move(grade), std::move(stations), std::move(cant));
    const Findings coverage = grade_coverage(*read.axis);
    read.findings.insert(read.findings.end(), coverage.begin(), coverage.end());
  } catch (const Error& error) {
    read.refusal.emplace(subject + ": " + error.what_is_wrong(),
                         error.where().empty() ? alignment.place : error.where(), error.mend());
  }
  return read;
}

}  // namespace

AxisFile read_ifc_alignments(const std::filesystem::path& file) {
  const IfcText text = read_ifc_text(
      file, {"IFCALIGNMENT", "IFCRELNESTS", "IFCCARTESIANPOINT", "IFCDIRECTION", "IFCSIUNIT", "IFCCONVERSIONBASEDUNIT",
             "IFCMEASUREWITHUNIT", "IFCUNITASSIGNMENT", "IFCLOCALPLACEMENT", "IFCLINEARPLACEMENT", "IFCAXIS2PLACEMENT",
             "IFCMAPCONVERSION", "IFCREFERENT", "IFCPROPERTYSET", "IFCPROPERTYSINGLEVALUE", "IFCRELDEFINESBYPROPERTIES",
             "IFCPOINTBYDISTANCEEXPRESSION"});
  if (!text.schema.starts_with("IFC4X3"))
    throw Error("the file follows " + quoted_word(text.schema) + ", not IFC 4.3", file.string(),
                "export it as IFC 4.3 or LandXML");
  const IfcUnits units = read_ifc_units(text);
  const Nesting nesting = nesting_of(text);
  AxisFile read{file.string(), "IFC", {}, {}};
  for (const IfcInstance* alignment : text.named("IFCALIGNMENT"))
    read.axes.push_back(read_alignment(text, nesting, units, *alignment, read.axes.size() + 1));
  return read;
}

}  // namespace adit::io
