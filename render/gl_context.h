#pragma once
// The OpenGL context scenes are drawn in. Whoever owns one (a window, or memory without a screen) hands it over.

#include <functional>
#include <memory>
#include <utility>

namespace adit::render {

/// A context and the way to make it current on the calling thread. VTK is never told where it came from.
class GlContext {
 public:
  explicit GlContext(std::function<void()> make_current) : make_current_(std::move(make_current)) {}
  void make_current() const { make_current_(); }

 private:
  std::function<void()> make_current_;  ///< owns what it needs
};

/// A context in memory: OpenGL 3.3 core by Mesa's software renderer, no X server and no GPU. Current on the calling
/// thread. Only in programs declared with adit_headless() in CMake. Throws Error when Mesa refuses.
std::unique_ptr<GlContext> make_osmesa_context(int width = 16, int height = 16);

}  // namespace adit::render
