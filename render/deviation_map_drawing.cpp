#include "render/deviation_map_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/axes.h"
#include "render/map_signs.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.2;
constexpr double left_mm = 23.0;   // ticks and "left wall"
constexpr double below_mm = 8.5;   // ticks and name of the chainage axis
constexpr double rounds_mm = 4.0;  // numbers of rounds above a strip
constexpr double legend_mm = 17.0;
constexpr double longest_strip_m = 100.0;
constexpr double least_strip_mm = 38.0;
constexpr double most_strip_mm = 105.0;
constexpr int most_pixels = 4000;
constexpr int opening_hatch = 6;  // pixels from line to line
constexpr int cell_pixels = 5;    // enough for the dot of an interpolated cell

struct Strip {
  std::size_t row_begin = 0;
  std::size_t row_end = 0;
};

std::vector<Strip> strips_of(const DeviationMap& map) {
  const double length = static_cast<double>(map.rows) * map.step_s_m;
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / longest_strip_m - 1e-6)));
  const std::size_t rows = (map.rows + count - 1) / count;
  std::vector<Strip> strips;
  for (std::size_t begin = 0; begin < map.rows; begin += rows)
    strips.push_back({begin, std::min(begin + rows, map.rows)});
  return strips;
}

double strip_height(const DeviationMap& map, double width_mm) {
  const auto strips = strips_of(map);
  if (strips.empty()) return least_strip_mm;
  const double length = static_cast<double>(strips.front().row_end - strips.front().row_begin) * map.step_s_m;
  const double true_scale = (width_mm - left_mm) / length * static_cast<double>(map.columns) * map.step_q_m;
  return std::clamp(true_scale, least_strip_mm, most_strip_mm);
}

std::array<std::uint8_t, 4> bytes_of(const Colour& c) {
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(v, 0.0, 1.0))); };
  return {byte(c.red), byte(c.green), byte(c.blue), 255};
}

void paint_cell(Picture& picture, int x0, int y0, int size, const MapCell& cell, const DeviationScale& scale,
                bool neutral_within_spread) {
  if (cell.kind == CellKind::opening) {
    for (int y = y0; y < y0 + size; ++y)
      for (int x = x0; x < x0 + size; ++x)
        if ((x + y) % opening_hatch < opening_hatch / 2) picture.set_pixel(x, y, bytes_of(colours::black));
  }
  if (!has_rock(cell.kind)) return;
  const bool guessed = cell.kind == CellKind::interpolated;
  const bool neutral = neutral_within_spread && std::abs(cell.deviation_m) <= cell.spread_m;
  const Colour colour = neutral ? colours::light_grey : deviation_colour(scale, static_cast<double>(cell.deviation_m));
  const auto fill = bytes_of(guessed ? mixed(colour, colours::white, 0.55) : colour);
  for (int y = y0; y < y0 + size; ++y)
    for (int x = x0; x < x0 + size; ++x) picture.set_pixel(x, y, fill);
  if (guessed && size >= 3)
    picture.set_pixel(x0 + size / 2, y0 + size / 2, bytes_of(mixed(colour, colours::black, 0.5)));
}

Picture picture_of(const DeviationMap& map, const Strip& strip, const DeviationScale& scale,
                   bool neutral_within_spread) {
  const int rows = static_cast<int>(strip.row_end - strip.row_begin);
  const int columns = static_cast<int>(map.columns);
  const int size = std::clamp(most_pixels / std::max(rows, columns), 1, cell_pixels);
  Picture picture = blank_picture(rows * size, columns * size, {255, 255, 255, 0});
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      paint_cell(picture, r * size, c * size, size,
                 map.cell(strip.row_begin + static_cast<std::size_t>(r), static_cast<std::size_t>(c)), scale,
                 neutral_within_spread);
  return picture;
}

// Labels of strong marks first; a weak one that has no room beside them keeps its tick only.
std::vector<bool> labelled(const std::vector<LineMark>& marks, double mm_per_m) {
  std::vector<bool> chosen(marks.size(), false);
  for (const bool strong : {true, false})
    for (std::size_t i = 0; i < marks.size(); ++i) {
      if (marks[i].strong != strong) continue;
      chosen[i] = true;
      for (std::size_t k = 0; k < marks.size() && chosen[i]; ++k)
        if (k != i && chosen[k] && std::abs(marks[k].q_m - marks[i].q_m) * mm_per_m < 1.2 * text_mm) chosen[i] = false;
    }
  return chosen;
}

