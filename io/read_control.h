#pragma once
// Control points from whatever file names them.

#include <filesystem>
#include <vector>

#include "core/foundation/finding.h"
#include "core/georeference/control.h"

namespace adit::io {

struct ControlFile {
  std::vector<ControlPoint> points;
  Findings findings;
};

/// KOF by its ending, else a table id,east,north,elevation. Errors are those of the format, with file and line.
ControlFile read_control(const std::filesystem::path& file);

}  // namespace adit::io
