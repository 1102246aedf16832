// The point store against any bytes.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "core/foundation/error.h"
#include "io/point_store.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("store", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  try {
    const adit::io::PointStore store(path);
    for (std::size_t t = 0; t < store.tile_count(); ++t) store.read(t);
  } catch (const adit::Error&) {
  }
  return 0;
}
