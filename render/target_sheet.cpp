#include "render/target_sheet.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double margin_mm = 8.0;  // what printers leave white
constexpr double foot_mm = 16.0;   // ruler and words
constexpr double label_mm = 5.0;   // below a target
constexpr double mark_mm = 4.0;    // of a crop mark

PaperPoint on_circle(const PaperPoint& centre, double radius_mm, double turn_rad) {
  return centre + radius_mm * PaperPoint(std::cos(turn_rad), -std::sin(turn_rad));  // counter-clockwise on paper
}

/// A piece of a ring; inner radius 0: a sector.
PaperRing ring_piece(const PaperPoint& centre, double inner_mm, double outer_mm, double from_rad, double to_rad) {
  const int steps = std::max(4, static_cast<int>((to_rad - from_rad) / rad_from_deg(0.5)));
  PaperRing ring;
  for (int i = 0; i <= steps; ++i)
    ring.push_back(on_circle(centre, outer_mm, from_rad + (to_rad - from_rad) * i / steps));
  if (inner_mm <= 0.0) {
    ring.push_back(centre);
    return ring;
  }
  for (int i = steps; i >= 0; --i)
    ring.push_back(on_circle(centre, inner_mm, from_rad + (to_rad - from_rad) * i / steps));
  return ring;
}

std::string bits_of(TargetCode code) {
  std::string bits;
  for (int k = 0; k < coded_pattern::segments; ++k) bits += is_black(code, k) ? '1' : '0';
  return bits;
}

void draw_crop_marks(Canvas& canvas, const Rect& rect) {
  const Pen pen{colours::grey, 0.15, {}};
  for (const double x : {rect.left, rect.right()})
    for (const double y : {rect.top, rect.bottom()}) {
      const double out_x = x == rect.left ? 1.0 : -1.0, out_y = y == rect.top ? 1.0 : -1.0;
      canvas.line({x, y}, {x + out_x * mark_mm, y}, pen);
      canvas.line({x, y}, {x, y + out_y * mark_mm}, pen);
    }
}

/// 100 mm with millimetres: whether the printer kept the size.
void draw_ruler(Canvas& canvas, const PaperPoint& at) {
  constexpr int length_mm = 100;
  const Pen pen{colours::black, 0.15, {}};
  canvas.line(at, at + PaperPoint(length_mm, 0.0), pen);
  for (int k = 0; k <= length_mm; ++k) {
    const double tick = k % 10 == 0 ? 3.0 : k % 5 == 0 ? 2.2 : 1.4;
    canvas.line(at + PaperPoint(k, 0.0), at + PaperPoint(k, -tick), pen);
  }
  for (const int k : {0, 100})  // a "50" below its line has been read as a small target
    canvas.text(at + PaperPoint(k, 0.5), std::to_string(k), {.size_mm = 2.2, .across = Across::centre});
  canvas.text(at + PaperPoint(length_mm + 3.0, -2.2), "mm: print at 100 %, and measure this line", {.size_mm = 2.4});
}

void draw_foot(Canvas& canvas, const PaperSize& paper, const std::string& words) {
  const double y = paper.height_mm - margin_mm - 6.0;
  draw_ruler(canvas, {margin_mm + 2.0, y});
  canvas.text({margin_mm + 2.0, y + 4.0}, words, {.size_mm = 2.2, .colour = colours::grey});
}

void draw_labelled(Canvas& canvas, const Rect& cell, double diameter_mm, int id) {
  const TargetCode code = code_of_id(id);
  const PaperPoint centre(cell.centre().x(), cell.top + 0.5 * (cell.height - label_mm));
  draw_target(canvas, centre, diameter_mm, code);
  canvas.text({cell.left + mark_mm + 1.0, cell.bottom() - 0.5}, "Adit " + std::to_string(id),
              {.size_mm = 3.2, .bold = true, .down = Down::bottom});
  canvas.text({cell.right() - mark_mm - 1.0, cell.bottom() - 0.7}, bits_of(code) + "  " + fixed(diameter_mm, 0) + " mm",
              {.size_mm = 2.2, .colour = colours::grey, .across = Across::right, .down = Down::bottom});
}

}  // namespace

PaperSize paper_size(const std::string& name) {
  static const std::vector<PaperSize> sizes{
      {"A5", 148.0, 210.0},     {"A4", 210.0, 297.0},    {"A3", 297.0, 420.0},
      {"A2", 420.0, 594.0},     {"A1", 594.0, 841.0},    {"A0", 841.0, 1189.0},
      {"Letter", 215.9, 279.4}, {"Legal", 215.9, 355.6}, {"Tabloid", 279.4, 431.8}};
  std::string all;
  for (const PaperSize& size : sizes) {
    if (std::equal(size.name.begin(), size.name.end(), name.begin(), name.end(),
                   [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); }))
      return size;
    all += (all.empty() ? "" : ", ") + size.name;
  }
  throw Error("there is no paper " + name, {}, "write one of: " + all);
}

