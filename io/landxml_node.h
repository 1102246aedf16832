#pragma once
// XML elements of a LandXML file with the line they stand at; numbers and points checked and converted to metres.

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/foundation/error.h"

namespace adit::io {

/// What the Units element says.
struct LandXmlUnits {
  double metres_per_unit = 1.0;
  double elevation_metres_per_unit = 1.0;  ///< Inframodel may state its own
  double metres_per_cant_unit = 0.001;     ///< millimetres, inches in Imperial files
  enum class Angle { radians, grads, degrees, degrees_minutes_seconds };
  std::optional<Angle> direction = Angle::radians;  ///< empty when the word is unknown: directions are not checked then

  double direction_rad(double stated) const;
};

/// The parsed file, alive as long as its nodes are used.
struct LandXmlDocument {
  explicit LandXmlDocument(const std::filesystem::path& file);

  std::string name;
  pugi::xml_document xml;
  std::vector<std::size_t> line_starts;
  LandXmlUnits units;
  std::map<std::string, pugi::xml_node> cg_points;  ///< by name; of two with one name the first

  /// "axis.xml:12" or "axis.xml:12:7" of a byte of the text.
  std::string place(std::ptrdiff_t offset, bool with_column) const;
};

/// One element. Names are compared without their namespace prefix.
class LandXmlNode {
 public:
  LandXmlNode(const LandXmlDocument& document, pugi::xml_node node) : document_(&document), node_(node) {}

  std::string name() const;
  const LandXmlUnits& units() const { return document_->units; }
  std::string place() const { return document_->place(node_.offset_debug(), false); }
  std::vector<LandXmlNode> children() const;
  std::vector<LandXmlNode> children(std::string_view name) const;
  std::optional<LandXmlNode> child(std::string_view name) const;

  bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }
  std::string text(const char* attribute) const { return node_.attribute(attribute).as_string(); }
  /// Throws Error with the line when the attribute is absent or no finite number.
  double number(const char* attribute) const;
  std::optional<double> optional_number(const char* attribute) const;
  double length_m(const char* attribute) const { return number(attribute) * units().metres_per_unit; }
  std::optional<double> optional_length_m(const char* attribute) const;
  /// 1 / radius; "INF" in any spelling and sign gives 0.
  double curvature_per_m(const char* attribute) const;

  /// The numbers of the element's text, at least `least` of them. Throws Error with line and column.
  std::vector<double> numbers(std::size_t least) const;
  /// The element's text as it stands.
  std::string content() const { return node_.text().get(); }
  /// East, north [m] of the CgPoint of that name; empty when the file has none.
  std::optional<Eigen::Vector2d> referenced_point_m(const std::string& name) const;
  /// East, north [m] of a child that holds "northing easting [elevation]" or, as pntRef, the name of a CgPoint.
  Eigen::Vector2d point_m(std::string_view child_name) const;
  std::optional<Eigen::Vector2d> optional_point_m(std::string_view child_name) const;

  /// Adds the CgPoints among the children by name.
  void add_points_to(std::map<std::string, pugi::xml_node>& points) const;

  [[noreturn]] void fail(const std::string& what_is_wrong, const std::string& mend) const {
    throw Error(what_is_wrong, place(), mend);
  }

 private:
  const LandXmlDocument* document_;
  pugi::xml_node node_;
};

/// Counts of child elements by name, in order of appearance, without those of `known`: "Cant (1), CantStation (3)".
std::string unread_children(const LandXmlNode& node, const std::vector<std::string_view>& known);

}  // namespace adit::io
