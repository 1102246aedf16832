#pragma once
// The face as it is seen from the tunnel: how far each place stands before or behind its mean.

#include <string>
#include <vector>

#include "core/profiling/face.h"
#include "render/canvas.h"
#include "render/section_drawing.h"

namespace adit::render {

/// Draws a face into the rectangle (at least 60 x 60 mm), looking up-chainage, with the design lines, a legend and its
/// numbers. Colours as on the deviation map: red is farther along the chainage than the mean, blue less far. Hidden
/// cells are hatched.
void draw_face(Canvas& canvas, const Rect& rect, const std::string& title, const FaceMap& face,
               const std::vector<SectionLine>& lines);

}  // namespace adit::render
