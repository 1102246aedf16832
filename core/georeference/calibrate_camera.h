#pragma once
// A camera's lens from pictures of a board of known targets.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "core/foundation/finding.h"
#include "core/georeference/camera_lens.h"

namespace adit {

/// A target of the board in a picture: where it is on the board [m] and in the picture.
struct BoardSight {
  Eigen::Vector3d board = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  int id = 0;
  double sigma_px = 0.0;  ///< of each coordinate; 0: not known
};

struct BoardPicture {
  std::string name;
  std::vector<BoardSight> sights;
};

struct CameraCalibration {
  CameraLens lens;
  double rms_px = 0.0;
  double sigma_fx = 0.0, sigma_fy = 0.0, sigma_cx = 0.0, sigma_cy = 0.0;  ///< pixels
  struct Picture {
    std::string name;
    double rms_px = 0.0;
    std::size_t targets = 0;
    double tilt_rad = 0.0;  ///< of the board against the picture's plane
  };
  std::vector<Picture> pictures;
  Findings findings;
};

/// Focal lengths, principal point, k1, k2, p1, p2, k3 by OpenCV's bundle adjustment (Zhang 2000). Pictures with fewer
/// than six targets are left out and named. Throws Error for fewer than four good pictures, where no camera fits to 2
/// pixels, and where the board was held square to the camera in all of them: then focal length and distance are one;
/// and what check_board refuses. Targets that are not where the table says are named.
CameraCalibration calibrate_camera(const std::vector<BoardPicture>& pictures, int width, int height);

}  // namespace adit
