#pragma once
// Surveyed coded targets by their id.

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "core/georeference/camera_pose.h"

namespace adit::app {

/// Site coordinates by id.
using Landmarks = std::map<int, Eigen::Vector3d>;

/// The id of a coded target that a whole word is; nothing for other words.
std::optional<int> target_id(std::string_view word);

/// The coded targets of a table of control points; points of other names are passed over. Throws Error for an id that
/// stands twice ("7" and "007", too) and a file without any.
Landmarks read_landmarks(const std::filesystem::path& file);

/// locate_camera, whose refusal then also names the targets that are seen and that the table lacks.
CameraPose locate_by_landmarks(const CameraLens& lens, const std::vector<LandmarkSight>& sights,
                               const std::vector<int>& unknown, const CameraPoseOptions& options);

}  // namespace adit::app
