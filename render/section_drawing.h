#pragma once
// A section sheet: design lines, the rock as it was seen, over- and underbreak, numbers.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/geometry/polygon.h"
#include "core/profiling/section.h"
#include "render/canvas.h"

namespace adit::render {

/// A design line at one chainage as a ring (x right, z up) [m], clockwise.
struct SectionLine {
  std::string name;
  double offset_m = 0.0;
  Polygon ring;
};

/// The lines of the design at a chainage, arcs within 1 mm.
std::vector<SectionLine> section_lines(const DesignTunnel& design, double chainage_m);

/// Draws one section into the rectangle (at least 70 x 70 mm), looking up-chainage, at a round scale. The first line is
/// the reference: over- and underbreak are filled against it. Unseen parts are dotted along it and never filled.
void draw_section(Canvas& canvas, const Rect& rect, const Section& section, const std::vector<SectionLine>& lines);

/// "Section 118.00" or, where the displayed station differs, "Section 118.00 (station 1118.00)".
std::string section_title(const Section& section);

}  // namespace adit::render
