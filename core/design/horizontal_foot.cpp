// The foot of a point on the plan axis: candidates from a hierarchy of discs, then Newton's iteration from knot to
// knot.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/design/horizontal_alignment.h"

namespace adit {
namespace {

constexpr double end_tolerance_m = 1e-3;
constexpr double window_m = 30.0;
constexpr double longest_step_m = 10.0;
constexpr double last_step_m = 1e-5;  // quadratic convergence: what is left after such a step is below 1e-11 m
constexpr double least_slope = 1e-9;
constexpr int most_steps = 40;
constexpr std::size_t group = 32;

Eigen::Vector2d nearest_on_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& point) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  if (length2 == 0.0) return a;
  return a + std::clamp((point - a).dot(ab) / length2, 0.0, 1.0) * ab;
}

}  // namespace

struct HorizontalAlignment::Settled {
  enum class How { found, beyond_end, failed };
  How how = How::failed;
  PlanFoot foot;
  double distance_m = std::numeric_limits<double>::infinity();
};

void HorizontalAlignment::lay_discs() {
  for (std::size_t first = 0; first < knots_.size(); first += group) {
    Disc disc{knots_[first].position, 0.0, first, std::min(first + group, knots_.size())};
    disc.centre = knots_[(disc.first + disc.last) / 2].position;
    for (std::size_t i = disc.first; i < disc.last; ++i) {
      disc.radius_m = std::max(disc.radius_m, (knots_[i].position - disc.centre).norm() + knots_[i].length_m);
    }
    leaves_.push_back(disc);
  }
  for (std::size_t first = 0; first < leaves_.size(); first += group) {
    Disc disc{leaves_[first].centre, 0.0, first, std::min(first + group, leaves_.size())};
    disc.centre = leaves_[(disc.first + disc.last) / 2].centre;
    for (std::size_t i = disc.first; i < disc.last; ++i) {
      disc.radius_m = std::max(disc.radius_m, (leaves_[i].centre - disc.centre).norm() + leaves_[i].radius_m);
    }
    branches_.push_back(disc);
  }
}

std::size_t HorizontalAlignment::nearest_leaf(const Eigen::Vector2d& point) const {
  const auto nearest = [&point](const std::vector<Disc>& discs, std::size_t first, std::size_t last) {
    std::size_t best = first;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < last; ++i) {
      const double distance = (point - discs[i].centre).squaredNorm();
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  };
  const Disc& branch = branches_[nearest(branches_, 0, branches_.size())];
  return nearest(leaves_, branch.first, branch.last);
}

std::vector<std::size_t> HorizontalAlignment::nearest_knots(const Eigen::Vector2d& point, double beyond_m) const {
  const auto distance = [&](std::size_t i) { return (point - knots_[i].position).norm(); };
  const Disc& start = leaves_[nearest_leaf(point)];
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = start.first; i < start.last; ++i) best = std::min(best, distance(i));
  // The foot lies at most one stretch from a knot, so a knot that leads to it is at most that much farther.
  const double margin_m = 1.1 + beyond_m;
  const auto within = [&](const Disc& disc) { return (point - disc.centre).norm() - disc.radius_m <= best + margin_m; };
  std::vector<std::size_t> candidates;
  for (const Disc& branch : branches_) {
    if (!within(branch)) continue;
    for (std::size_t l = branch.first; l < branch.last; ++l) {
      if (!within(leaves_[l])) continue;
      for (std::size_t i = leaves_[l].first; i < leaves_[l].last; ++i) {
        const double here = distance(i);
        if (here > best + margin_m) continue;
        best = std::min(best, here);
        const bool falls = i == 0 || distance(i - 1) > here;
        const bool rises = i + 1 == knots_.size() || distance(i + 1) >= here;
        if (falls && rises) candidates.push_back(i);
      }
    }
  }
  std::erase_if(candidates, [&](std::size_t i) { return distance(i) > best + margin_m; });
  return candidates;
}

HorizontalAlignment::Settled HorizontalAlignment::settle_at_end(const Eigen::Vector2d& point, bool at_start) const {
  const PlanKnot& knot = at_start ? knots_.front() : knots_.back();
  const double t = at_start ? 0.0 : knot.length_m;
  const PlanKnot::View view = knot.view(point, t);
  const double beyond = at_start ? -view.ahead_m : view.ahead_m;
  const double chainage = at_start ? start_chainage_m_ : end_chainage_m_;
  Settled end{Settled::How::failed, {chainage, view.offset_m}, std::hypot(view.ahead_m, view.offset_m)};
  if (beyond >= 0.0) end.how = beyond <= end_tolerance_m ? Settled::How::found : Settled::How::beyond_end;
  return end;  // failed: the foot lies inside, the iteration goes on from the end
}

std::optional<PlanFoot> HorizontalAlignment::joint_foot(const Eigen::Vector2d& point, std::size_t later_element) const {
  const std::size_t later = first_knot_of_element_[later_element];
  const PlanKnot& before = knots_[later - 1];
  const PlanKnot& behind = knots_[later];
  const PlanKnot::View old_view = before.view(point, before.length_m);
  const PlanKnot::View new_view = behind.view(point, 0.0);
  if (old_view.ahead_m < 0.0 || new_view.ahead_m > 0.0) return std::nullopt;
  // The gap counts as a short line, so that neither a gap along the axis nor a kink disturbs the offset.
  const PlanKnot::Local end = before.local(before.length_m);
  const Eigen::Vector2d end_point = before.position + end.along_m * before.tangent + end.right_m * before.right();
  const double distance = (point - nearest_on_segment(end_point, behind.position, point)).norm();
  return PlanFoot{behind.chainage_m, std::copysign(distance, new_view.offset_m)};
}

