#pragma once
// Points of rings measured by total station, from whatever file names them.

#include <filesystem>
#include <vector>

#include "core/foundation/finding.h"
#include "core/profiling/rings.h"

namespace adit::io {

struct RingFile {
  std::vector<RingPoint> points;
  Findings findings;  ///< columns that are not read (notes)
};

/// A table ring,point,east,north,elevation with an optional column target_offset, whose header may name the columns in
/// another order and others between them; or LandXML, where every CgPoints group with a name is a ring and a Property
/// "targetOffset" of a point its offset. Points without an offset of their own get `target_offset_m`. Throws Error with
/// file and line for what is no number, a ring or point without a name, a point that stands twice in its ring, and
/// offsets over half a metre.
RingFile read_rings(const std::filesystem::path& file, double target_offset_m);

}  // namespace adit::io
