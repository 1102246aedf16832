#pragma once
// The whole-metre origin that keeps site coordinates of millions of metres exact.

#include <Eigen/Core>

namespace adit {

/// east, north, elevation in whole metres; everything inside the program is site minus this.
struct ProjectOrigin {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  Eigen::Vector3d to_local(const Eigen::Vector3d& site) const { return site - position; }
  Eigen::Vector3d to_site(const Eigen::Vector3d& local) const { return local + position; }
};

/// The origin nearest to a point: each coordinate rounded to whole metres.
inline ProjectOrigin origin_near(const Eigen::Vector3d& site) {
  return {site.array().round().matrix()};
}

}  // namespace adit
