#pragma once
// Where a camera stood, from surveyed targets in its picture.

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/foundation/finding.h"
#include "core/geometry/pose.h"
#include "core/georeference/camera_lens.h"

namespace adit {

/// A surveyed target in a picture.
struct LandmarkSight {
  std::string id;
  Eigen::Vector3d site = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 0.1;  ///< of each coordinate
};

struct CameraPoseOptions {
  double landmark_sigma_m = 0.003;  ///< of each surveyed coordinate
  double lens_sigma_px = 0.05;      ///< what the calibration leaves
  double most_off_px = 4.0;         ///< of a picture of 1000 pixels of focal length: a right target lies no farther off
                                    ///< the pose of four others
  std::uint64_t seed = 1;           ///< of the subsets that are drawn where there are too many to try all
};

/// A target after the adjustment: what is left in the picture (seen less computed).
struct LandmarkResidual {
  std::string id;
  bool used = true;
  Eigen::Vector2d residual_px = Eigen::Vector2d::Constant(NAN);  ///< NaN where its place lies behind the camera
  double normalised = 0.0;                                       ///< over its sigma, the worse axis, of those used
  double across_m = 0.0;  ///< of those not used: how far beside its surveyed place the line of sight passes
};

/// The pose by POSIT alone, of the targets that were used.
struct PositSummary {
  Pose site_from_camera = Pose::Identity();
  double rms_px = 0.0;
  int iterations = 0;
};

struct CameraPose {
  Pose site_from_camera = Pose::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< position in the site [m], then small turns about the site's axes [rad]
  Vector6d by_focal_length = Vector6d::Zero();  ///< what one sigma of the focal length moves; the covariance holds it
  double rms_px = 0.0;                          ///< of those used
  double sigma_factor = 1.0;  ///< of the residuals over what their sigmas say; sigmas are not made smaller by it
  bool flat = false;          ///< the targets lie in one plane
  PositSummary posit;
  std::vector<LandmarkResidual> landmarks;
  Findings findings;

  std::size_t used() const;
};

/// Consensus: poses of subsets of four (all of them, or 400 drawn ones) by POSIT; the one that most targets fit, then a
/// least squares adjustment of the pixels, weighed by the sigmas of target, landmark and lens. What lies off by more
/// than four of its sigmas is left out, one at a time, and is a decision. The covariance holds the lens's focal_sigma.
/// Throws Error for fewer than four targets, targets on one line, where no pose fits to four of them, or too many are
/// left out (more than one of five, three of eight, three of ten of more): some pose fits four of many wrong targets by
/// chance; and where they would be nearer than 0.1 m or farther than 300 m: the table is in other units.
CameraPose locate_camera(const CameraLens& lens, const std::vector<LandmarkSight>& sights,
                         const CameraPoseOptions& options);

}  // namespace adit
