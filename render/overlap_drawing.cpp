#include "render/overlap_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "render/map_signs.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr Colour target_colour{0.10, 0.30, 0.65};
constexpr Colour source_colour{0.90, 0.45, 0.05};
constexpr double words_mm = 8.0;
constexpr double detail_m = 0.4;

/// A window of the section on the paper.
struct Window {
  Rect rect;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< right and up [m]
  double mm_per_m = 1.0;

  PaperPoint paper(const Eigen::Vector2f& p) const {
    const Eigen::Vector2d off = mm_per_m * (p.cast<double>() - middle);
    return rect.centre() + PaperPoint(off.x(), -off.y());
  }
};

Eigen::AlignedBox2d box_of(const OverlapSection& section) {
  Eigen::AlignedBox2d box;
  for (const auto* points : {&section.target, &section.source})
    for (const auto& p : *points) box.extend(p.cast<double>());
  return box;
}

void draw_points(Canvas& canvas, const Window& window, const OverlapSection& section, double radius_mm) {
  canvas.save();
  canvas.clip(window.rect);
  const auto draw = [&](const std::vector<Eigen::Vector2f>& points, double radius, const Colour& colour) {
    for (const auto& p : points) {
      const PaperPoint at = window.paper(p);
      if (at.x() > window.rect.left && at.x() < window.rect.right() && at.y() > window.rect.top &&
          at.y() < window.rect.bottom())
        canvas.disc(at, radius, colour);
    }
  };
  draw(section.target, 1.7 * radius_mm, target_colour);  // seen around the other's
  draw(section.source, radius_mm, source_colour);
  canvas.restore();
  canvas.frame(window.rect, {colours::light_grey, 0.2, {}});
}

/// A place that both scans have, by where it lies from the centre.
struct Place {
  const char* words;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
};

/// The place farthest to a side, within 45 degrees of it; nothing where they do not meet there. The target's points are
/// asked for one of the source's within a hand's breadth.
std::optional<Eigen::Vector2d> meeting_place(const OverlapSection& section, const Eigen::Vector2d& side) {
  constexpr std::size_t looked_at = 1000;
  constexpr float near_m = 0.1F;
  std::optional<Eigen::Vector2d> best;
  double most = 0.0;
  const std::size_t step = section.target.size() / looked_at + 1;
  for (std::size_t i = 0; i < section.target.size(); i += step) {
    const Eigen::Vector2f& p = section.target[i];
    const double towards = side.dot(p.cast<double>()) - std::abs(side.x() * p.y() - side.y() * p.x());
    if (towards <= most) continue;
    const bool met = std::any_of(section.source.begin(), section.source.end(),
                                 [&](const Eigen::Vector2f& q) { return (p - q).norm() < near_m; });
    if (!met) continue;
    most = towards;
    best = p.cast<double>();
  }
  return best;
}

/// Above and to the right, or at the other sides where the scans do not meet there; two at most, apart.
std::vector<Place> meeting_places(const OverlapSection& section) {
  const std::array<Place, 4> sides{
      {{"above", {0.0, 1.0}}, {"right", {1.0, 0.0}}, {"left", {-1.0, 0.0}}, {"below", {0.0, -1.0}}}};
  std::vector<Place> places;
  for (const Place& side : sides) {
    const auto met = meeting_place(section, side.middle);
    const bool apart = met && std::all_of(places.begin(), places.end(),
                                          [&](const Place& other) { return (other.middle - *met).norm() > detail_m; });
    if (apart && places.size() < 2) places.push_back({side.words, *met});
  }
  return places;
}

}  // namespace

void draw_overlap(Canvas& canvas, const Rect& rect, const PairSection& shown) {
  const OverlapSection& section = shown.section;
  const double height = rect.height - words_mm;
  const double side = 0.5 * (height - 1.0);
  const Rect whole{rect.left, rect.top, rect.width - side - 1.5, height};
  const Eigen::AlignedBox2d box = box_of(section);
  if (section.target.empty() || section.source.empty()) {
    canvas.frame(whole, {colours::light_grey, 0.2, {}});
    canvas.text(whole.centre(), "no points of both here",
                {.size_mm = 2.4, .colour = colours::grey, .across = Across::centre});
  } else {
    const Eigen::Vector2d size = box.sizes().cwiseMax(0.5);
    const double scale = 0.95 * std::min(whole.width / size.x(), whole.height / size.y());
    draw_points(canvas, {whole, box.center(), scale}, section, 0.12);
    draw_scale_bar(canvas, {whole.left + 1.0, whole.bottom() - 1.0}, scale, 0.3 * whole.width, 1.9);
    Rect detail{whole.right() + 1.5, rect.top, side, side};
    for (const Place& place : meeting_places(section)) {
      draw_points(canvas, {detail, place.middle, side / detail_m}, section, 0.25);
      const PaperPoint at = Window{whole, box.center(), scale}.paper(place.middle.cast<float>());
      const double half = 0.5 * detail_m * scale;
      canvas.save();
      canvas.clip(whole);
      canvas.frame({at.x() - half, at.y() - half, 2.0 * half, 2.0 * half}, {colours::grey, 0.2, {}});
      canvas.restore();
      canvas.text({detail.left + 0.6, detail.top + 0.4}, place.words, {.size_mm = 1.9, .colour = colours::grey});
      detail.top += side + 1.0;
    }
  }
  const PairResult& pair = shown.pair;
  const TextStyle small{.size_mm = 2.1, .shorten_mm = rect.width};
  canvas.disc({rect.left + 0.8, rect.bottom() - words_mm + 2.2}, 0.6, source_colour);
  canvas.text({rect.left + 2.0, rect.bottom() - words_mm + 1.0}, pair.source,
              {.size_mm = 2.1, .shorten_mm = 0.5 * rect.width - 3.0});
  canvas.disc({rect.left + 0.5 * rect.width + 0.8, rect.bottom() - words_mm + 2.2}, 0.6, target_colour);
  canvas.text({rect.left + 0.5 * rect.width + 2.0, rect.bottom() - words_mm + 1.0}, pair.target,
              {.size_mm = 2.1, .shorten_mm = 0.5 * rect.width - 3.0});
  canvas.text({rect.left, rect.bottom() - words_mm + 4.2},
              (pair.used ? "median " : "not used, as it would lie: median ") + fixed(1000.0 * pair.median_m, 1) +
                  " mm; section " + fixed(2000.0 * section.half_thickness_m, 0) + " mm thick; squares " +
                  fixed(1000.0 * detail_m, 0) + " mm wide",
              small);
}

Picture overlap_picture(const PairSection& shown, double width_mm, double height_mm) {
  constexpr double dots_per_inch = 250.0;
  Canvas canvas = Canvas::raster(width_mm, height_mm, dots_per_inch);
  draw_overlap(canvas, Rect{0.0, 0.0, width_mm, height_mm}.inset(1.0), shown);
  return canvas.finish_picture();
}

}  // namespace adit::render
