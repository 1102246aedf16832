#pragma once
// Points and lines from KOF, the Norwegian exchange format of coordinates.

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/foundation/finding.h"
#include "core/georeference/control.h"
#include "io/axis_file.h"

namespace adit::io {

/// A point record (05). Without elevation the file gives none.
struct KofPoint {
  std::string name;
  std::string code;
  Eigen::Vector2d plan = Eigen::Vector2d::Zero();  ///< east, north [m]
  std::optional<double> elevation_m;
  std::string place;  ///< file and line
};

struct KofFile {
  std::vector<KofPoint> points;
  std::vector<std::vector<std::size_t>> lines;  ///< points between records 09 91 and 09 99 (09 96 closes)
  Findings findings;                            ///< orders that contradict each other, records that are not read
};

/// Records 05: name, code, two coordinates, elevation, in columns or, where a line holds tabs, between blanks. Which
/// coordinate comes first is what record 01 says (north when it says nothing); where one is a northing in any Norwegian
/// grid and the other can be none (a million metres and more beside less), that decides, and a contradiction is a
/// warning. Throws Error with file, line and column for what is no number and for lines that do not end.
KofFile read_kof(const std::filesystem::path& file);

/// The points as control. Throws Error where one has no name or no elevation, or two have one name.
std::vector<ControlPoint> control_of(const KofFile& kof);

/// The lines as axes, named "line 1" and so on. `start_chainage_m` is needed: KOF states none.
AxisFile axes_of(const KofFile& kof, const std::filesystem::path& file, const std::optional<double>& start_chainage_m);

}  // namespace adit::io
