#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include "core/foundation/error.h"
#include "core/geometry/nearest_neighbours.h"

namespace adit {

struct NearestNeighbours::Tree {
  pcl::KdTreeFLANN<pcl::PointXYZ> flann;
};

NearestNeighbours::NearestNeighbours(const std::vector<Eigen::Vector3f>& points) : tree_(std::make_unique<Tree>()) {
  if (points.empty()) throw Error("nearest neighbours were asked of no points");
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const auto& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  tree_->flann.setInputCloud(cloud);
}

NearestNeighbours::~NearestNeighbours() = default;
NearestNeighbours::NearestNeighbours(NearestNeighbours&&) noexcept = default;
NearestNeighbours& NearestNeighbours::operator=(NearestNeighbours&&) noexcept = default;

std::optional<Neighbour> NearestNeighbours::nearest_within(const Eigen::Vector3f& point, double reach_m) const {
  thread_local std::vector<int> indices;
  thread_local std::vector<float> distances;
  // With room for one only, FLANN keeps the nearest and prunes by the reach from the start.
  if (tree_->flann.radiusSearch(pcl::PointXYZ(point.x(), point.y(), point.z()), reach_m, indices, distances, 1) == 0)
    return std::nullopt;
  return Neighbour{static_cast<std::size_t>(indices.front()), distances.front()};
}

std::vector<Neighbour> NearestNeighbours::k_nearest(const Eigen::Vector3f& point, int k) const {
  thread_local std::vector<int> indices;
  thread_local std::vector<float> distances;
  const int found = tree_->flann.nearestKSearch(pcl::PointXYZ(point.x(), point.y(), point.z()), k, indices, distances);
  std::vector<Neighbour> result;
  result.reserve(static_cast<std::size_t>(found));
  for (int i = 0; i < found; ++i)
    result.push_back(
        {static_cast<std::size_t>(indices[static_cast<std::size_t>(i)]), distances[static_cast<std::size_t>(i)]});
  return result;
}

}  // namespace adit
