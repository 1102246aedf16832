#pragma once
// What a scanner saw through must be empty in every other scan.

#include <Eigen/Core>

#include <vector>

namespace adit {

/// Where a place stands to what a scanner saw.
enum class Sight {
  unknown,       ///< nothing was measured in that direction
  seen_through,  ///< well before the surface: the pulses went on
  on_surface,
  hidden  ///< behind it
};

/// The ranges a scanner at the frame's origin measured, by direction: least and greatest of each pixel of 2 degrees.
class RangeImage {
 public:
  RangeImage() = default;  ///< of nothing: all is unknown
  explicit RangeImage(const std::vector<Eigen::Vector3f>& points);

  bool is_empty() const { return pixels_.empty(); }

  /// Against the ranges of the pixel and the eight around it, each widened by the margin.
  Sight sight_of(const Eigen::Vector3d& place, double margin_m) const;

 private:
  struct Pixel {
    float least_m = 0.0F;
    float most_m = -1.0F;  ///< less than least_m: nothing measured
  };
  std::vector<Pixel> pixels_;  ///< row-major, azimuth fastest; already with those around each
};

}  // namespace adit
