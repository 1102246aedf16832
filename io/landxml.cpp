#include "io/landxml.h"

#include <cmath>
#include <utility>

#include "core/foundation/options.h"
#include "io/landxml_horizontal.h"
#include "io/landxml_node.h"
#include "io/landxml_vertical.h"

namespace adit::io {
namespace {

constexpr double reported_length_m = 1e-3;

std::string metres(double value) {
  return short_number(std::round(value * 1e4) / 1e4) + " m";
}

void check_total_length(LandXmlAlignment& read, const std::string& subject) {
  const double length = read.axis->horizontal().to_m() - read.axis->horizontal().from_m();
  if (read.stated_length_m == 0.0 || std::abs(read.stated_length_m - length) <= reported_length_m) return;
  read.findings.push_back(
      {Severity::warning, subject,
       "the file states a length of " + metres(read.stated_length_m) + ", its elements sum to " + metres(length),
       "the elements are used; ask whether some are missing"});
}

VerticalAlignment read_grade(const LandXmlNode& node, const std::string& subject, LandXmlAlignment& read) {
  try {
    LandXmlGrade grade = read_landxml_grade(node, subject);
    read.findings.insert(read.findings.end(), grade.findings.begin(), grade.findings.end());
    return std::move(grade.vertical);
  } catch (const Error& error) {
    read.grade_refusal = error;
    return {};
  }
}

LandXmlAlignment read_alignment(const LandXmlNode& node, std::size_t number) {
  LandXmlAlignment read;
  read.name = node.text("name").empty() ? "alignment " + std::to_string(number) : node.text("name");
  const std::string subject = "alignment " + read.name;
  try {
    read.stated_length_m = node.optional_length_m("length").value_or(0.0);
    LandXmlPlan plan = read_landxml_plan(node, subject);
    read.findings = std::move(plan.findings);
    VerticalAlignment vertical = read_grade(node, subject, read);
    read.axis.emplace(read.name, std::move(plan.horizontal), std::move(vertical));
    check_total_length(read, subject);
  } catch (const Error& error) {
    read.refusal = error;
  }
  const std::string unread = unread_children(node, {"CoordGeom", "Profile"});
  if (!unread.empty()) read.findings.push_back({Severity::note, subject, "not honoured: " + unread, ""});
  return read;
}

std::string names_of(const LandXmlFile& file) {
  std::string names;
  for (const LandXmlAlignment& alignment : file.alignments) {
    names += (names.empty() ? "\"" : ", \"") + alignment.name + "\"";
  }
  return names;
}

const LandXmlAlignment& named(const LandXmlFile& file, const std::string& name) {
  if (file.alignments.empty()) throw Error("the file holds no alignment", file.file, "export the axis with CoordGeom");
  const LandXmlAlignment* found = nullptr;
  for (const LandXmlAlignment& alignment : file.alignments) {
    if (!name.empty() && alignment.name != name) continue;
    if (found != nullptr) {
      throw Error(name.empty() ? "the file holds several alignments" : "several alignments are named \"" + name + "\"",
                  file.file, "name one of " + names_of(file));
    }
    found = &alignment;
  }
  if (found == nullptr) {
    throw Error("the file holds no alignment \"" + name + "\"", file.file, "name one of " + names_of(file));
  }
  return *found;
}

}  // namespace

LandXmlFile read_landxml(const std::filesystem::path& path) {
  const LandXmlDocument document(path);
  const LandXmlNode root(document, document.xml.document_element());
  LandXmlFile file{document.name, {}, {}};
  for (const LandXmlNode& group : root.children("Alignments")) {
    for (const LandXmlNode& node : group.children("Alignment")) {
      file.alignments.push_back(read_alignment(node, file.alignments.size() + 1));
    }
  }
  const std::string unread =
      unread_children(root, {"Alignments", "Units", "Project", "Application", "CoordinateSystem", "FeatureDictionary"});
  if (!unread.empty()) file.findings.push_back({Severity::note, document.name, "not honoured: " + unread, ""});
  return file;
}

Alignment choose_alignment(const LandXmlFile& file, const std::string& name) {
  const LandXmlAlignment& chosen = named(file, name);
  if (chosen.refusal) throw *chosen.refusal;
  if (chosen.grade_refusal) throw *chosen.grade_refusal;
  if (chosen.axis->vertical().empty()) {
    throw Error("alignment " + chosen.name + " has no grade line", file.file, "export it with its Profile");
  }
  return *chosen.axis;
}

}  // namespace adit::io
