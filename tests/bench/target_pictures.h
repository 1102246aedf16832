#pragma once
// Pictures of a simulated tunnel with coded targets, and what is true of them.

#include <string>
#include <vector>

#include "core/georeference/camera_pose.h"
#include "core/georeference/detect_targets.h"
#include "core/simulation/camera_effects.h"
#include "core/simulation/rock_mesh.h"
#include "render/camera_scene.h"

namespace adit::bench {

/// A curved, falling rock tunnel of 60 m in a local frame.
RockTunnel picture_tunnel(std::uint64_t seed);

/// A camera of a megapixel with some distortion.
CameraLens picture_lens();

/// A camera in the tunnel: at a chainage, `aside_m` right of the axis, looking along it, turned by small angles.
Pose camera_in(const RockTunnel& tunnel, double chainage_m, double aside_m, double height_m,
               const Eigen::Vector3d& turned_rad);

struct PictureOfTargets {
  GreyPicture picture;
  struct Truth {
    int id = 0;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double diameter_px = 0.0;
    double tilt_rad = 0.0;  ///< of the target against the line of sight
  };
  std::vector<Truth> targets;  ///< wholly in the picture
};

/// Renders and spoils.
PictureOfTargets take_picture(const render::CameraScene& scene, const CameraLens& lens, const Pose& site_from_camera,
                              double lamp_reach_m, const CameraEffects& effects);

/// Into the folder that ADIT_BENCH_PICTURES names, if it does.
void keep(const GreyPicture& picture, const std::string& name);

/// Of the first ids; of any where that is target_code_count.
DetectOptions options_of(const CameraLens& lens, int most_id);

/// The paper's tables 1 to 4 on stations along the tunnel, POSIT beside OpenCV's solvePnP, and the time it takes.
void bench_target_stations(const RockTunnel& tunnel, const RockMesh& rock);

}  // namespace adit::bench
