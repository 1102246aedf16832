#include "app/landmarks.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "core/foundation/error.h"
#include "core/georeference/coded_pattern.h"
#include "io/read_control.h"

namespace adit::app {

std::optional<int> target_id(std::string_view word) {
  int id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole && id >= 1 && id <= target_code_count ? std::optional(id) : std::nullopt;
}

Landmarks read_landmarks(const std::filesystem::path& file) {
  Landmarks landmarks;
  for (const ControlPoint& point : io::read_control(file).points) {
    const auto id = target_id(point.id);
    if (!id) continue;
    if (!landmarks.emplace(*id, point.position).second)
      throw Error("target " + std::to_string(*id) + " stands in it twice", file.string(), "keep one of them");
  }
  if (landmarks.empty())
    throw Error("it holds no coded target", file.string(),
                "write id,east,north,elevation with ids from 1 to " + std::to_string(target_code_count));
  return landmarks;
}

CameraPose locate_by_landmarks(const CameraLens& lens, const std::vector<LandmarkSight>& sights,
                               const std::vector<int>& unknown, const CameraPoseOptions& options) {
  try {
    return locate_camera(lens, sights, options);
  } catch (const Error& error) {
    if (unknown.empty()) throw;
    constexpr std::size_t most_named = 12;
    std::string ids;
    for (std::size_t i = 0; i < std::min(unknown.size(), most_named); ++i)
      ids += (ids.empty() ? "" : ", ") + std::to_string(unknown[i]);
    if (unknown.size() > most_named) ids += " and more";
    throw Error(error.what_is_wrong() + " (seen, too, and in no table: " + ids + ")", error.where(), error.mend());
  }
}

}  // namespace adit::app
