// LAZ in a build without LASzip.

#include "core/foundation/error.h"
#include "io/laz.h"

namespace adit::io {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw Error("this build of Adit has no LAZ", file.string(),
              "run packaging/setup and build again, or convert the scan to LAS");
}

}  // namespace

bool laz_is_built_in() {
  return false;
}

void stream_laz(const std::filesystem::path& file, const ReadOptions&, ScanSink&, Progress&) {
  refuse(file);
}

std::unique_ptr<ScanWriter> make_laz_writer(const std::filesystem::path& file, const std::vector<ScanFacts>&,
                                            const WriteOptions&) {
  refuse(file);
}

}  // namespace adit::io
