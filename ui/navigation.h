#pragma once
// How the mouse moves a camera.

#include "render/camera.h"

namespace adit::ui {

/// Dragged by so many pixels in a picture of a height: an orthographic camera goes round what it looks at, the other
/// turns its head. The horizon stays level.
render::Camera turned(render::Camera camera, double right_px, double down_px, double height_px);

/// Dragged sideways: what is seen follows the mouse.
render::Camera shifted(render::Camera camera, double right_px, double down_px, double height_px);

/// Turned by clicks of the wheel: nearer (positive) or farther; the other camera walks ahead.
render::Camera nearer(render::Camera camera, double clicks);

}  // namespace adit::ui
