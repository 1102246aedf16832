#include "io/read_profile.h"

#include "core/foundation/error.h"
#include "io/dxf.h"
#include "io/file_ending.h"
#include "io/landxml_profiles.h"
#include "io/profile_csv.h"

namespace adit::io {

Profile read_profile(const std::filesystem::path& file, const std::string& layer, const ProfileSizes& sizes) {
  const std::string kind = lower_ending(file);
  if (kind != ".csv" && kind != ".txt" && kind != ".dxf" && kind != ".json") {
    throw Error("a profile is read from .csv, .txt, .dxf, .json or .xml, not from \"" + kind + "\"", file.string(),
                "export it in one of these");
  }
  if (!sizes.empty() && kind != ".json")
    throw Error("only a .json profile takes sizes", file.string(), "leave \"sizes\" out");
  if (!layer.empty() && kind == ".json")
    throw Error("a .json profile has no layers", file.string(), "leave \"layer\" out");
  if (kind == ".json") return read_profile_json(file, sizes);
  return kind == ".dxf" ? read_dxf_profile(file, layer) : read_profile_csv(file);
}

std::vector<ProfileFrom> read_profiles(const std::filesystem::path& file, const std::string& layer,
                                       const ProfileSizes& sizes, double from_m, bool interpolated) {
  const std::string kind = lower_ending(file);
  if (kind != ".xml" && kind != ".landxml") return {{from_m, read_profile(file, layer, sizes), interpolated}};
  if (!sizes.empty()) throw Error("only a .json profile takes sizes", file.string(), "leave \"sizes\" out");
  constexpr double not_stated_m = -1e9;
  if (from_m > not_stated_m)
    throw Error("the sections of LandXML state their own stations", file.string(), "leave \"from\" out");
  std::vector<ProfileFrom> profiles = read_landxml_profiles(file, layer);
  for (ProfileFrom& profile : profiles) profile.interpolated = interpolated;
  return profiles;
}

}  // namespace adit::io
