#pragma once
// Exact nearest neighbours among fixed points (k-d tree).

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace adit {

struct Neighbour {
  std::size_t index = 0;
  float squared_distance_m2 = 0.0F;
};

/// Built once over the points; queries may run on several threads at once.
class NearestNeighbours {
 public:
  /// Throws Error for an empty list.
  explicit NearestNeighbours(const std::vector<Eigen::Vector3f>& points);
  ~NearestNeighbours();
  NearestNeighbours(NearestNeighbours&&) noexcept;
  NearestNeighbours& operator=(NearestNeighbours&&) noexcept;

  /// The nearest if it lies within reach [m]. Far from all points this is hundreds of times faster than k_nearest().
  std::optional<Neighbour> nearest_within(const Eigen::Vector3f& point, double reach_m) const;
  /// The k nearest, nearest first (fewer when there are fewer points).
  std::vector<Neighbour> k_nearest(const Eigen::Vector3f& point, int k) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace adit
