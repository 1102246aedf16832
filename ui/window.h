#pragma once
// The window on the screen: GLFW, its two OpenGL contexts and the loop of frames.

#include <memory>
#include <optional>

#include "app/step.h"
#include "ui/gui.h"

struct GLFWwindow;

namespace adit::ui {

class Window {
 public:
  /// Opens the window. Throws Error that names DISPLAY when there is no screen, or OpenGL 3.3 is missing.
  Window();
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// A second context for the report's pictures, usable on the job's thread.
  app::StepContext step_context();

  /// Draws frames until the window is closed; sleeps while nothing changes.
  void run(Workspace& workspace);

 private:
  struct Glfw;      ///< the library, from its start to its end
  struct Listener;  ///< what the callbacks write to

  std::unique_ptr<Glfw> glfw_;
  GLFWwindow* window_ = nullptr;
  GLFWwindow* hidden_ = nullptr;  ///< owns the job thread's context
  std::unique_ptr<Listener> listener_;
  std::optional<Gui> gui_;
};

}  // namespace adit::ui
