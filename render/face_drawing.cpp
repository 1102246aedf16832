#include "render/face_drawing.h"

#include "render/axes.h"
#include "render/colour_map.h"
#include "render/map_signs.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.1;

Rect cell_rect(const PlotArea& area, const FaceMap& face, std::size_t i) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * face.step_m);
  const Eigen::Vector2d middle = face.middle(i % face.columns, i / face.columns);
  const PaperPoint low = area.at(middle - half), high = area.at(middle + half);
  return {low.x(), high.y(), high.x() - low.x(), low.y() - high.y()};
}

}  // namespace

void draw_face(Canvas& canvas, const Rect& rect, const std::string& title, const FaceMap& face,
               const std::vector<SectionLine>& lines) {
  canvas.text({rect.left, rect.top}, title, {.size_mm = 3.0, .bold = true});
  if (face.cells.empty()) {
    canvas.text(rect.centre(), "no face seen",
                {.colour = colours::grey, .across = Across::centre, .down = Down::middle});
    return;
  }
  const FaceSummary summary = summarise(face);
  std::vector<float> reliefs;
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < face.cells.size(); ++i) {
    if (face.cells[i].kind == FaceKind::beside) continue;
    box.extend(face.middle(i % face.columns, i / face.columns));
    if (face.cells[i].kind == FaceKind::seen)
      reliefs.push_back(static_cast<float>(face.cells[i].chainage_m - summary.mean_m));
  }
  for (const SectionLine& line : lines)
    for (const Eigen::Vector2d& p : line.ring) box.extend(p);
  const DeviationScale scale = deviation_scale(reliefs);
  const Rect room{rect.left + 6.0, rect.top + 5.0, rect.width - 6.0, rect.height - 5.0 - 24.0};
  double denominator = 1.0;
  const PlotArea area = true_scale_area(room, box, denominator);
  for (std::size_t i = 0; i < face.cells.size(); ++i) {
    const FaceCell& cell = face.cells[i];
    if (cell.kind == FaceKind::seen)
      canvas.fill(cell_rect(area, face, i), deviation_colour(scale, cell.chainage_m - summary.mean_m));
    if (cell.kind == FaceKind::hidden) canvas.fill(cell_rect(area, face, i), colours::light_grey);
  }
  for (const SectionLine& line : lines) {
    PaperRing ring;
    for (const Eigen::Vector2d& p : line.ring) ring.push_back(area.at(p));
    canvas.polyline(ring, {colours::ink_blue, 0.3, {}}, true);
  }
  draw_axes(canvas, area, {.x = "offset m", .y = "height m", .text_mm = text_mm, .grid = false});
  const double below = room.bottom() + 9.5;
  draw_deviation_legend(canvas, {rect.left + 6.0, below - 2.0, 0.75 * rect.width, 8.0}, scale, text_mm,
                        {"nearer", "farther"});
  canvas.text({rect.left, rect.bottom() - 5.0},
              "from chainage " + fixed(summary.mean_m, 3) + " (mean), looking up-chainage, 1:" + fixed(denominator, 0),
              {.size_mm = text_mm});
  canvas.text({rect.left, rect.bottom() - 2.0},
              fixed(summary.least_m, 2) + " to " + fixed(summary.greatest_m, 2) + ", seen " + percent(summary.share()) +
                  ", hidden (grey) " + fixed(summary.hidden_m2, 1) + " m\u00b2, not seen: white; cells " +
                  fixed(100.0 * face.step_m, 0) + " cm",
              {.size_mm = text_mm});
}

}  // namespace adit::render
