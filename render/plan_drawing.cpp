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

// Rectangles that words already stand in: the next words go elsewhere or stay away.
class LabelRoom {
 public:
  explicit LabelRoom(const Rect& paper) : paper_(paper) {}
  bool take(const Rect& label) {
    if (label.left < paper_.left || label.right() > paper_.right() || label.top < paper_.top ||
        label.bottom() > paper_.bottom())
      return false;
    for (const Rect& r : taken_)
      if (label.left < r.right() && r.left < label.right() && label.top < r.bottom() && r.top < label.bottom())
        return false;
    taken_.push_back(label);
    return true;
  }
  void block(const PaperPoint& at, double reach_mm) {
    taken_.push_back({at.x() - reach_mm, at.y() - reach_mm, 2.0 * reach_mm, 2.0 * reach_mm});
  }

 private:
  Rect paper_;
  std::vector<Rect> taken_;
};

// Writes the words at the first of the four sides of a place that is free; nothing when none is.
void label_beside(Canvas& canvas, LabelRoom& room, const PaperPoint& at, double reach_mm, const std::string& words,
                  TextStyle style) {
  const Eigen::Vector2d size = canvas.text_size(words, style);
  const double half = size.x() / 2.0;
  const PaperPoint corners[] = {{at.x() - half, at.y() - reach_mm - size.y()},
                                {at.x() - half, at.y() + reach_mm},
                                {at.x() + reach_mm, at.y() - size.y() / 2.0},
                                {at.x() - reach_mm - size.x(), at.y() - size.y() / 2.0}};
  for (const PaperPoint& corner : corners)
    if (room.take({corner.x(), corner.y(), size.x(), size.y()})) {
      canvas.text(corner, words, style);
      return;
    }
}

Eigen::AlignedBox2d box_of(const Plan& plan, const Turn& turn) {
  Eigen::AlignedBox2d box;
  for (const PlanAxisPoint& p : plan.axis) box.extend(turn.turned(p.position));
  for (const PlanPlace& p : plan.stations) box.extend(turn.turned(p.position));
  for (const PlanPlace& p : plan.control) box.extend(turn.turned(p.position));
  for (const PlanPlace& p : plan.landmarks) box.extend(turn.turned(p.position));
  const Eigen::Vector2d margin(2.0 + 0.04 * box.sizes().x(), 3.0 + 0.04 * box.sizes().x());
  return {box.min() - margin, box.max() + margin};
}

void draw_grid_cross(Canvas& canvas, const PaperPoint& at, const Turn& turn) {
  const Pen pen{colours::light_grey, 0.2, {}};
  const PaperPoint east = 2.0 * turn.along;  // with y downwards on the paper
  const PaperPoint north(-east.y(), east.x());
  canvas.line(at - east, at + east, pen);
  canvas.line(at - north, at + north, pen);
}

void draw_grid_crosses(Canvas& canvas, LabelRoom& room, const PlotArea& area, const Turn& turn) {
  Eigen::AlignedBox2d site;
  for (double x : {area.x_from, area.x_to})
    for (double y : {area.y_from, area.y_to}) site.extend(turn.site({x, y}));
  const double step = round_up(std::max(area.x_to - area.x_from, area.y_to - area.y_from) / 7.0);
  const Eigen::Vector2d first = (site.min() / step).array().ceil() * step;
  for (double e = first.x(); e <= site.max().x(); e += step)
    for (double n = first.y(); n <= site.max().y(); n += step) {
      const Eigen::Vector2d p = turn.turned({e, n});
      if (p.x() < area.x_from || p.x() > area.x_to || p.y() < area.y_from || p.y() > area.y_to) continue;
      const PaperPoint at = area.at(p);
      draw_grid_cross(canvas, at, turn);
      const std::string words = "E " + fixed(e, 0) + "\nN " + fixed(n, 0);
      const TextStyle style{.size_mm = 1.7, .colour = colours::grey};
      const Eigen::Vector2d size = canvas.text_size(words, style);
      const PaperPoint corner = at + PaperPoint(0.9, 0.5);
      if (room.take({corner.x(), corner.y(), size.x(), size.y()})) canvas.text(corner, words, style);
    }
}

PaperPoint axis_point(const PlotArea& area, const Plan& plan, const Turn& turn, double chainage_m) {
  auto next = std::lower_bound(plan.axis.begin(), plan.axis.end(), chainage_m - 1e-6,
                               [](const PlanAxisPoint& p, double v) { return p.chainage_m < v; });
  next = std::clamp(next, plan.axis.begin() + 1, plan.axis.end() - 1);
  const PlanAxisPoint& a = *(next - 1);
  const double share = (chainage_m - a.chainage_m) / (next->chainage_m - a.chainage_m);
  return area.at(turn.turned(a.position + share * (next->position - a.position)));
}

