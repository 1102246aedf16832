#include "io/landxml.h"

#include <cmath>
#include <utility>

#include "core/foundation/options.h"
#include "io/landxml_cant.h"
#include "io/landxml_horizontal.h"
#include "io/landxml_node.h"
#include "io/landxml_stations.h"
#include "io/landxml_vertical.h"

namespace adit::io {
namespace {

constexpr double reported_length_m = 1e-3;

std::string metres(double value) {
  return short_number(std::round(value * 1e4) / 1e4) + " m";
}

void check_total_length(double stated_m, const std::string& subject, AxisOfFile& read) {
  const double length = read.axis->horizontal().to_m() - read.axis->horizontal().from_m();
  if (stated_m == 0.0 || std::abs(stated_m - length) <= reported_length_m) return;
  read.findings.push_back(
      {Severity::warning, subject,
       "the file states a length of " + metres(stated_m) + ", its elements sum to " + metres(length),
       "the elements are used; ask whether some are missing"});
}

void add(const Findings& more, Findings& findings) {
  findings.insert(findings.end(), more.begin(), more.end());
}

VerticalAlignment read_grade(const LandXmlNode& node, const std::string& subject, AxisOfFile& read) {
  try {
    LandXmlGrade grade = read_landxml_grade(node, subject);
    add(grade.findings, read.findings);
    return std::move(grade.vertical);
  } catch (const Error& error) {
    read.grade_refusal = error;
    return {};
  }
}

/// What the cross-section does changes no axis: without it the axis stays usable, and it is said.
Cant read_cant(const LandXmlNode& node, const HorizontalAlignment& plan, const std::string& subject, AxisOfFile& read) {
  try {
    LandXmlCant cant = read_landxml_cant(node, plan, subject);
    add(cant.findings, read.findings);
    return std::move(cant.cant);
  } catch (const Error& error) {
    read.cant_refusal = error;
    read.findings.push_back(
        {Severity::warning, subject, "its cant is not honoured: " + error.what_is_wrong(), error.mend()});
    return {};
  }
}

AxisOfFile read_alignment(const LandXmlNode& node, std::size_t number) {
  AxisOfFile read;
  read.name = node.text("name").empty() ? "alignment " + std::to_string(number) : node.text("name");
  const std::string subject = "alignment " + read.name;
  try {
    const double stated_length_m = node.optional_length_m("length").value_or(0.0);
    LandXmlPlan plan = read_landxml_plan(node, subject);
    LandXmlStations stations = read_landxml_stations(node, plan.horizontal, subject);
    add(plan.findings, read.findings);
    add(stations.findings, read.findings);
    VerticalAlignment vertical = read_grade(node, subject, read);
    Cant cant = read_cant(node, plan.horizontal, subject, read);
    read.axis.emplace(read.name, std::move(plan.horizontal), std::move(vertical), std::move(stations.stations),
                      std::move(cant));
    check_total_length(stated_length_m, subject, read);
    add(grade_coverage(*read.axis), read.findings);
  } catch (const Error& error) {
    read.refusal = error;
  }
  const std::string unread = unread_children(node, {"CoordGeom", "Profile", "StaEquation", "Cant", "Superelevation"});
  if (!unread.empty()) read.findings.push_back({Severity::note, subject, "not honoured: " + unread, ""});
  return read;
}

}  // namespace

AxisFile read_landxml(const std::filesystem::path& path) {
  const LandXmlDocument document(path);
  const LandXmlNode root(document, document.xml.document_element());
  AxisFile file{document.name, "LandXML", {}, {}};
  for (const LandXmlNode& group : root.children("Alignments")) {
    for (const LandXmlNode& node : group.children("Alignment")) {
      file.axes.push_back(read_alignment(node, file.axes.size() + 1));
    }
  }
  const std::string unread =
      unread_children(root, {"Alignments", "Units", "Project", "Application", "CoordinateSystem", "FeatureDictionary"});
  if (!unread.empty()) file.findings.push_back({Severity::note, document.name, "not honoured: " + unread, ""});
  return file;
}

}  // namespace adit::io
