#include "ui/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>

#include "core/foundation/error.h"

namespace adit::ui {
namespace {

constexpr int settling_frames = 3;  // ImGui needs a frame or two after each event
constexpr double awake_s = 0.05;    // between frames while something is under way
constexpr double asleep_s = 0.5;    // longest wait for an event

Error no_window() {
  const char* words = nullptr;
  glfwGetError(&words);
  const char* display = std::getenv("DISPLAY");
  const std::string where =
      display == nullptr || *display == '\0' ? "DISPLAY is not set" : std::string("DISPLAY ") + display;
  return Error(std::string("no window can be opened (") + (words == nullptr ? "no reason is given" : words) + ")",
               where, "start adit-gui in a desktop session, or use adit, which needs no screen");
}

GLFWwindow* make_window(int width, int height, bool visible) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  return glfwCreateWindow(width, height, "Adit", nullptr, nullptr);
}

float scale_of(GLFWwindow* window) {
  float x = 1.0F, y = 1.0F;
  glfwGetWindowContentScale(window, &x, &y);
  return std::clamp(std::max(x, y), 0.5F, 4.0F);
}

}  // namespace

struct Window::Glfw {
  Glfw() {
    if (glfwInit() != GLFW_TRUE) throw no_window();
  }
  ~Glfw() { glfwTerminate(); }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

struct Window::Listener {
  std::string dropped;
  bool run_wanted = false;
  bool scale_changed = false;

  static Listener& of(GLFWwindow* window) { return *static_cast<Listener*>(glfwGetWindowUserPointer(window)); }
  static void on_drop(GLFWwindow* window, int count, const char** paths) {
    if (count > 0) of(window).dropped = paths[0];
  }
  static void on_scale(GLFWwindow* window, float, float) { of(window).scale_changed = true; }
  static void on_key(GLFWwindow* window, int key, int, int action, int mods) {
    if (action != GLFW_PRESS) return;
    if (key == GLFW_KEY_Q && (mods & GLFW_MOD_CONTROL) != 0) glfwSetWindowShouldClose(window, GLFW_TRUE);
    if (key == GLFW_KEY_F5) of(window).run_wanted = true;
  }
};

Window::Window() : glfw_(std::make_unique<Glfw>()), listener_(std::make_unique<Listener>()) {
  window_ = make_window(1440, 900, true);
  hidden_ = window_ == nullptr ? nullptr : make_window(16, 16, false);
  if (hidden_ == nullptr) throw no_window();
  glfwSetWindowSizeLimits(window_, 800, 560, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, listener_.get());
  glfwSetDropCallback(window_, Listener::on_drop);
  glfwSetWindowContentScaleCallback(window_, Listener::on_scale);
  glfwSetKeyCallback(window_, Listener::on_key);
  gui_.emplace(scale_of(window_));
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // passes events on to the callbacks above
}

Window::~Window() {
  if (gui_) ImGui_ImplGlfw_Shutdown();
  gui_.reset();
  if (hidden_ != nullptr) glfwDestroyWindow(hidden_);
  if (window_ != nullptr) glfwDestroyWindow(window_);
}

app::StepContext Window::step_context() {
  // A context can be current on one thread only: given back by the job's thread when the step has drawn its pictures.
  return {[hidden = hidden_] {
    const std::shared_ptr<GLFWwindow> held(hidden, [](GLFWwindow*) { glfwMakeContextCurrent(nullptr); });
    auto context = std::make_unique<render::GlContext>([held] { glfwMakeContextCurrent(held.get()); });
    context->make_current();
    return context;
  }};
}

void Window::run(Workspace& workspace) {
  Screen screen;
  int frames = settling_frames;
  while (glfwWindowShouldClose(window_) == GLFW_FALSE) {
    const bool under_way = workspace.doing() != Workspace::Doing::nothing || screen.busy();
    if (frames > 0) {
      glfwPollEvents();
    } else {
      const auto start = std::chrono::steady_clock::now();
      const double wait_s = under_way ? awake_s : asleep_s;
      glfwWaitEventsTimeout(wait_s);
      const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
      if (under_way || ImGui::GetIO().WantTextInput) frames = 1;
      if (waited.count() < 0.95 * wait_s) frames = settling_frames;
      if (frames == 0) continue;
    }
    --frames;
    if (!listener_->dropped.empty()) workspace.open(std::exchange(listener_->dropped, {}));
    if (std::exchange(listener_->run_wanted, false)) workspace.run();
    if (std::exchange(listener_->scale_changed, false)) gui_->set_scale(scale_of(window_));
    ImGui_ImplGlfw_NewFrame();
    gui_->draw(screen, workspace);
    glfwSwapBuffers(window_);
  }
}

}  // namespace adit::ui
