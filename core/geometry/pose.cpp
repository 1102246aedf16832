#include "core/geometry/pose.h"

#include <algorithm>
#include <cmath>

namespace adit {

Pose make_pose(const Eigen::Vector3d& position, const YawPitchRoll& angles) {
  Pose pose = Pose::Identity();
  pose.linear() = (Eigen::AngleAxisd(angles.yaw_rad, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(angles.pitch_rad, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(angles.roll_rad, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = position;
  return pose;
}

YawPitchRoll yaw_pitch_roll(const Pose& pose) {
  const Eigen::Matrix3d r = pose.linear();
  YawPitchRoll angles;
  angles.pitch_rad = std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2)));
  if (std::hypot(r(2, 1), r(2, 2)) > 1e-12) {
    angles.yaw_rad = std::atan2(r(1, 0), r(0, 0));
    angles.roll_rad = std::atan2(r(2, 1), r(2, 2));
  } else {  // looking straight up or down: roll is taken as zero
    angles.yaw_rad = std::atan2(-r(0, 1), r(1, 1));
  }
  return angles;
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.axis() * turn.angle();
}

Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  if (angle < 1e-15) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector_rad / angle).toRotationMatrix();
}

double rotation_between_rad(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.linear().transpose() * b.linear())).angle();
}

double distance_between_m(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}

bool is_rigid(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) return false;
  const Eigen::Matrix3d r = matrix.topLeftCorner<3, 3>();
  return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 && r.determinant() > 0.0 &&
         (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < 1e-9;
}

}  // namespace adit
