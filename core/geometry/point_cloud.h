#pragma once
// Points of one scan in one frame.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace adit {

/// float32 points [m] in one frame. intensity (any scale, 0 when unknown), colour and normal are empty or as long as
/// points. A value, cheap to move.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> intensity;
  std::vector<std::array<std::uint8_t, 3>> colour;
  std::vector<Eigen::Vector3f> normals;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  bool has_intensity() const { return !intensity.empty(); }
  bool has_colour() const { return !colour.empty(); }
  bool has_normals() const { return !normals.empty(); }
};

/// The points (with their attributes) named by indices, in that order.
PointCloud selected(const PointCloud& cloud, const std::vector<std::size_t>& indices);

/// Adds the points of `more` behind those of `cloud`. An attribute that only one of the two has is dropped.
void append(PointCloud& cloud, const PointCloud& more);

/// How far the middle nine tenths of the points reach along x, y and z [m]; zero for an empty cloud. Deaf to stray
/// points.
Eigen::Vector3d middle_extent(const PointCloud& cloud);

}  // namespace adit
