#include "io/read_axis.h"

#include "io/axis_csv.h"
#include "io/axis_dxf.h"
#include "io/file_ending.h"
#include "io/ifc_alignment.h"
#include "io/kof.h"
#include "io/landxml.h"

namespace adit::io {

AxisFile read_axis(const std::filesystem::path& file, const std::optional<double>& start_chainage_m) {
  const std::string ending = lower_ending(file);
  if (ending == ".csv" || ending == ".txt") return read_axis_csv(file, start_chainage_m);
  if (ending == ".kof") return axes_of(read_kof(file), file, start_chainage_m);
  if (ending == ".dxf") return read_dxf_axes(file, start_chainage_m);
  if (ending != ".xml" && ending != ".landxml" && ending != ".ifc")
    throw Error("an axis is read from .xml, .ifc, .dxf, .kof, .csv or .txt, not from \"" + ending + "\"", file.string(),
                "export it in one of these");
  if (start_chainage_m)
    throw Error("the file states its chainages, and a start chainage is given, too", file.string(),
                "leave the start chainage out");
  return ending == ".ifc" ? read_ifc_alignments(file) : read_landxml(file);
}

}  // namespace adit::io
