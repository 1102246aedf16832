#pragma once
// What an ideal camera sees in a simulated tunnel: rock and coded targets in the light of a lamp beside it.

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "core/geometry/grey_picture.h"
#include "core/geometry/pose.h"
#include "core/georeference/coded_pattern.h"
#include "core/surface/mesh.h"

namespace adit::render {

/// A printed target on the wall.
struct SceneTarget {
  TargetCode code = 0;
  double radius_m = 0.075;                   ///< of the ring of segments
  Pose site_from_target = Pose::Identity();  ///< x right, y up on the paper, z towards who looks at it
};

/// Frame: that of the mesh, near its origin (float32 is enough there).
struct CameraScene {
  MeshArrays rock;
  std::vector<float> rock_albedo;  ///< of each point, 0 to 1
  std::vector<SceneTarget> targets;
  double paper_albedo = 0.85;
  double ink_albedo = 0.05;
};

/// A pinhole: pixels for a unit of the plane z = 1, principal point in the middle. Camera frame: x right, y down, z
/// ahead.
struct PinholeView {
  Pose site_from_camera = Pose::Identity();
  int width = 1280;
  int height = 960;
  double focal_px = 1000.0;
  Eigen::Vector3d lamp = Eigen::Vector3d(0.15, -0.25, 0.0);  ///< in the camera frame [m]
  double lamp_reach_m = 6.0;  ///< a white wall there, seen squarely, is as bright as the picture can show; nearer ones
                              ///< fall off by less than the square of the distance, as lamps are wide
  double ambient = 0.02;      ///< light from all sides, over the same
};

/// Draws scenes in the OpenGL context that is current (GlContext). Linear light, 255 the brightest; no blur but that of
/// the pixels' own sampling: draw larger and average.
class CameraSceneView {
 public:
  explicit CameraSceneView(const CameraScene& scene);
  ~CameraSceneView();
  CameraSceneView(const CameraSceneView&) = delete;
  CameraSceneView& operator=(const CameraSceneView&) = delete;

  GreyPicture picture(const PinholeView& view);

 private:
  struct Stage;
  std::unique_ptr<Stage> stage_;
};

}  // namespace adit::render
