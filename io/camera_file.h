#pragma once
// Camera calibrations as OpenCV writes them (YAML).

#include <filesystem>
#include <string>

#include "core/georeference/camera_lens.h"

namespace adit::io {

/// image_width, image_height, camera_matrix (3 x 3) and distortion_coefficients (4, 5 or 8, in OpenCV's order). Throws
/// Error with the file and the key for what is missing or cannot be a camera.
CameraLens read_camera(const std::filesystem::path& path);

/// The same file; `note` becomes a comment line.
std::string camera_text(const CameraLens& lens, const std::string& note);

}  // namespace adit::io
