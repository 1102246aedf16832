// Dear ImGui's loader opens libGL by name. In a program without a screen (adit_headless_imgui in CMake) dlopen and
// dlsym are wrapped at link time, so that it finds Mesa's renderer in memory instead.

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cstring>

extern "C" {
void* __real_dlopen(const char* file, int mode);
void* __real_dlsym(void* library, const char* symbol);

void* __wrap_dlopen(const char* file, int mode) {
  const bool gl = file != nullptr && std::strncmp(file, "libGL.so", 8) == 0;
  return __real_dlopen(gl ? "libOSMesa.so.8" : file, mode);
}

void* __wrap_dlsym(void* library, const char* symbol) {
  if (std::strcmp(symbol, "glXGetProcAddressARB") == 0) return reinterpret_cast<void*>(&OSMesaGetProcAddress);
  return __real_dlsym(library, symbol);
}
}