void draw_marks(Canvas& canvas, const PlotArea& area, const std::vector<LineMark>& marks) {
  const double mm_per_m = area.rect.height / (area.y_to - area.y_from);
  const std::vector<bool> label = labelled(marks, mm_per_m);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double y = area.rect.top + (marks[i].q_m - area.y_from) * mm_per_m;
    if (y < area.rect.top - 1e-6 || y > area.rect.bottom() + 1e-6) continue;
    if (marks[i].strong)
      canvas.line({area.rect.left, y}, {area.rect.right(), y}, {{0.2, 0.2, 0.2, 0.7}, 0.15, {2.0, 1.0}});
    canvas.line({area.rect.left - 1.0, y}, {area.rect.left, y}, {colours::grey, 0.2, {}});
    if (label[i])
      canvas.text({area.rect.left - 1.4, y}, marks[i].label,
                  {.size_mm = text_mm, .bold = marks[i].strong, .across = Across::right, .down = Down::middle});
  }
  const double x = area.rect.left - left_mm + 0.5;
  const TextStyle side{.size_mm = text_mm, .colour = colours::grey, .across = Across::centre, .turn_rad = -M_PI / 2.0};
  canvas.text({x, area.rect.top + 0.25 * area.rect.height}, "left", side);
  canvas.text({x, area.rect.top + 0.75 * area.rect.height}, "right", side);
}

void draw_rounds(Canvas& canvas, const PlotArea& area, const std::vector<JobRound>& rounds) {
  double last_label = -1e9;
  for (const JobRound& round : rounds) {
    const double from = std::max(round.from_m, area.x_from), to = std::min(round.to_m, area.x_to);
    if (to <= from) continue;
    for (double s : {round.from_m, round.to_m})
      if (s >= area.x_from - 1e-6 && s <= area.x_to + 1e-6)
        canvas.line({area.paper_x(s), area.rect.top - 1.5}, {area.paper_x(s), area.rect.bottom()},
                    {colours::black, 0.25, {}});
    const double x = (area.paper_x(from) + area.paper_x(to)) / 2.0;
    if (x - last_label < 6.0) continue;
    last_label = x;
    canvas.text({x, area.rect.top - 0.5}, std::to_string(round.number),
                {.size_mm = text_mm, .bold = true, .across = Across::centre, .down = Down::bottom});
  }
}

void draw_strip(Canvas& canvas, const MapStrip& place, const DeviationMap& map, const Strip& strip,
                const DeviationScale& scale, const MapTexts& texts) {
  const Rect& rect = place.rect;
  const PlotArea area{rect, place.from_m, place.to_m, 0.0, static_cast<double>(map.columns) * map.step_q_m};
  canvas.hatch({ring_of(rect)}, {colours::light_grey, 0.15, {}}, 1.2, M_PI / 4.0);
  canvas.picture(picture_of(map, strip, scale, texts.neutral_within_spread), rect, false);
  draw_marks(canvas, area, texts.marks);
  draw_rounds(canvas, area, texts.rounds);
  canvas.frame(rect, {colours::grey, 0.2, {}});
  const Ticks ticks = nice_ticks(area.x_from, area.x_to, 12);
  for (double s : ticks.values) {
    canvas.line({area.paper_x(s), rect.bottom()}, {area.paper_x(s), rect.bottom() + 1.0}, {colours::grey, 0.2, {}});
    canvas.text({area.paper_x(s), rect.bottom() + 1.2}, fixed(s, ticks.decimals),
                {.size_mm = text_mm, .across = Across::centre});
  }
}

void draw_legend(Canvas& canvas, const Rect& rect, const DeviationScale& scale, const MapTexts& texts) {
  draw_deviation_legend(canvas, {rect.left + left_mm, rect.top + 2.0, 0.52 * rect.width, 10.0}, scale, text_mm,
                        texts.words);
  const double x = rect.left + left_mm + 0.52 * rect.width + 14.0;
  const Rect unseen{x, rect.top + 2.6, 4.0, 2.6}, guessed{x, rect.top + 6.6, 4.0, 2.6};
  canvas.hatch({ring_of(unseen)}, {colours::light_grey, 0.15, {}}, 1.0, M_PI / 4.0);
  canvas.frame(unseen, {colours::grey, 0.12, {}});
  if (texts.neutral_within_spread) {
    canvas.fill(guessed, colours::light_grey);
  } else {
    const Colour full = deviation_colour(scale, 0.6 * scale.most_m);
    canvas.fill(guessed, mixed(full, colours::white, 0.55));
    for (const double down : {0.8, 1.8})
      for (const double right : {0.5, 1.5, 2.5, 3.5})
        canvas.disc({guessed.left + right, guessed.top + down}, 0.12, mixed(full, colours::black, 0.5));
  }
  canvas.frame(guessed, {colours::grey, 0.12, {}});
  canvas.text({x + 5.0, unseen.centre().y()}, "not seen", {.size_mm = text_mm, .down = Down::middle});
  const Rect open{x + 28.0, unseen.top, unseen.width, unseen.height};
  canvas.hatch({ring_of(open)}, {colours::black, 0.25, {}}, 0.8, -M_PI / 4.0);
  canvas.frame(open, {colours::grey, 0.12, {}});
  canvas.text({open.right() + 1.0, open.centre().y()}, "open", {.size_mm = text_mm, .down = Down::middle});
  canvas.text({x + 5.0, guessed.centre().y()},
              texts.neutral_within_spread ? "no change for certain (95 %)" : "interpolated",
              {.size_mm = text_mm, .down = Down::middle});
  canvas.text({x, guessed.bottom() + 0.8}, "from line: " + texts.line, {.size_mm = text_mm, .colour = colours::grey});
}

}  // namespace

