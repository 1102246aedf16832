#include "io/cloud_builder.h"

#include <algorithm>
#include <utility>

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

std::vector<std::string> attribute_names(const Attributes& attributes) {
  std::vector<std::string> names;
  if (attributes.intensity) names.emplace_back("intensity");
  if (attributes.colour) names.emplace_back("colour");
  if (attributes.normals) names.emplace_back("normals");
  return names;
}

CloudBuilder::CloudBuilder(Attributes attributes, const ReadOptions& options, NanMeans nan_means)
    : attributes_(attributes), options_(options), nan_means_(nan_means) {}

void CloudBuilder::expect(std::uint64_t count) {
  const auto n = static_cast<std::size_t>(count);
  if (attributes_.intensity) cloud_.intensity.reserve(n);
  if (attributes_.colour) cloud_.colour.reserve(n);
  if (attributes_.normals) cloud_.normals.reserve(n);
}

bool CloudBuilder::is_left_out(const Eigen::Vector3d& position) {
  const auto nan = position.array().isNaN();
  const bool no_return =
      (nan_means_ == NanMeans::no_return && nan.any()) || (nan_means_ == NanMeans::no_return_if_all && nan.all());
  if (no_return) ++no_returns_;
  return no_return || options_.drop_invalid;
}

void CloudBuilder::refuse(const Eigen::Vector3d& position, const std::string& where) {
  const auto word = [&](int axis) {
    return std::isfinite(position[axis]) ? short_number(position[axis])
           : std::isnan(position[axis])  ? std::string("nan")
                                         : std::string("infinite");
  };
  throw Error("a point is not finite (" + word(0) + ", " + word(1) + ", " + word(2) + ")", where,
              "export without such points, or drop them with adit convert --drop-invalid");
}

void CloudBuilder::close_chunk() {
  for (const Eigen::Vector3d& p : chunk_) {
    box_.extend(p);
    for (int axis = 0; axis < 3; ++axis) largest_loss_m_ = std::max(largest_loss_m_, float32_loss_m(p[axis]));
  }
  count_ += chunk_.size();
  chunks_.push_back(std::move(chunk_));
  chunk_ = {};
  chunk_.reserve(chunk_points);
}

Eigen::Vector3d CloudBuilder::chosen_offset(const std::string& where) const {
  const double largest = std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff());
  if (largest > farthest_from_zero_m)
    throw Error("a coordinate of " + short_number(largest) + " m is no site coordinate", where,
                "check units and columns");
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  if (largest > largest_without_offset_m || largest_loss_m_ > largest_loss_without_offset_m)
    offset = box_.center().array().round();
  const double farthest = std::max((box_.max() - offset).maxCoeff(), (offset - box_.min()).maxCoeff());
  if (farthest > farthest_from_offset_m)
    throw Error("the points lie " + short_number(std::round(box_.sizes().maxCoeff() / 1000.0)) + " km apart", where,
                "check units and columns, remove stray points, or split the scan");
  return offset;
}

ScanData CloudBuilder::finished(const std::string& name, const std::string& where, const Progress& progress) {
  close_chunk();
  if (count_ == 0) {
    const std::string only =
        no_returns_ > 0 ? ", only " + std::to_string(no_returns_) + " places without a return" : "";
    throw Error("the scan holds no points" + only, where, "export the scan again with its points");
  }
  ScanData scan;
  scan.name = name;
  scan.offset = chosen_offset(where);
  scan.no_returns = no_returns_;
  scan.cloud = std::move(cloud_);
  scan.cloud.points.reserve(count_);
  for (std::vector<Eigen::Vector3d>& chunk : chunks_) {
    progress.check();
    for (const Eigen::Vector3d& p : chunk) scan.cloud.points.emplace_back((p - scan.offset).cast<float>());
    std::vector<Eigen::Vector3d>().swap(chunk);
  }
  *this = CloudBuilder(attributes_, options_, nan_means_);
  return scan;
}

}  // namespace adit::io
