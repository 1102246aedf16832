#include "render/page.h"

namespace adit::render {
namespace {

constexpr double left_mm = 18.0;
constexpr double right_mm = 14.0;
constexpr double head_mm = 12.0;  // of the page's head line
constexpr double body_top_mm = 22.0;
constexpr double body_bottom_mm = a4_height_mm - 18.0;
constexpr double inner_mm = a4_width_mm - left_mm - right_mm;
const Pen rule{colours::ink_blue, 0.4, {}};

}  // namespace

double PageFlow::width_mm() const {
  return inner_mm;
}

void PageFlow::draw_frame() {
  const double right = a4_width_mm - right_mm;
  const TextStyle small{.size_mm = 2.4, .colour = colours::grey};
  const auto aligned = [&](Across across, double shorten) {
    TextStyle style = small;
    style.across = across;
    style.shorten_mm = shorten;
    return style;
  };
  canvas_.text({left_mm, head_mm}, title_.job,
               {.size_mm = 2.8, .bold = true, .down = Down::bottom, .shorten_mm = 0.72 * inner_mm});
  TextStyle version = aligned(Across::right, 40.0);
  version.down = Down::bottom;
  canvas_.text({right, head_mm}, "Adit " + title_.version, version);
  canvas_.line({left_mm, head_mm + 1.0}, {right, head_mm + 1.0}, rule);
  const double foot = a4_height_mm - 13.5;
  canvas_.line({left_mm, foot - 1.2}, {right, foot - 1.2}, {colours::light_grey, 0.2, {}});
  canvas_.text({left_mm, foot}, title_.client.empty() ? "" : "Client: " + title_.client,
               aligned(Across::left, 0.36 * inner_mm));
  canvas_.text({left_mm + 0.38 * inner_mm, foot}, title_.surveyor.empty() ? "" : "Surveyor: " + title_.surveyor,
               aligned(Across::left, 0.34 * inner_mm));
  canvas_.text({left_mm + 0.80 * inner_mm, foot}, title_.date, aligned(Across::centre, 0.14 * inner_mm));
  canvas_.text({right, foot}, "page " + std::to_string(page_) + " of " + std::to_string(title_.pages),
               aligned(Across::right, 0.2 * inner_mm));
}

void PageFlow::next_page() {
  if (page_ > 0) canvas_.next_page();
  ++page_;
  draw_frame();
  y_ = body_top_mm;
  if (heading_.empty()) return;
  canvas_.text({left_mm, 16.0}, heading_ + (continued_ ? " (continued)" : ""),
               {.size_mm = 4.2, .colour = colours::ink_blue, .bold = true, .shorten_mm = inner_mm});
  y_ = body_top_mm + 2.5;
}

void PageFlow::start(const std::string& heading) {
  heading_ = heading;
  continued_ = false;
  next_page();
  continued_ = true;
}

Rect PageFlow::room() const {
  return {left_mm, y_, inner_mm, body_bottom_mm - y_};
}

Rect PageFlow::take(double height_mm) {
  if (y_ + height_mm > body_bottom_mm + 1e-9 && y_ > body_top_mm + 3.0) next_page();
  const Rect rect{left_mm, y_, inner_mm, height_mm};
  y_ += height_mm;
  return rect;
}

void PageFlow::subheading(const std::string& words, double keep_mm) {
  if (room().height < keep_mm) next_page();
  y_ += 2.0;
  canvas_.text({left_mm, y_}, words, {.size_mm = 3.1, .bold = true, .shorten_mm = inner_mm});
  y_ += 5.6;
}

void PageFlow::paragraph(const std::string& words, const Colour& colour, double text_mm, bool bold) {
  const TextStyle style{.size_mm = text_mm, .colour = colour, .bold = bold, .wrap_mm = inner_mm};
  const Rect rect = take(canvas_.text_size(words, style).y() + 1.2);
  canvas_.text({rect.left, rect.top}, words, style);
}

void PageFlow::table(Table table) {
  stretch_to(table, inner_mm);
  std::size_t row = 0;
  do {
    // On a fresh page a row higher than the page is drawn all the same; otherwise it would never end.
    const bool fresh = y_ <= body_top_mm + 3.0;
    const TablePart part = draw_table(canvas_, {left_mm, y_}, table, row, room().height, fresh);
    y_ += part.height_mm;
    const bool stuck = part.next_row == row && row < table.rows.size();
    row = part.next_row;
    if (row < table.rows.size() || stuck) next_page();
  } while (row < table.rows.size());
  y_ += 3.0;
}

}  // namespace adit::render