std::vector<float> seen_deviations(const DeviationMap& map) {
  std::vector<float> values;
  for (const MapCell& cell : map.cells)
    if (has_rock(cell.kind)) values.push_back(cell.deviation_m);
  return values;
}

double deviation_map_height(const DeviationMap& map, double width_mm) {
  return static_cast<double>(std::max<std::size_t>(1, strips_of(map).size())) *
             (strip_height(map, width_mm) + rounds_mm + below_mm) +
         legend_mm;
}

std::vector<MapStrip> map_strips(const Rect& rect, const DeviationMap& map) {
  std::vector<MapStrip> places;
  const std::vector<Strip> strips = strips_of(map);
  if (strips.empty() || map.columns == 0) return places;
  const double width = rect.width - left_mm - 3.0;
  const double full = static_cast<double>(strips.front().row_end);
  const double room = (rect.height - legend_mm) / static_cast<double>(strips.size()) - rounds_mm - below_mm;
  const double height = std::min(strip_height(map, rect.width), room);
  double y = rect.top + rounds_mm;
  for (const Strip& strip : strips) {
    const double share = static_cast<double>(strip.row_end - strip.row_begin) / full;
    places.push_back({{rect.left + left_mm, y, width * share, height},
                      map.from_m + static_cast<double>(strip.row_begin) * map.step_s_m,
                      map.from_m + static_cast<double>(strip.row_end) * map.step_s_m});
    y += height + below_mm + rounds_mm;
  }
  return places;
}

void draw_deviation_map(Canvas& canvas, const Rect& rect, const DeviationMap& map, const DeviationScale& scale,
                        const MapTexts& texts) {
  const std::vector<Strip> strips = strips_of(map);
  const std::vector<MapStrip> places = map_strips(rect, map);
  if (places.empty()) {
    canvas.text(rect.centre(), "no deviation map",
                {.colour = colours::grey, .across = Across::centre, .down = Down::middle});
    return;
  }
  for (std::size_t i = 0; i < strips.size(); ++i) draw_strip(canvas, places[i], map, strips[i], scale, texts);
  const double below = places.back().rect.bottom() + below_mm;
  canvas.text({places.front().rect.centre().x(), below - below_mm + 4.4}, "chainage [m]",
              {.size_mm = text_mm, .colour = colours::grey, .across = Across::centre});
  draw_legend(canvas, {rect.left, below, rect.width, legend_mm}, scale, texts);
}

std::vector<LineMark> line_marks(const DesignTunnel& design, const DeviationMap& map) {
  const Profile& profile = design.profile_at((map.from_m + map.to_m) / 2.0);
  const ProfileStretch stretch(profile);
  const double half = profile.length_m() / 2.0;
  const auto q_at = [&](double p) {
    ProfileFoot foot;
    foot.p_m = p;
    return stretch.q_of(foot);
  };
  std::vector<LineMark> marks{{q_at(0.0), "crown 0", true}};
  const Ticks ticks = nice_ticks(-half, half, 12);
  for (double p : ticks.values)
    if (p != 0.0) marks.push_back({q_at(p), with_sign(p, ticks.decimals), false});
  for (const ProfileCorner& corner : profile.corners())
    marks.push_back({q_at(corner.p_m), "corner " + with_sign(corner.p_m, 1), true});
  std::sort(marks.begin(), marks.end(), [](const LineMark& a, const LineMark& b) { return a.q_m < b.q_m; });
  return marks;
}

}  // namespace adit::render
