#pragma once
// Cameras fixed to a scanner, and what their pictures say of where it stood.

#include <string>

#include "core/geometry/pose.h"

namespace adit {

/// A camera fixed to the scanner: the lever arm, and how well it is known. Camera frame: x right, y down, z ahead.
struct RigCamera {
  std::string name;
  Pose scan_from_camera = Pose::Identity();
  double sigma_m = 0.002;     ///< of each coordinate
  double sigma_rad = 0.0005;  ///< of each small turn
};

/// Where a camera stood during a scan, by a picture of surveyed targets (locate_camera).
struct CameraSight {
  std::string scan;
  std::string picture;
  std::size_t camera = 0;  ///< index of the RigCamera
  Pose local_from_camera = Pose::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< position [m], then small turns about local axes [rad]
};

/// A camera that looks along x of the scanner's frame, upright, turned by these angles as a body (x ahead, z up) is.
inline Pose lever_arm(const Eigen::Vector3d& position, const YawPitchRoll& angles) {
  Pose body_from_camera = Pose::Identity();
  body_from_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return make_pose(position, angles) * body_from_camera;
}

/// The angles of lever_arm back from a pose.
inline YawPitchRoll lever_arm_angles(const Pose& scan_from_camera) {
  return yaw_pitch_roll(scan_from_camera * lever_arm(Eigen::Vector3d::Zero(), {}).inverse());
}

}  // namespace adit
