#pragma once
// VTK drawing into the OpenGL context that is current, without a window of its own.

#include <vtkGenericOpenGLRenderWindow.h>

#include <cstdint>
#include <vector>

namespace adit::render {

/// Makes the window draw into buffers of its own in the current context.
void begin_off_screen(vtkGenericOpenGLRenderWindow& window);

/// Draws. Others draw in the same context, so what VTK remembers of its state is forgotten before.
void draw_off_screen(vtkGenericOpenGLRenderWindow& window);

/// The last frame: red, green, blue of each pixel, rows from the top.
std::vector<std::uint8_t> off_screen_rgb(vtkGenericOpenGLRenderWindow& window);

}  // namespace adit::render
