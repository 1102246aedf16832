#include "io/read_profile.h"

#include <cctype>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/dxf.h"
#include "io/profile_csv.h"

namespace adit::io {
namespace {

constexpr double largest_m = 200.0;

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
  Profile profile = kind == ".dxf" ? read_dxf_profile(file, layer) : read_profile_csv(file);
  const Eigen::Vector2d size = profile.box().sizes();
  if (size.maxCoeff() > largest_m) {
    throw Error("the profile is " + short_number(std::round(size.x())) + " m wide and " +
                    short_number(std::round(size.y())) + " m high",
                file.string(), "check its unit; a table is in metres, a drawing states its unit in $INSUNITS");
  }
  return profile;
}

}  // namespace adit::io
