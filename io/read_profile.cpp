#include "io/read_profile.h"

#include <cctype>

#include "core/foundation/error.h"
#include "io/dxf.h"
#include "io/profile_csv.h"

namespace adit::io {
namespace {

std::string ending(const std::filesystem::path& file) {
  std::string lower = file.extension().string();
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace

Profile read_profile(const std::filesystem::path& file, const std::string& layer) {
  const std::string kind = ending(file);
  if (kind != ".csv" && kind != ".txt" && kind != ".dxf") {
    throw Error("a profile is read from .csv, .txt or .dxf, not from \"" + kind + "\"", file.string(),
                "export it in one of these");
  }
  return kind == ".dxf" ? read_dxf_profile(file, layer) : read_profile_csv(file);
}

}  // namespace adit::io
