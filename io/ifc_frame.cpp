#include "io/ifc_frame.h"

#include <cmath>
#include <utility>

#include "core/foundation/angle.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

double si_factor(const IfcInstance& unit) {
  static constexpr std::pair<const char*, double> prefixes[] = {
      {"", 1.0}, {"MILLI", 1e-3}, {"CENTI", 1e-2}, {"DECI", 0.1}, {"KILO", 1e3}};
  for (const auto& [name, factor] : prefixes)
    if (unit.word_at(2) == name) return factor;
  unit.fail("the unit's prefix " + quoted_word(unit.word_at(2)) + " is not supported", "export it in metres");
}

/// Metres or radians in one unit.
double factor_of(const IfcText& text, const IfcInstance& unit) {
  if (unit.name == "IFCSIUNIT") return si_factor(unit);
  const IfcInstance& measure = text.at(unit.reference_at(3), unit);
  return measure.number_at(0) * factor_of(text, text.at(measure.reference_at(1), measure));
}

Eigen::Vector3d point_of(const IfcText& text, std::uint64_t number, const IfcInstance& asked_by) {
  const std::vector<double> values = text.at(number, asked_by).numbers_at(0);
  if (values.size() < 2) asked_by.fail(asked_by.name + " refers to a point without coordinates", "export it again");
  return {values[0], values[1], values.size() > 2 ? values[2] : 0.0};
}

/// The frame with another one put within it.
IfcFrame within(const IfcFrame& outer, const IfcFrame& inner) {
  const Eigen::Vector2d plan = outer.plan(inner.shift_m.head<2>());
  return {outer.turn_rad + inner.turn_rad, {plan.x(), plan.y(), outer.shift_m.z() + inner.shift_m.z()}};
}

/// IfcAxis2Placement3D: location, axis (up), direction of x.
IfcFrame placement_of(const IfcText& text, const IfcInstance& placement, const IfcUnits& units) {
  constexpr double upright = 1.0 - 1e-12;
  IfcFrame frame;
  frame.shift_m = units.metres_per_unit * point_of(text, placement.reference_at(0), placement);
  if (const std::uint64_t axis = placement.reference_at(1); axis != 0)
    if (point_of(text, axis, placement).normalized().z() < upright)
      placement.fail("the alignment's placement is tilted", "export it upright");
  if (const std::uint64_t ahead = placement.reference_at(2); ahead != 0) {
    const Eigen::Vector3d x = point_of(text, ahead, placement);
    frame.turn_rad = std::atan2(x.y(), x.x());
  }
  return frame;
}

/// IfcMapConversion: eastings, northings, height of the file's origin, direction of its x axis, scale.
IfcFrame conversion_of(const IfcInstance& conversion, const IfcUnits& units) {
  const double scale = conversion.number_or(7, 1.0);
  const double metres = units.metres_per_unit;
  if (std::abs(scale - 1.0) > 1e-12 && std::abs(scale - metres) > 1e-12)
    conversion.fail("the map conversion scales by " + std::to_string(scale),
                    "export the alignment in the grid's own coordinates");
  const double unit = scale == 1.0 ? metres : 1.0;  // the map's unit is the file's, or the metre
  return {std::atan2(conversion.number_or(6, 0.0), conversion.number_or(5, 1.0)),
          unit * Eigen::Vector3d(conversion.number_at(2), conversion.number_at(3), conversion.number_or(4, 0.0))};
}

}  // namespace

IfcUnits read_ifc_units(const IfcText& text) {
  IfcUnits units;
  for (const IfcInstance* assignment : text.named("IFCUNITASSIGNMENT"))
    for (const std::uint64_t number : assignment->references_at(0)) {
      const auto found = text.instances.find(number);
      if (found == text.instances.end()) continue;
      const IfcInstance& unit = found->second;
      const std::string kind = unit.word_at(1);
      if (kind == "LENGTHUNIT") units.metres_per_unit = factor_of(text, unit);
      if (kind == "PLANEANGLEUNIT") units.radians_per_unit = factor_of(text, unit);
    }
  return units;
}

IfcFrame read_ifc_frame(const IfcText& text, const IfcInstance& product, const IfcUnits& units) {
  constexpr int most_placements = 100;
  IfcFrame frame;
  std::uint64_t number = product.reference_at(5);
  for (int n = 0; number != 0; ++n) {
    const IfcInstance& local = text.at(number, product);
    if (n > most_placements) local.fail("the placements go round in a circle", "export the file again");
    if (local.name != "IFCLOCALPLACEMENT")
      local.fail("the placement " + local.name + " is not supported", "export it with a local placement");
    const IfcInstance& placement = text.at(local.reference_at(1), local);
    frame = within(placement_of(text, placement, units), frame);
    number = local.reference_at(0);
  }
  for (const IfcInstance* conversion : text.named("IFCMAPCONVERSION"))
    frame = within(conversion_of(*conversion, units), frame);
  return frame;
}

}  // namespace adit::io
