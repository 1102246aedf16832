#include "core/profiling/tunnel_frames.h"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double step_m = 0.25;
constexpr double margin_m = 1.0;  // a guess from afar may be that wrong
constexpr double tested_offset_m = 8.0;
constexpr double good_m = 1e-5;
constexpr double most_turn_rad = 0.5;  // of a short stretch
constexpr double least_squeeze = 0.2;  // nearer to the centre of the curve the foot is exact or nothing

}  // namespace

TunnelFrames::TunnelFrames(const Alignment& axis, double from_m, double to_m)
    : axis_(&axis), from_m_(from_m), to_m_(to_m) {
  first_m_ = std::max(axis.from_m(), from_m - margin_m);
  const double last_m = std::min(axis.to_m(), to_m + margin_m);
  const auto count = static_cast<std::size_t>(std::max(0.0, std::ceil((last_m - first_m_) / step_m))) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    frames_.push_back(frame_at(std::min(first_m_ + step_m * static_cast<double>(i), axis.to_m())));
    frames_.back().exact_needed = !is_good(frames_.back());
  }
  double sharpest = 0.0;
  for (const Frame& frame : frames_) sharpest = std::max(sharpest, std::abs(frame.curvature_per_m));
  // A frame that is not good may hide a kink, beside which points lie behind the plane that their chainage is ahead of.
  const bool smooth = std::none_of(frames_.begin(), frames_.end(), [](const Frame& f) { return f.exact_needed; });
  planes_hold_ = smooth && (to_m - from_m) * sharpest < most_turn_rad;
  begin_ = frame_at(std::clamp(from_m, axis.from_m(), axis.to_m()));
  end_ = frame_at(std::clamp(to_m, axis.from_m(), axis.to_m()));
}

TunnelFrames::Frame TunnelFrames::frame_at(double chainage_m) const {
  const PlanPoint plan = axis_->horizontal().at(chainage_m);
  Frame frame;
  frame.chainage_m = chainage_m;
  frame.position = plan.position;
  frame.tangent = plan.tangent();
  frame.curvature_per_m = plan.curvature_per_m;
  const auto grade = axis_->vertical().at(chainage_m);
  frame.elevation_m = grade.elevation_m;
  frame.grade = grade.grade;
  const double before = std::max(chainage_m - 0.5 * step_m, axis_->from_m());
  const double behind = std::min(chainage_m + 0.5 * step_m, axis_->to_m());
  if (behind > before)
    frame.half_bend_per_m =
        0.5 * (axis_->vertical().at(behind).grade - axis_->vertical().at(before).grade) / (behind - before);
  return frame;
}

std::optional<PlanFoot> TunnelFrames::foot_by(const Frame& frame, const Eigen::Vector3d& point) {
  const Eigen::Vector2d away = point.head<2>() - frame.position;
  const double ahead = away.dot(frame.tangent);
  const double right = away.x() * frame.tangent.y() - away.y() * frame.tangent.x();
  const double squeeze = 1.0 - frame.curvature_per_m * right;
  if (squeeze < least_squeeze) return std::nullopt;
  // The foot on the arc: t = atan(v) / k, x = (1 - sqrt(squeeze^2 + (k ahead)^2)) / k, without a division by k.
  const double v = frame.curvature_per_m * ahead / squeeze;
  const double v2 = v * v;
  if (v2 > 0.04) return std::nullopt;
  const double t = ahead / squeeze * (1.0 - v2 * (1.0 / 3.0 - v2 * (1.0 / 5.0 - v2 / 7.0)));
  const double x = right - frame.curvature_per_m * ahead * ahead / (squeeze * (1.0 + std::sqrt(1.0 + v2)));
  return PlanFoot{frame.chainage_m + t, x};
}

bool TunnelFrames::is_good(const Frame& frame) const {
  for (const double t : {-0.5 * step_m, 0.0, 0.5 * step_m}) {
    const double s = frame.chainage_m + t;
    if (s < axis_->from_m() || s > axis_->to_m()) continue;
    for (const double x : {-tested_offset_m, 0.0, tested_offset_m}) {
      const Eigen::Vector3d point = axis_->to_site({s, x, 0.0});
      const auto foot = foot_by(frame, point);
      if (!foot) return false;
      const double from_frame = foot->chainage_m - frame.chainage_m;
      const double z =
          point.z() - (frame.elevation_m + from_frame * (frame.grade + from_frame * frame.half_bend_per_m));
      if (std::max({std::abs(foot->chainage_m - s), std::abs(foot->offset_m - x), std::abs(z)}) > good_m) return false;
    }
  }
  return true;
}

const TunnelFrames::Frame& TunnelFrames::nearest(double chainage_m) const {
  const double place = std::clamp((chainage_m - first_m_) / step_m + 0.5, 0.0, static_cast<double>(frames_.size() - 1));
  return frames_[static_cast<std::size_t>(place)];
}

std::optional<TunnelPoint> TunnelFrames::exact(const Eigen::Vector3d& point, double near_m) const {
  const auto at = axis_->to_tunnel(point, near_m);
  if (!at || !holds(at->s_m)) return std::nullopt;
  return at;
}

StretchPlanes TunnelFrames::planes_from(const Pose& local_from_scan) const {
  constexpr double doubt_m = 0.05;  // the foot decides there
  if (!planes_hold_) return {};
  const auto normal = [&](const Frame& frame) {
    return Eigen::Vector3d(local_from_scan.linear().transpose() *
                           Eigen::Vector3d(frame.tangent.x(), frame.tangent.y(), 0.0));
  };
  const auto ahead = [&](const Frame& frame) {
    return (local_from_scan.translation().head<2>() - frame.position).dot(frame.tangent);
  };
  return {normal(begin_), ahead(begin_) + doubt_m, normal(end_), ahead(end_) - doubt_m};
}

std::optional<TunnelPoint> TunnelFrames::to_tunnel(const Eigen::Vector3d& point, double near_m) const {
  const Frame* frame = &nearest(near_m);
  for (int turn = 0; turn < 3; ++turn) {
    const auto foot = foot_by(*frame, point);
    if (!foot) return exact(point, near_m);
    const Frame* better = &nearest(foot->chainage_m);
    if (better != frame) {
      frame = better;
      continue;
    }
    const double t = foot->chainage_m - frame->chainage_m;
    const bool beside = std::abs(t) > 0.6 * step_m;  // beyond the first or the last frame
    // From afar the foot is a guess, a third of the way wrong at the worst.
    const double doubt_m = 0.5 * margin_m + 0.3 * std::abs(t);
    if (beside && (foot->chainage_m < from_m_ - doubt_m || foot->chainage_m > to_m_ + doubt_m)) return std::nullopt;
    if (beside || frame->exact_needed) return exact(point, foot->chainage_m);
    if (!holds(foot->chainage_m)) return std::nullopt;
    return TunnelPoint{foot->chainage_m, foot->offset_m,
                       point.z() - (frame->elevation_m + t * (frame->grade + t * frame->half_bend_per_m))};
  }
  return exact(point, near_m);
}

}  // namespace adit
