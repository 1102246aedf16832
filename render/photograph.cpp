#include "render/photograph.h"

namespace adit::render {

GreyPicture photograph(const CameraScene& scene, const CameraLens& lens, const Pose& site_from_camera,
                       double lamp_reach_m, const CameraEffects& effects) {
  constexpr double finer = 2.5;
  const IdealSize size = ideal_size(lens, finer);
  PinholeView view;
  // The camera at the origin: float32 is then fine enough to tell ink from paper.
  const Eigen::Vector3d& eye = site_from_camera.translation();
  CameraScene near = scene;
  for (Eigen::Vector3d& point : near.rock.points) point -= eye;
  for (SceneTarget& target : near.targets) target.site_from_target.translation() -= eye;
  view.site_from_camera.linear() = site_from_camera.linear();
  view.width = size.width;
  view.height = size.height;
  view.focal_px = size.focal_px;
  view.lamp_reach_m = lamp_reach_m;
  return stored_picture(CameraSceneView(near).picture(view), size.focal_px, lens, effects);
}

}  // namespace adit::render
