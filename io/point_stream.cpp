#include "io/point_stream.h"

#include <utility>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit::io {

PointStream::PointStream(ScanHeader header, const ReadOptions& options, NanMeans nan_means, ScanSink& sink)
    : header_(std::move(header)), options_(options), nan_means_(nan_means), sink_(sink) {
  constexpr double beyond_any_site_m = 1e8;  // as for poses in job.json
  if (header_.file_pose && !(header_.file_pose->translation().cwiseAbs().maxCoeff() <= beyond_any_site_m))
    throw Error("the file's pose puts the scanner beyond 100,000 km", header_.where, "export the scan again in metres");
  wanted_ = sink.begin(header_);
}

bool PointStream::is_left_out(const Eigen::Vector3d& position) {
  const auto nan = position.array().isNaN();
  const bool no_return =
      (nan_means_ == NanMeans::no_return && nan.any()) || (nan_means_ == NanMeans::no_return_if_all && nan.all());
  if (no_return) ++no_returns_;
  return no_return || options_.drop_invalid;
}

void PointStream::refuse(const Eigen::Vector3d& position, const std::string& where) {
  const auto word = [&](int axis) {
    return std::isfinite(position[axis]) ? short_number(position[axis])
           : std::isnan(position[axis])  ? std::string("nan")
                                         : std::string("infinite");
  };
  throw Error("a point is not finite (" + word(0) + ", " + word(1) + ", " + word(2) + ")", where,
              "export without such points, or drop them with adit convert --drop-invalid");
}

void PointStream::hand_out() {
  if (block_.empty()) return;
  has_points_ = true;
  sink_.take(block_);
  block_.clear();
}

void PointStream::end() {
  if (!wanted_) return;
  hand_out();
  if (!has_points_) {
    const std::string only =
        no_returns_ > 0 ? ", only " + std::to_string(no_returns_) + " places without a return" : "";
    throw Error("the scan holds no points" + only, header_.where, "export the scan again with its points");
  }
  sink_.end(no_returns_);
}

}  // namespace adit::io
