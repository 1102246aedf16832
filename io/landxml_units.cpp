#include "io/landxml_units.h"

#include <cctype>
#include <cmath>
#include <utility>

#include "core/foundation/angle.h"

namespace adit::io {
namespace {

/// Lower case without blanks: files write "decimal  dd.mm.ss" and "USSurveyFoot" in several ways.
std::string plain(const std::string& word) {
  std::string letters;
  for (const char c : word) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return letters;
}

double metres_per(const LandXmlNode& units, const char* attribute) {
  static constexpr std::pair<const char*, double> known[] = {{"meter", 1.0},
                                                             {"metre", 1.0},
                                                             {"millimeter", 0.001},
                                                             {"centimeter", 0.01},
                                                             {"kilometer", 1000.0},
                                                             {"foot", 0.3048},
                                                             {"ussurveyfoot", 1200.0 / 3937.0},
                                                             {"inch", 0.0254},
                                                             {"mile", 1609.344}};
  const std::string word = plain(units.text(attribute));
  for (const auto& [name, metres] : known) {
    if (word == name) return metres;
  }
  units.fail(std::string("the ") + attribute + " \"" + units.text(attribute) + "\" is unknown",
             "use meter, foot or USSurveyFoot");
}

std::optional<LandXmlUnits::Angle> angle_unit(const std::string& stated) {
  const std::string word = plain(stated);
  if (word.empty() || word == "radians") return LandXmlUnits::Angle::radians;  // the schema's default
  if (word == "grads" || word == "gon") return LandXmlUnits::Angle::grads;
  if (word == "decimaldegrees" || word == "degrees") return LandXmlUnits::Angle::degrees;
  if (word == "decimaldd.mm.ss") return LandXmlUnits::Angle::degrees_minutes_seconds;
  return std::nullopt;
}

/// 30.2045 is 30 degrees 20 minutes 45 seconds.
double rad_from_dms(double stated) {
  const double size = std::abs(stated);
  const double degrees = std::floor(size + 1e-9);
  const double rest = (size - degrees) * 100.0;
  const double minutes = std::floor(rest + 1e-7);
  const double seconds = (rest - minutes) * 100.0;
  return std::copysign(rad_from_deg(degrees + minutes / 60.0 + seconds / 3600.0), stated);
}

}  // namespace

double LandXmlUnits::direction_rad(double stated) const {
  switch (direction.value_or(Angle::radians)) {
    case Angle::radians:
      return stated;
    case Angle::grads:
      return rad_from_gon(stated);
    case Angle::degrees:
      return rad_from_deg(stated);
    case Angle::degrees_minutes_seconds:
      return rad_from_dms(stated);
  }
  return stated;
}

LandXmlUnits read_landxml_units(const LandXmlNode& root) {
  const auto units = root.child("Units");
  auto system = units ? units->child("Metric") : std::nullopt;
  const bool imperial = units && !system;
  if (imperial) system = units->child("Imperial");
  if (!system) root.fail("the file does not state its units", "add <Units><Metric linearUnit=\"meter\" .../></Units>");
  LandXmlUnits read;
  read.metres_per_unit = metres_per(*system, "linearUnit");
  read.elevation_metres_per_unit =
      system->has("elevationUnit") ? metres_per(*system, "elevationUnit") : read.metres_per_unit;
  read.metres_per_cant_unit = imperial ? 0.0254 : 0.001;
  read.direction = angle_unit(system->text("directionUnit"));
  return read;
}

}  // namespace adit::io