void draw_target(Canvas& canvas, const PaperPoint& centre, double diameter_mm, TargetCode code) {
  const double radius = 0.5 * diameter_mm;
  canvas.fill({ring_piece(centre, 0.0, radius * coded_pattern::disc_radius, 0.5 * pi, 2.0 * pi)}, colours::black);
  constexpr double one_rad = 2.0 * pi / coded_pattern::segments;
  // Black neighbours are one piece, so that no hairline is printed between them.
  for (int k = 0; k < coded_pattern::segments; ++k) {
    if (!is_black(code, k)) continue;
    int count = 1;
    while (k + count < coded_pattern::segments && is_black(code, k + count)) ++count;
    canvas.fill({ring_piece(centre, radius * coded_pattern::ring_radius, radius, k * one_rad, (k + count) * one_rad)},
                colours::black);
    k += count - 1;
  }
}

std::string target_pages(const std::vector<int>& ids, double diameter_mm, const PaperSize& paper,
                         const DocumentTitle& title) {
  const double side = diameter_mm * coded_pattern::clear_radius;
  const double width = paper.width_mm - 2.0 * margin_mm, height = paper.height_mm - 2.0 * margin_mm - foot_mm;
  const int columns = static_cast<int>(width / side), rows = static_cast<int>(height / (side + label_mm));
  if (columns < 1 || rows < 1)
    throw Error("a target of " + fixed(diameter_mm, 0) + " mm does not fit on " + paper.name, {},
                "up to " + fixed(std::floor(std::min(width, height - label_mm) / coded_pattern::clear_radius), 0) +
                    " mm fit; use a larger paper for more");
  Canvas canvas = Canvas::pdf(paper.width_mm, paper.height_mm, title);
  const double gap_x = (width - columns * side) / columns, gap_y = (height - rows * (side + label_mm)) / rows;
  const auto per_page = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::size_t on_page = i % per_page;
    if (i > 0 && on_page == 0) canvas.next_page();
    const auto column = static_cast<double>(on_page % static_cast<std::size_t>(columns));
    const std::size_t row_number = on_page / static_cast<std::size_t>(columns);
    const auto row = static_cast<double>(row_number);
    const Rect cell{margin_mm + (column + 0.5) * gap_x + column * side,
                    margin_mm + (row + 0.5) * gap_y + row * (side + label_mm), side, side + label_mm};
    draw_crop_marks(canvas, cell);
    draw_labelled(canvas, cell, diameter_mm, ids[i]);
    if (on_page == 0)
      draw_foot(canvas, paper,
                "The point to survey is the tip of the white quarter. Mount flat; leave the white rim free.");
  }
  return canvas.finish();
}

TargetBoard target_board(const std::vector<int>& ids, int columns, int rows, double diameter_mm, const PaperSize& paper,
                         const DocumentTitle& title) {
  const bool lying = columns > rows;
  const PaperSize sheet = lying ? PaperSize{paper.name, paper.height_mm, paper.width_mm}
                                : PaperSize{paper.name, paper.width_mm, paper.height_mm};
  const double side = diameter_mm * 1.1;
  const double width = sheet.width_mm - 2.0 * margin_mm, height = sheet.height_mm - 2.0 * margin_mm - foot_mm;
  if (columns * side > width || rows * side > height)
    throw Error(std::to_string(columns) + " x " + std::to_string(rows) + " targets of " + fixed(diameter_mm, 0) +
                    " mm do not fit on " + paper.name,
                {}, "use a larger paper, or smaller or fewer targets");
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  if (ids.size() < count)
    throw Error("a board of " + std::to_string(count) + " targets wants as many ids, not " + std::to_string(ids.size()),
                {}, "name more ids, or a smaller board");
  TargetBoard board;
  Canvas canvas = Canvas::pdf(sheet.width_mm, sheet.height_mm, title);
  const PaperPoint step(std::floor(10.0 * width / columns) / 10.0, std::floor(10.0 * height / rows) / 10.0);
  const PaperPoint first(margin_mm + 0.5 * step.x(), margin_mm + 0.5 * step.y());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const PaperPoint at = first + PaperPoint(c * step.x(), r * step.y());
      const int id = ids[board.centres_mm.size()];
      draw_target(canvas, at, diameter_mm, code_of_id(id));
      canvas.text(at + PaperPoint(0.5 * diameter_mm, 0.5 * diameter_mm), std::to_string(id),
                  {.size_mm = 1.8, .colour = colours::grey, .across = Across::centre, .down = Down::middle});
      board.centres_mm.emplace_back(c * step.x(), -r * step.y());
    }
  draw_foot(canvas, sheet,
            "Calibration board, steps of " + fixed(step.x(), 1) + " x " + fixed(step.y(), 1) +
                " mm. Glue it onto something flat and stiff.");
  board.pdf = canvas.finish();
  return board;
}

}  // namespace adit::render
