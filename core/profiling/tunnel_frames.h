#pragma once
// The fast way from a point to (s, x, z): frames on the axis, close enough for one step to the foot.

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "core/design/alignment.h"
#include "core/geometry/pose.h"

namespace adit {

/// Two half-spaces that hold every point of a short stretch, in the frame of a scan: most points of most tiles need no
/// more than that to be sorted out.
struct StretchPlanes {
  Eigen::Vector3d begin_normal = Eigen::Vector3d::Zero();
  double begin_offset = 0.0;
  Eigen::Vector3d end_normal = Eigen::Vector3d::Zero();
  double end_offset = 0.0;

  bool is_outside(const Eigen::Vector3d& in_scan) const {
    return begin_normal.dot(in_scan) + begin_offset < 0.0 || end_normal.dot(in_scan) + end_offset > 0.0;
  }
};

/// Frames every 0.25 m of a stretch of an axis. Within a frame the axis counts as an arc and the grade line as a
/// parabola, whose feet are closed forms. Where that is not good to 0.01 mm within 8 m of the axis (a joint, a sharp
/// transition) the exact Alignment::to_tunnel answers instead. The alignment must outlive the frames.
class TunnelFrames {
 public:
  TunnelFrames(const Alignment& axis, double from_m, double to_m);

  /// As Alignment::to_tunnel, for points whose chainage is in [from, to); empty for all others. near_m: a chainage
  /// within some 20 m of the foot.
  std::optional<TunnelPoint> to_tunnel(const Eigen::Vector3d& point, double near_m) const;

  /// Of points for which these say "outside" to_tunnel() gives nothing. All is inside where the stretch is long, turns
  /// much or has a joint.
  StretchPlanes planes_from(const Pose& local_from_scan) const;

 private:
  struct Frame {
    double chainage_m = 0.0;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d tangent = Eigen::Vector2d::UnitY();
    double curvature_per_m = 0.0;
    double elevation_m = 0.0;
    double grade = 0.0;
    double half_bend_per_m = 0.0;  ///< of the grade line
    bool exact_needed = false;
  };
  /// Chainage and offset of a point by one frame; empty where the arc is too tight for it.
  static std::optional<PlanFoot> foot_by(const Frame& frame, const Eigen::Vector3d& point);
  Frame frame_at(double chainage_m) const;
  bool is_good(const Frame& frame) const;
  /// Nearest frame; the first or the last beyond the ends.
  const Frame& nearest(double chainage_m) const;
  std::optional<TunnelPoint> exact(const Eigen::Vector3d& point, double near_m) const;
  bool holds(double chainage_m) const { return chainage_m >= from_m_ && chainage_m < to_m_; }

  const Alignment* axis_;
  double from_m_;
  double to_m_;
  double first_m_ = 0.0;
  std::vector<Frame> frames_;
  bool planes_hold_ = false;  ///< no plane across the axis within the stretch cuts another within the tunnel
  Frame begin_;
  Frame end_;
};

}  // namespace adit
