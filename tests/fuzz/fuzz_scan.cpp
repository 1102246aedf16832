// One reader against any bytes: points or an Error, never anything else. ADIT_STREAM names the reader.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "core/foundation/error.h"
#include ADIT_HEADER

namespace {

using namespace adit;

/// Takes every scan and stops the program where a block breaks its promise.
class CheckingSink : public io::ScanSink {
 public:
  bool begin(const io::ScanHeader& scan) override {
    has_ = scan.attributes;
    if (scan.file_pose && !scan.file_pose->matrix().allFinite()) std::abort();
    return true;
  }
  void take(io::PointBlock& block) override {
    const std::size_t n = block.size();
    const auto fits = [&](bool has, std::size_t length) { return length == (has ? n : 0); };
    if (n == 0 || n > io::PointBlock::most_points) std::abort();
    if (!fits(has_.intensity, block.intensity.size()) || !fits(has_.colour, block.colour.size()) ||
        !fits(has_.normals, block.normals.size()) || !fits(has_.grid, block.grid.size()))
      std::abort();
    for (const auto& p : block.positions)
      if (!p.allFinite()) std::abort();
  }
  void end(std::uint64_t) override {}

 private:
  io::Attributes has_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("scan", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  try {
    CheckingSink sink;
    Progress progress;
    io::ADIT_STREAM(path, {}, sink, progress);
  } catch (const Error& error) {
    if (error.mend().empty()) std::abort();
  }
  return 0;
}
