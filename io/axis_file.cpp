#include "io/axis_file.h"

namespace adit::io {
namespace {

std::string names_of(const AxisFile& file) {
  std::string names;
  for (const FileAxis& axis : file.axes) names += (names.empty() ? "\"" : ", \"") + axis.name + "\"";
  return names;
}

}  // namespace

const FileAxis& named_axis(const AxisFile& file, const std::string& name) {
  if (file.axes.empty()) throw Error("the file holds no alignment", file.file, "export the axis with its geometry");
  const FileAxis* found = nullptr;
  for (const FileAxis& axis : file.axes) {
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

Alignment choose_alignment(const AxisFile& file, const std::string& name) {
  const FileAxis& chosen = named_axis(file, name);
  if (chosen.grade_refusal) throw Error(*chosen.grade_refusal);
  if (chosen.axis->vertical().empty()) {
    throw Error("alignment " + chosen.name + " has no grade line", file.file, "export it with its Profile");
  }
  return *chosen.axis;
}

}  // namespace adit::io
