#include "io/read_profile.h"

#include "core/foundation/error.h"
#include "io/dxf.h"
#include "io/file_ending.h"
#include "io/profile_csv.h"

namespace adit::io {

Profile read_profile(const std::filesystem::path& file, const std::string& layer, const ProfileSizes& sizes) {
  const std::string kind = lower_ending(file);
  if (kind != ".csv" && kind != ".txt" && kind != ".dxf" && kind != ".json") {
    throw Error("a profile is read from .csv, .txt, .dxf or .json, not from \"" + kind + "\"", file.string(),
                "export it in one of these");
  }
  if (!sizes.empty() && kind != ".json")
    throw Error("only a .json profile takes sizes", file.string(), "leave \"sizes\" out");
  if (!layer.empty() && kind == ".json")
    throw Error("a .json profile has no layers", file.string(), "leave \"layer\" out");
  if (kind == ".json") return read_profile_json(file, sizes);
  return kind == ".dxf" ? read_dxf_profile(file, layer) : read_profile_csv(file);
}

}  // namespace adit::io
