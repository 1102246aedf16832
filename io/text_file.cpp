#include "io/text_file.h"

#include "core/foundation/error.h"
#include "io/bytes.h"

namespace adit::io {

std::string read_text_file(const std::filesystem::path& path) {
  const InputFile file(path);
  if (file.size() > (1U << 28))
    throw Error("the file is larger than 256 MiB", file.name(), "a small text file is needed");
  return file.beginning(static_cast<std::size_t>(file.size()));
}

}  // namespace adit::io
