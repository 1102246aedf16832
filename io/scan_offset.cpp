#include "io/scan_offset.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit::io {
namespace {

constexpr double largest_without_offset_m = 10000.0;
constexpr double largest_loss_without_offset_m = 5e-5;
constexpr double farthest_from_offset_m = 50000.0;  // float32 rounds by 2 mm there
constexpr double farthest_from_zero_m = 1e10;       // double rounds by a micrometre there

double float32_loss_m(double value) {
  // Below 1024 m float32 is good to 0.03 mm, whatever the digits.
  if (std::abs(value) < 1024.0) return 0.0;
  return std::abs(value - static_cast<double>(static_cast<float>(value)));
}

}  // namespace

Eigen::Vector3d offset_for(std::span<const Eigen::Vector3d> first_points, const std::string& where) {
  BoundingBox box;
  double loss_m = 0.0;
  for (const Eigen::Vector3d& p : first_points) {
    box.extend(p);
    for (int axis = 0; axis < 3; ++axis) loss_m = std::max(loss_m, float32_loss_m(p[axis]));
  }
  if (box.isEmpty()) return Eigen::Vector3d::Zero();
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (largest > farthest_from_zero_m)
    throw Error("a coordinate of " + short_number(largest) + " m is no site coordinate", where,
                "check units and columns");
  if (largest <= largest_without_offset_m && loss_m <= largest_loss_without_offset_m) return Eigen::Vector3d::Zero();
  return box.center().array().round();
}

void expect_near_offset(const BoundingBox& box, const Eigen::Vector3d& offset, const std::string& where) {
  const double farthest = std::max((box.max() - offset).maxCoeff(), (offset - box.min()).maxCoeff());
  if (farthest > farthest_from_offset_m)
    throw Error("the points lie " + short_number(std::round(box.sizes().maxCoeff() / 1000.0)) + " km apart", where,
                "check units and columns, remove stray points, or split the scan");
}

}  // namespace adit::io
