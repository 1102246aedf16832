#include "core/registration/probability_image.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"

namespace adit {
namespace {

/// A distribution seen from above: integrated over z.
struct Shadow {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  Eigen::AlignedBox2d box() const {
    constexpr double sigmas = 4.0;
    const Eigen::Vector2d reach = sigmas * covariance.diagonal().cwiseSqrt();
    return {mean - reach, mean + reach};
  }
};

std::vector<Shadow> shadows_of(const DistributionMap& cells, const Pose& frame_from_scan, double least_sigma_m) {
  std::vector<Shadow> shadows;
  for (const NormalDistribution& cell : cells.distributions()) {
    const Eigen::Matrix3d covariance =
        frame_from_scan.linear() * cell.covariance * frame_from_scan.linear().transpose();
    shadows.push_back({(frame_from_scan * cell.mean).head<2>(), covariance.topLeftCorner<2, 2>()});
    // A wall thinner than a pixel would fall between two.
    shadows.back().covariance.diagonal().array() += least_sigma_m * least_sigma_m;
  }
  return shadows;
}

void add(ProbabilityImage& image, const Shadow& shadow, double share) {
  const Eigen::Matrix2d inverse = shadow.covariance.inverse();
  const double peak = share / (2.0 * pi * std::sqrt(shadow.covariance.determinant()));
  const Eigen::AlignedBox2d box = shadow.box();
  const Eigen::Vector2d low = (box.min() - image.corner) / image.pixel_m;
  const Eigen::Vector2d high = (box.max() - image.corner) / image.pixel_m;
  const int last_row = std::min(image.height - 1, static_cast<int>(high.y()));
  const int last_column = std::min(image.width - 1, static_cast<int>(high.x()));
  for (int row = std::max(0, static_cast<int>(low.y())); row <= last_row; ++row)
    for (int column = std::max(0, static_cast<int>(low.x())); column <= last_column; ++column) {
      const Eigen::Vector2d off = image.corner + image.pixel_m * Eigen::Vector2d(column + 0.5, row + 0.5) - shadow.mean;
      image.density_per_m2[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(column)] +=
          static_cast<float>(peak * std::exp(-0.5 * off.dot(inverse * off)));
    }
}

}  // namespace

ProbabilityImage probability_from_above(const DistributionMap& cells, const Pose& frame_from_scan, double pixel_m,
                                        std::size_t most_pixels) {
  if (cells.distributions().empty()) throw Error("no cell holds enough points for a distribution", "", "");
  ProbabilityImage image;
  const std::vector<Shadow> shadows = shadows_of(cells, frame_from_scan, 0.5 * pixel_m);
  Eigen::AlignedBox2d box;
  for (const Shadow& shadow : shadows) box.extend(shadow.box());
  image.corner = box.min();
  image.pixel_m = std::max(pixel_m, std::sqrt(box.sizes().prod() / static_cast<double>(most_pixels)));
  image.width = static_cast<int>(box.sizes().x() / image.pixel_m) + 1;
  image.height = static_cast<int>(box.sizes().y() / image.pixel_m) + 1;
  image.density_per_m2.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 0.0F);
  for (const Shadow& shadow : shadows) add(image, shadow, 1.0 / static_cast<double>(shadows.size()));
  return image;
}

}  // namespace adit
