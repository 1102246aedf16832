#include "io/axis_file.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/options.h"

namespace adit::io {
namespace {

std::string names_of(const AxisFile& file) {
  std::string names;
  for (const AxisOfFile& axis : file.axes) names += (names.empty() ? "\"" : ", \"") + axis.name + "\"";
  return names;
}

}  // namespace

const AxisOfFile& named_axis(const AxisFile& file, const std::string& name) {
  if (file.axes.empty()) throw Error("the file holds no alignment", file.file, "export the axis with its geometry");
  const AxisOfFile* found = nullptr;
  for (const AxisOfFile& axis : file.axes) {
    if (!name.empty() && axis.name != name) continue;
    if (found != nullptr) {
      throw Error(name.empty() ? "the file holds several alignments" : "several alignments are named \"" + name + "\"",
                  file.file, "name one of " + names_of(file));
    }
    found = &axis;
  }
  if (found == nullptr) {
    throw Error("the file holds no alignment \"" + name + "\"", file.file, "name one of " + names_of(file));
  }
  if (found->refusal) throw Error(*found->refusal);
  return *found;
}

Findings grade_coverage(const Alignment& axis) {
  constexpr double reported_m = 1.0;
  const HorizontalAlignment& plan = axis.horizontal();
  const VerticalAlignment& grade = axis.vertical();
  if (grade.empty() || (grade.from_m() <= plan.from_m() + reported_m && grade.to_m() >= plan.to_m() - reported_m))
    return {};
  const auto metres = [](double value) { return short_number(std::round(value * 1000.0) / 1000.0); };
  const double covered = std::min(grade.to_m(), plan.to_m()) - std::max(grade.from_m(), plan.from_m());
  return {{covered < 0.5 * (plan.to_m() - plan.from_m()) ? Severity::warning : Severity::note,
           "alignment " + axis.name(),
           "its grade line runs from " + metres(grade.from_m()) + " to " + metres(grade.to_m()) + ", its plan from " +
               metres(plan.from_m()) + " to " + metres(plan.to_m()),
           "export the whole grade line; stations may be meant, or exchanged with elevations"}};
}

Alignment choose_alignment(const AxisFile& file, const std::string& name) {
  const AxisOfFile& chosen = named_axis(file, name);
  if (chosen.grade_refusal) throw Error(*chosen.grade_refusal);
  if (chosen.axis->vertical().empty()) {
    throw Error("alignment " + chosen.name + " has no grade line", file.file, "export it with its Profile");
  }
  if (chosen.axis->from_m() >= chosen.axis->to_m())
    throw Error("the grade line of alignment " + chosen.name +
                    " lies beside its plan: " + grade_coverage(*chosen.axis).front().words,
                file.file, "export the whole grade line");
  return *chosen.axis;
}

}  // namespace adit::io
