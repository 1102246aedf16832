#pragma once
// The section through two scans where they overlap.

#include <string>

#include "core/registration/overlap_section.h"
#include "core/registration/registration.h"
#include "render/canvas.h"

namespace adit::render {

/// A pair with its section.
struct PairSection {
  PairResult pair;
  OverlapSection section;
};

/// The whole section, and beside it two places 0.4 m wide, above and to the right (or at the other sides where the
/// scans do not meet there), where millimetres show. Blue: the scan that was laid on; orange: the one laid. Names and
/// figures beneath.
void draw_overlap(Canvas& canvas, const Rect& rect, const PairSection& shown);

/// The same as a picture of its own.
Picture overlap_picture(const PairSection& shown, double width_mm, double height_mm);

}  // namespace adit::render