HorizontalAlignment::Settled HorizontalAlignment::settle(const Eigen::Vector2d& point, double chainage_m) const {
  std::size_t i = knot_at(chainage_m);
  double t = chainage_m - knots_[i].chainage_m;
  for (int n = 0; n < most_steps; ++n) {
    const PlanKnot::View view = knots_[i].view(point, t);
    if (view.slope < least_slope) return {};
    const double step = std::clamp(view.ahead_m / view.slope, -longest_step_m, longest_step_m);
    t += step;
    const double s = knots_[i].chainage_m + t;
    if (s < start_chainage_m_ || s > end_chainage_m_) {
      const bool at_start = s < start_chainage_m_;
      const Settled end = settle_at_end(point, at_start);
      if (end.how != Settled::How::failed) return end;
      i = at_start ? 0 : knots_.size() - 1;
      t = at_start ? 0.0 : knots_[i].length_m;
      continue;
    }
    const bool inside = t >= 0.0 && t <= knots_[i].length_m;
    const std::size_t next = inside ? i : knot_at(s);
    const bool same_element = knots_[next].element == knots_[i].element;
    if (same_element && std::abs(step) < last_step_m) {
      return {Settled::How::found, {s, view.offset_m}, std::abs(view.offset_m)};
    }
    const std::size_t later = std::max(knots_[next].element, knots_[i].element);
    if (later - std::min(knots_[next].element, knots_[i].element) == 1) {
      if (const auto foot = joint_foot(point, later)) return {Settled::How::found, *foot, std::abs(foot->offset_m)};
    }
    i = next;
    t = s - knots_[i].chainage_m;
  }
  return {};
}

HorizontalAlignment::Settled HorizontalAlignment::settle_in(const Eigen::Vector2d& point, std::size_t knot) const {
  const Settled quick = settle(point, knots_[knot].chainage_m);
  const auto near = [&](double s) { return std::abs(s - knots_[knot].chainage_m) <= 2.5 * longest_step_m; };
  if (quick.how != Settled::How::failed && near(quick.foot.chainage_m)) return quick;
  // Near the centre of curvature Newton's steps run wild: halve between the neighbours instead.
  double low = knots_[knot == 0 ? 0 : knot - 1].chainage_m;
  double high = knots_[knot].chainage_m + knots_[knot].length_m;
  const auto view = [&](double s) {
    const PlanKnot& k = knots_[knot_at(s)];
    return k.view(point, s - k.chainage_m);
  };
  if (view(low).ahead_m < 0.0 || view(high).ahead_m > 0.0) return quick;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (view(middle).ahead_m > 0.0 ? low : high) = middle;
  }
  const PlanKnot::View found = view(low);
  if (found.slope < least_slope) return {};
  return {Settled::How::found, {low, found.offset_m}, std::abs(found.offset_m)};
}

std::optional<PlanFoot> HorizontalAlignment::foot_near(const Eigen::Vector2d& point, double hint_m) const {
  const double hint = std::clamp(hint_m, start_chainage_m_, end_chainage_m_);
  const Settled quick = settle(point, hint);
  const double moved = std::abs(quick.foot.chainage_m - hint);
  if (quick.how == Settled::How::found && moved <= window_m) return quick.foot;
  constexpr double trusted_m = 2.0;
  if (quick.how == Settled::How::beyond_end && moved <= trusted_m) return std::nullopt;
  // Newton's iteration left the window or failed: take the nearest knot of the window.
  std::size_t best = knot_at(hint - window_m);
  const std::size_t last = knot_at(hint + window_m);
  for (std::size_t i = best; i <= last; ++i) {
    if ((point - knots_[i].position).squaredNorm() < (point - knots_[best].position).squaredNorm()) best = i;
  }
  const Settled slow = settle_in(point, best);
  if (slow.how != Settled::How::found || std::abs(slow.foot.chainage_m - hint) > window_m) return std::nullopt;
  return slow.foot;
}

std::optional<PlanFoot> HorizontalAlignment::foot(const Eigen::Vector2d& point, std::optional<double> hint_m) const {
  if (knots_.empty() || !point.allFinite()) return std::nullopt;
  if (hint_m) return foot_near(point, *hint_m);
  Settled best;
  for (const std::size_t knot : nearest_knots(point, 0.0)) {
    const Settled found = settle_in(point, knot);
    if (found.how != Settled::How::failed && found.distance_m < best.distance_m) best = found;
  }
  if (best.how != Settled::How::found) return std::nullopt;
  return best.foot;
}

std::vector<PlanFoot> HorizontalAlignment::feet(const Eigen::Vector2d& point, double beyond_m) const {
  constexpr double same_m = 1e-3;
  std::vector<PlanFoot> found;
  if (knots_.empty() || !point.allFinite()) return found;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t knot : nearest_knots(point, beyond_m)) {
    const Settled one = settle_in(point, knot);
    if (one.how != Settled::How::found) continue;
    if (!found.empty() && std::abs(found.back().chainage_m - one.foot.chainage_m) < same_m) continue;
    found.push_back(one.foot);
    nearest = std::min(nearest, one.distance_m);
  }
  std::erase_if(found, [&](const PlanFoot& foot) { return std::abs(foot.offset_m) > nearest + beyond_m; });
  return found;
}

}  // namespace adit
