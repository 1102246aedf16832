#include "render/plan_drawing.h"

#include <algorithm>
#include <cmath>

#include "render/axes.h"
#include "render/colour_map.h"
#include "render/map_signs.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.2;

// Site (east, north) to the drawing's axes: x along the tunnel, y to its left; about an origin near by, so that
// millions of metres lose nothing.
struct Turn {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();

  Eigen::Vector2d turned(const Eigen::Vector2d& site) const {
    const Eigen::Vector2d d = site - origin;
    return {d.dot(along), along.x() * d.y() - along.y() * d.x()};
  }
  Eigen::Vector2d site(const Eigen::Vector2d& p) const {
    return origin + along * p.x() + Eigen::Vector2d(-along.y(), along.x()) * p.y();
  }
};

Turn turn_of(const Plan& plan) {
  Turn turn;
  std::vector<Eigen::Vector2d> path;
  for (const PlanAxisPoint& p : plan.axis) path.push_back(p.position);
  if (path.size() < 2) {
    path.clear();
    for (const PlanPlace& p : plan.stations) path.push_back(p.position);
  }
  if (path.empty() && !plan.control.empty()) path.push_back(plan.control.front().position);
  if (path.empty()) return turn;
  turn.origin = path.front();
  const Eigen::Vector2d span = path.back() - path.front();
  if (span.norm() > 0.1) turn.along = span.normalized();
  return turn;
}

Eigen::AlignedBox2d box_of(const Plan& plan, const Turn& turn) {
  Eigen::AlignedBox2d box;
  for (const PlanAxisPoint& p : plan.axis) box.extend(turn.turned(p.position));
  for (const PlanPlace& p : plan.stations) box.extend(turn.turned(p.position));
  for (const PlanPlace& p : plan.control) box.extend(turn.turned(p.position));
  const Eigen::Vector2d margin(2.0 + 0.04 * box.sizes().x(), 3.0 + 0.04 * box.sizes().x());
  return {box.min() - margin, box.max() + margin};
}

void draw_grid_crosses(Canvas& canvas, const PlotArea& area, const Turn& turn) {
  Eigen::AlignedBox2d site;
  for (double x : {area.x_from, area.x_to})
    for (double y : {area.y_from, area.y_to}) site.extend(turn.site({x, y}));
  const double step = round_up(std::max(area.x_to - area.x_from, area.y_to - area.y_from) / 7.0);
  const Pen pen{colours::light_grey, 0.2, {}};
  for (double e = std::ceil(site.min().x() / step) * step; e <= site.max().x(); e += step)
    for (double n = std::ceil(site.min().y() / step) * step; n <= site.max().y(); n += step) {
      const Eigen::Vector2d p = turn.turned({e, n});
      if (p.x() < area.x_from || p.x() > area.x_to || p.y() < area.y_from || p.y() > area.y_to) continue;
      const PaperPoint at = area.at(p);
      const Eigen::Vector2d east(turn.along.x(),
                                 turn.along.y());  // direction of east on the paper: (cos, +sin) with y down
      const PaperPoint north(-east.y(), east.x());
      canvas.line(at - 2.0 * PaperPoint(east.x(), east.y()), at + 2.0 * PaperPoint(east.x(), east.y()), pen);
      canvas.line(at - 2.0 * north, at + 2.0 * north, pen);
      const Rect room = area.rect.inset(1.0);
      if (at.x() > room.right() - 16.0 || at.y() > room.bottom() - 6.0) continue;
      canvas.text(at + PaperPoint(0.8, 0.5), "E " + fixed(e, 0) + "\nN " + fixed(n, 0),
                  {.size_mm = 1.7, .colour = colours::grey});
    }
}

