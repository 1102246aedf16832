#pragma once
// The twin of ui/window.h without a screen: the same frames in memory, mouse and script by hand.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "render/gl_context.h"
#include "render/picture.h"
#include "ui/gui.h"

namespace adit::tests {

class HeadlessWindow {
 public:
  HeadlessWindow(int width, int height);

  /// Contexts in memory for the job's thread.
  static app::StepContext step_context();

  /// One frame at 30 a second.
  void frame(ui::Workspace& workspace);
  /// Frames until `done`, a fiftieth of a second apart; false when it does not come about in time.
  bool frames_until(ui::Workspace& workspace, const std::function<bool()>& done, double most_s);
  /// Frames until the script has been played and nothing is under way any more.
  bool settle(ui::Workspace& workspace, double most_s = 60.0);

  /// Presses and releases the left button over a widget; false when it is not there.
  bool click(ui::Workspace& workspace, const std::string& widget);
  void click_at(ui::Workspace& workspace, float x, float y);
  /// Presses at a place, moves and lets go.
  void drag(ui::Workspace& workspace, float x, float y, float right, float down);
  void wheel(ui::Workspace& workspace, float x, float y, float clicks);

  /// What the last frame shows.
  render::Picture picture() const;

 private:
  int width_;
  int height_;
  std::unique_ptr<render::GlContext> context_;
  ui::Gui gui_;
  ui::Screen screen_;
};

}  // namespace adit::tests
