#include "core/geometry/point_cloud.h"

#include <algorithm>

#include "core/geometry/statistics.h"

namespace adit {
namespace {

template <typename Value>
std::vector<Value> selected_values(const std::vector<Value>& values, const std::vector<std::size_t>& indices) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(indices.size());
  for (const std::size_t i : indices) result.push_back(values[i]);
  return result;
}

template <typename Value>
void append_values(std::vector<Value>& values, const std::vector<Value>& more, bool first) {
  if (first || (!values.empty() && !more.empty()))
    values.insert(values.end(), more.begin(), more.end());
  else
    values.clear();
}

}  // namespace

PointCloud selected(const PointCloud& cloud, const std::vector<std::size_t>& indices) {
  PointCloud result;
  result.points = selected_values(cloud.points, indices);
  result.intensity = selected_values(cloud.intensity, indices);
  result.colour = selected_values(cloud.colour, indices);
  result.normals = selected_values(cloud.normals, indices);
  return result;
}

void append(PointCloud& cloud, const PointCloud& more) {
  if (more.empty()) return;
  const bool first = cloud.empty();
  append_values(cloud.intensity, more.intensity, first);
  append_values(cloud.colour, more.colour, first);
  append_values(cloud.normals, more.normals, first);
  cloud.points.insert(cloud.points.end(), more.points.begin(), more.points.end());
}

Eigen::Vector3d middle_extent(const PointCloud& cloud) {
  constexpr std::size_t enough = 100000;
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();
  if (cloud.empty()) return extent;
  const std::size_t every = std::max<std::size_t>(1, cloud.size() / enough);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < cloud.size(); i += every) values.push_back(static_cast<double>(cloud.points[i][axis]));
    extent[axis] = quantile(values, 0.95) - quantile(values, 0.05);
  }
  return extent;
}

}  // namespace adit
