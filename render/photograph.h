#pragma once
// A simulated scene as a real camera stores it.

#include "core/geometry/grey_picture.h"
#include "core/georeference/camera_lens.h"
#include "core/simulation/camera_effects.h"
#include "render/camera_scene.h"

namespace adit::render {

/// Draws the scene 2.5 times as fine as the lens's picture, in the OpenGL context that is current, with the lamp beside
/// the camera, and stores it with the lens's distortion and the effects.
GreyPicture photograph(const CameraScene& scene, const CameraLens& lens, const Pose& site_from_camera,
                       double lamp_reach_m, const CameraEffects& effects);

}  // namespace adit::render
