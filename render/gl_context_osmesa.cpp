// Linked into headless programs only (cmake/adit_headless.cmake): with a window the machine's own driver must win.
//
// Debian's VTK 9.1 can draw into a context it did not make, but its loader (GLEW) asks for symbols by the GLX function
// and ends by asking for an X display. The two exported functions at the end answer in their place.

#include <GL/osmesa.h>

#include <cstdint>
#include <vector>

#include "core/foundation/error.h"
#include "render/gl_context.h"

namespace adit::render {
namespace {

struct MemoryContext {
  OSMesaContext context = nullptr;
  int width;
  int height;
  std::vector<std::uint8_t> pixels;

  MemoryContext(int w, int h)
      : width(w), height(h), pixels(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_STENCIL_BITS,
                              8,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (context == nullptr) throw Error("no OpenGL 3.3 context in memory", "OSMesa", "install libosmesa6");
  }
  ~MemoryContext() { OSMesaDestroyContext(context); }
  MemoryContext(const MemoryContext&) = delete;
  MemoryContext& operator=(const MemoryContext&) = delete;

  void make_current() {
    if (OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, width, height) != GL_TRUE)
      throw Error("the OpenGL context in memory could not be made current", "OSMesa");
  }
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context(int width, int height) {
  auto memory = std::make_shared<MemoryContext>(width, height);
  memory->make_current();
  return std::make_unique<GlContext>([memory] { memory->make_current(); });
}

}  // namespace adit::render

extern "C" {
__attribute__((visibility("default"))) OSMESAproc glXGetProcAddressARB(const unsigned char* name) {
  return OSMesaGetProcAddress(reinterpret_cast<const char*>(name));
}
__attribute__((visibility("default"))) unsigned int glxewInit() {
  return 0;
}
}
