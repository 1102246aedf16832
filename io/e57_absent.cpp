// E57 in a build without libE57Format.

#include "core/foundation/error.h"
#include "io/e57.h"

namespace adit::io {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw Error("this build of Adit has no E57", file.string(),
              "run packaging/setup and build again, or convert the scan to PLY or LAS");
}

}  // namespace

bool e57_is_built_in() {
  return false;
}

void stream_e57(const std::filesystem::path& file, const ReadOptions&, ScanSink&, Progress&) {
  refuse(file);
}

ScanFileSummary summarise_e57(const std::filesystem::path& file, Progress&) {
  refuse(file);
}

std::unique_ptr<ScanWriter> make_e57_writer(const std::filesystem::path& file, const std::vector<ScanFacts>&,
                                            const WriteOptions&) {
  refuse(file);
}

}  // namespace adit::io
