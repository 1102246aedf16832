#include "io/read_profile.h"

#include "core/foundation/error.h"
#include "io/dxf.h"
#include "io/file_ending.h"
#include "io/profile_csv.h"

namespace adit::io {
Profile read_profile(const std::filesystem::path& file, const std::string& layer) {
  const std::string kind = lower_ending(file);
  if (kind != ".csv" && kind != ".txt" && kind != ".dxf") {
    throw Error("a profile is read from .csv, .txt or .dxf, not from \"" + kind + "\"", file.string(),
                "export it in one of these");
  }
  return kind == ".dxf" ? read_dxf_profile(file, layer) : read_profile_csv(file);
}

}  // namespace adit::io
