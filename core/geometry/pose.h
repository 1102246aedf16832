#pragma once
// Rigid transforms in double precision, always named target_from_source.

#include <Eigen/Geometry>

namespace adit {

using Pose = Eigen::Isometry3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Angles at the borders: R = Rz(yaw) Ry(pitch) Rx(roll), radians.
struct YawPitchRoll {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

Pose make_pose(const Eigen::Vector3d& position, const YawPitchRoll& angles);
YawPitchRoll yaw_pitch_roll(const Pose& pose);

/// Rotation vector (axis times angle [rad]) of a rotation matrix, and back.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);
Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& vector_rad);

/// Angle [rad] and distance [m] between two poses of the same frames.
double rotation_between_rad(const Pose& a, const Pose& b);
double distance_between_m(const Pose& a, const Pose& b);

/// True when the matrix is finite, right-handed and orthonormal to 1e-6.
bool is_rigid(const Eigen::Matrix4d& matrix);

}  // namespace adit