void draw_axis(Canvas& canvas, const PlotArea& area, const Plan& plan, const Turn& turn) {
  if (plan.axis.size() < 2) return;
  PaperRing points;
  for (const PlanAxisPoint& p : plan.axis) points.push_back(area.at(turn.turned(p.position)));
  canvas.polyline(points, {colours::ink_blue, 0.35, {4.0, 0.8, 0.6, 0.8}});
  const Ticks ticks = nice_ticks(plan.axis.front().chainage_m, plan.axis.back().chainage_m, 9);
  for (double s : ticks.values) {
    auto next = std::lower_bound(plan.axis.begin(), plan.axis.end(), s - 1e-6,
                                 [](const PlanAxisPoint& p, double v) { return p.chainage_m < v; });
    next = std::clamp(next, plan.axis.begin() + 1, plan.axis.end() - 1);
    const auto& a = *(next - 1);
    const auto& b = *next;
    const double share = (s - a.chainage_m) / (b.chainage_m - a.chainage_m);
    const PaperPoint from = area.at(turn.turned(a.position)), to = area.at(turn.turned(b.position));
    const PaperPoint at = from + share * (to - from);
    const PaperPoint along = (to - from).normalized();
    const PaperPoint side(-along.y(), along.x());
    canvas.line(at - side * 1.2, at + side * 1.2, {colours::ink_blue, 0.3, {}});
    canvas.text(at + side * 1.8, fixed(s, ticks.decimals),
                {.size_mm = text_mm, .colour = colours::ink_blue, .across = Across::centre, .halo_mm = 0.3});
  }
}

void draw_places(Canvas& canvas, const PlotArea& area, const Turn& turn, const std::vector<PlanPlace>& places,
                 bool station) {
  for (const PlanPlace& place : places) {
    const PaperPoint at = area.at(turn.turned(place.position));
    if (station) {
      canvas.fill({{at + PaperPoint(0.0, -1.5), at + PaperPoint(1.3, 0.9), at + PaperPoint(-1.3, 0.9)}}, colours::red);
      canvas.text(at - PaperPoint(0.0, 1.8), place.name,
                  {.size_mm = text_mm, .bold = true, .across = Across::centre, .down = Down::bottom, .halo_mm = 0.3});
    } else {
      canvas.line(at - PaperPoint(1.0, 0.0), at + PaperPoint(1.0, 0.0), {colours::green, 0.3, {}});
      canvas.line(at - PaperPoint(0.0, 1.0), at + PaperPoint(0.0, 1.0), {colours::green, 0.3, {}});
      canvas.text(at + PaperPoint(1.0, -0.6), place.name,
                  {.size_mm = 1.9, .colour = colours::green, .down = Down::bottom, .halo_mm = 0.3});
    }
  }
}

}  // namespace

void draw_plan(Canvas& canvas, const Rect& rect, const Plan& plan) {
  if (plan.axis.empty() && plan.stations.empty() && plan.control.empty()) {
    canvas.text(rect.centre(), "nothing to show in plan",
                {.colour = colours::grey, .across = Across::centre, .down = Down::middle});
    return;
  }
  const Turn turn = turn_of(plan);
  double scale = 0.0;
  const PlotArea area = true_scale_area(rect, box_of(plan, turn), scale);
  canvas.save();
  canvas.clip(rect);
  draw_grid_crosses(canvas, area, turn);
  draw_axis(canvas, area, plan, turn);
  draw_places(canvas, area, turn, plan.control, false);
  draw_places(canvas, area, turn, plan.stations, true);
  canvas.restore();
  canvas.frame(rect, {colours::grey, 0.2, {}});
  draw_scale_bar(canvas, {rect.left + 2.0, rect.bottom() - 2.0}, 1000.0 / scale, 30.0);
  canvas.text({rect.left + 2.0, rect.top + 1.0}, "plan  1 : " + fixed(scale, 0), {.size_mm = text_mm, .halo_mm = 0.3});
  // North on the paper, clockwise from up: the left of the tunnel is up, its direction is to the right.
  draw_north_arrow(canvas, {rect.right() - 6.0, rect.top + 8.0}, 7.0, std::atan2(turn.along.y(), turn.along.x()));
}

}  // namespace adit::render
