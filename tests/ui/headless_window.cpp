#include "tests/ui/headless_window.h"

#include <GL/gl.h>
#include <imgui.h>

#include <chrono>
#include <thread>

namespace adit::tests {

using Clock = std::chrono::steady_clock;

HeadlessWindow::HeadlessWindow(int width, int height)
    : width_(width), height_(height), context_(render::make_osmesa_context(width, height)), gui_(1.0F) {
  ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  ImGui::GetIO().MousePos = {-1.0F, -1.0F};
}

app::StepContext HeadlessWindow::step_context() {
  return {[] { return render::make_osmesa_context(); }};
}

void HeadlessWindow::frame(ui::Workspace& workspace) {
  ImGui::GetIO().DeltaTime = 1.0F / 30.0F;
  gui_.draw(screen_, workspace);
  glFinish();  // nothing swaps buffers here: frames would queue up without end
}

bool HeadlessWindow::frames_until(ui::Workspace& workspace, const std::function<bool()>& done, double most_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(most_s);
  while (!done()) {
    if (Clock::now() > end) return false;
    frame(workspace);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

bool HeadlessWindow::settle(ui::Workspace& workspace, double most_s) {
  const auto still = [&] {
    return workspace.script().finished() && workspace.doing() == ui::Workspace::Doing::nothing && !screen_.busy();
  };
  frame(workspace);
  if (!frames_until(workspace, still, most_s)) return false;
  for (int i = 0; i < 3; ++i) frame(workspace);
  return frames_until(workspace, still, most_s);
}

void HeadlessWindow::click_at(ui::Workspace& workspace, float x, float y) {
  drag(workspace, x, y, 0.0F, 0.0F);
}

bool HeadlessWindow::click(ui::Workspace& workspace, const std::string& widget) {
  const auto place = workspace.script().place(widget);
  if (!place) return false;
  click_at(workspace, (place->left + place->right) / 2.0F, (place->top + place->bottom) / 2.0F);
  return true;
}

void HeadlessWindow::drag(ui::Workspace& workspace, float x, float y, float right, float down) {
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {x, y};
  frame(workspace);
  io.MouseDown[0] = true;
  frame(workspace);
  io.MousePos = {x + right, y + down};
  frame(workspace);
  io.MouseDown[0] = false;
  frame(workspace);
  io.MousePos = {-1.0F, -1.0F};
  frame(workspace);
}

void HeadlessWindow::wheel(ui::Workspace& workspace, float x, float y, float clicks) {
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {x, y};
  frame(workspace);
  io.MouseWheel = clicks;
  frame(workspace);
  io.MousePos = {-1.0F, -1.0F};
  frame(workspace);
}

render::Picture HeadlessWindow::picture() const {
  render::Picture upside_down = render::blank_picture(width_, height_);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.rgba.data());
  render::Picture result = upside_down;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      auto pixel = upside_down.pixel(x, height_ - 1 - y);
      pixel[3] = 255;
      result.set_pixel(x, y, pixel);
    }
  return result;
}

}  // namespace adit::tests
