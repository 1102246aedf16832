#pragma once
// What of a DXF drawing can become a design line.

#include <filesystem>
#include <string>
#include <vector>

#include "core/design/profile_piece.h"

namespace adit::io {

/// One entity: connected segments in the drawing's units. A closed one ends where it starts.
struct DxfLine {
  std::string layer;
  std::vector<ProfileSegment> segments;
  bool closed = false;
  std::vector<double> heights;  ///< z of each segment's start, and of the last one's end
  int directed = 1;  ///< entities it is chained of that were drawn in a direction: all but arcs, which run one way only
  int reversed = 0;  ///< of them, those that were drawn the other way
};

struct DxfDrawing {
  double metres_per_unit = 1.0;
  std::vector<DxfLine> lines;
  std::string unread;  ///< kinds of entities that may be part of a line but are not read: "SPLINE, INSERT"
};

/// Throws Error with line and column where a number or group code is none, when the file is cut off, binary, or its
/// unit is not known.
DxfDrawing read_dxf_entities(const std::filesystem::path& file);

/// The check of the text alone, before the library reads it (which takes what is no number for zero).
void check_dxf_text(const std::filesystem::path& file);

}  // namespace adit::io
