#pragma once
// Dear ImGui over the OpenGL context that is current: what the window and its headless twin share.

#include "ui/screen.h"
#include "ui/workspace.h"

namespace adit::ui {

/// One at a time. The caller owns the context and feeds ImGui's input (a GLFW window, or a test by hand). Throws Error
/// when OpenGL 3.3 cannot be reached.
class Gui {
 public:
  explicit Gui(float scale);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// For a screen of another resolution; between frames.
  void set_scale(float scale);

  /// Draws one frame into the context's own framebuffer. ImGui's display size and input have been set by the caller,
  /// who shows the frame afterwards.
  void draw(Screen& screen, Workspace& workspace);
};

}  // namespace adit::ui