void draw_axis(Canvas& canvas, LabelRoom& room, const PlotArea& area, const Plan& plan, const Turn& turn) {
  if (plan.axis.size() < 2) return;
  PaperRing points;
  for (const PlanAxisPoint& p : plan.axis) points.push_back(area.at(turn.turned(p.position)));
  canvas.polyline(points, {colours::ink_blue, 0.35, {4.0, 0.8, 0.6, 0.8}});
  const Ticks ticks = nice_ticks(plan.axis.front().chainage_m, plan.axis.back().chainage_m, 9);
  for (double s : ticks.values) {
    const PaperPoint at = axis_point(area, plan, turn, s);
    canvas.line(at - PaperPoint(0.0, 1.2), at + PaperPoint(0.0, 1.2), {colours::ink_blue, 0.3, {}});
    label_beside(canvas, room, at, 1.4, fixed(s, ticks.decimals), {.size_mm = text_mm, .colour = colours::ink_blue});
  }
}

void draw_ties(Canvas& canvas, const PlotArea& area, const Turn& turn, const std::vector<PlanTie>& ties) {
  for (const PlanTie& tie : ties)
    canvas.line(area.at(turn.turned(tie.from)), area.at(turn.turned(tie.to)),
                tie.is_whole ? Pen{colours::grey, 0.3, {}} : Pen{colours::red, 0.3, {1.0, 0.8}});
}

enum class Mark { station, control, landmark };

void draw_places(Canvas& canvas, LabelRoom& room, const PlotArea& area, const Turn& turn,
                 const std::vector<PlanPlace>& places, Mark mark) {
  const bool station = mark == Mark::station;
  const Colour colour = mark == Mark::control ? colours::green : colours::ink_blue;
  for (const PlanPlace& place : places) {
    const PaperPoint at = area.at(turn.turned(place.position));
    switch (mark) {
      case Mark::station:
        canvas.fill({{at + PaperPoint(0.0, -1.5), at + PaperPoint(1.3, 0.9), at + PaperPoint(-1.3, 0.9)}},
                    colours::red);
        break;
      case Mark::control:
        canvas.line(at - PaperPoint(1.0, 0.0), at + PaperPoint(1.0, 0.0), {colour, 0.3, {}});
        canvas.line(at - PaperPoint(0.0, 1.0), at + PaperPoint(0.0, 1.0), {colour, 0.3, {}});
        break;
      case Mark::landmark:
        canvas.polyline({at - PaperPoint(0.8, 0.0), at - PaperPoint(0.0, 0.8), at + PaperPoint(0.8, 0.0),
                         at + PaperPoint(0.0, 0.8), at - PaperPoint(0.8, 0.0)},
                        {colour, 0.25, {}});
        break;
    }
    room.block(at, 1.2);
    label_beside(canvas, room, at, station ? 2.0 : 1.5, place.name,
                 {.size_mm = text_mm, .colour = station ? colours::black : colour, .bold = station});
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
  LabelRoom room(rect.inset(1.0));
  room.take({rect.left + 1.0, rect.top + 1.0, 30.0, 5.0});
  room.take({rect.left + 1.0, rect.bottom() - 8.0, 36.0, 7.0});
  room.take({rect.right() - 12.0, rect.top + 1.0, 11.0, 15.0});
  for (const PlanAxisPoint& p : plan.axis) room.block(area.at(turn.turned(p.position)), 0.8);
  canvas.save();
  canvas.clip(rect);
  draw_ties(canvas, area, turn, plan.ties);
  draw_places(canvas, room, area, turn, plan.stations, Mark::station);
  draw_places(canvas, room, area, turn, plan.control, Mark::control);
  draw_places(canvas, room, area, turn, plan.landmarks, Mark::landmark);
  draw_axis(canvas, room, area, plan, turn);
  draw_grid_crosses(canvas, room, area, turn);
  canvas.restore();
  canvas.frame(rect, {colours::grey, 0.2, {}});
  draw_scale_bar(canvas, {rect.left + 2.0, rect.bottom() - 2.0}, 1000.0 / scale, 30.0);
  canvas.text({rect.left + 2.0, rect.top + 1.0}, "plan  1 : " + fixed(scale, 0), {.size_mm = text_mm, .halo_mm = 0.3});
  // North on the paper, clockwise from up: the left of the tunnel is up, its direction is to the right.
  draw_north_arrow(canvas, {rect.right() - 6.0, rect.top + 8.0}, 7.0, std::atan2(turn.along.y(), turn.along.x()));
}

}  // namespace adit::render
