#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <regex>

#include "core/foundation/error.h"
#include "render/cairo_picture.h"
#include "render/canvas.h"

namespace adit::render {
namespace {

constexpr double points_per_mm = 72.0 / 25.4;

cairo_status_t append(void* closure, const unsigned char* bytes, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

void set_colour(cairo_t* cairo, const Colour& c) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, c.alpha);
}

void path_of(cairo_t* cairo, const PaperRing& points, bool closed) {
  for (const PaperPoint& p : points) cairo_line_to(cairo, p.x() * points_per_mm, p.y() * points_per_mm);
  if (closed) cairo_close_path(cairo);
  cairo_new_sub_path(cairo);
}

void stroke(cairo_t* cairo, const Pen& pen) {
  set_colour(cairo, pen.colour);
  cairo_set_line_width(cairo, pen.width_mm * points_per_mm);
  std::vector<double> dashes = pen.dashes_mm;
  for (double& dash : dashes) dash *= points_per_mm;
  cairo_set_dash(cairo, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_stroke(cairo);
}

using Layout = std::unique_ptr<PangoLayout, decltype(&g_object_unref)>;

// Hinting off and no rounding of glyph positions: the same line breaks on paper and in pictures.
Layout make_layout(cairo_t* cairo, const std::string& text, const TextStyle& style) {
  Layout layout(pango_cairo_create_layout(cairo), g_object_unref);
  PangoContext* context = pango_layout_get_context(layout.get());
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  pango_cairo_context_set_font_options(context, options);
  cairo_font_options_destroy(options);
  pango_context_set_round_glyph_positions(context, FALSE);
  PangoFontDescription* font = pango_font_description_new();
  pango_font_description_set_family_static(font, "DejaVu Sans");
  pango_font_description_set_weight(font, style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font, style.size_mm * points_per_mm * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  gchar* valid = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
  pango_layout_set_text(layout.get(), valid, -1);
  g_free(valid);
  if (style.shorten_mm > 0.0) {
    pango_layout_set_width(layout.get(), static_cast<int>(std::lround(style.shorten_mm * points_per_mm * PANGO_SCALE)));
    pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_END);
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  }
  if (style.wrap_mm > 0.0) {
    pango_layout_set_width(layout.get(), static_cast<int>(std::lround(style.wrap_mm * points_per_mm * PANGO_SCALE)));
    pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
    pango_layout_set_alignment(layout.get(), style.across == Across::right    ? PANGO_ALIGN_RIGHT
                                             : style.across == Across::centre ? PANGO_ALIGN_CENTER
                                                                              : PANGO_ALIGN_LEFT);
  }
  return layout;
}

double share_across(Across across) {
  return across == Across::left ? 0.0 : across == Across::centre ? 0.5 : 1.0;
}
double share_down(Down down) {
  return down == Down::top ? 0.0 : down == Down::middle ? 0.5 : 1.0;
}

}  // namespace

struct Canvas::Paper {
  double width_mm = 0.0;
  double height_mm = 0.0;
  bool is_picture = false;
  std::string bytes;
  cairo_surface_t* surface = nullptr;
  cairo_t* cairo = nullptr;

  Paper(double width, double height) : width_mm(width), height_mm(height) {}
  Paper(const Paper&) = delete;
  Paper& operator=(const Paper&) = delete;
  ~Paper() {
    if (cairo != nullptr) cairo_destroy(cairo);
    if (surface != nullptr) cairo_surface_destroy(surface);
  }
  void open() {
    cairo = cairo_create(surface);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  }
};

Canvas::Canvas(std::unique_ptr<Paper> paper) : paper_(std::move(paper)) {
  paper_->open();
}
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

Canvas Canvas::pdf(double width_mm, double height_mm, const DocumentTitle& title) {
  static const std::regex iso(R"(\d{4}-\d{2}-\d{2}(T\d{2}:\d{2}(:\d{2})?(Z|[+-]\d{2}:\d{2})?)?)");
  // Without a valid date cairo writes the present time, and no two runs give the same bytes.
  if (!std::regex_match(title.date, iso))
    throw Error("a document needs an ISO 8601 date, found \"" + title.date + "\"", {}, "write it as 2024-05-31");
  auto paper = std::make_unique<Paper>(width_mm, height_mm);
  paper->surface =
      cairo_pdf_surface_create_for_stream(append, &paper->bytes, width_mm * points_per_mm, height_mm * points_per_mm);
  cairo_pdf_surface_set_metadata(paper->surface, CAIRO_PDF_METADATA_TITLE, title.title.c_str());
  cairo_pdf_surface_set_metadata(paper->surface, CAIRO_PDF_METADATA_AUTHOR, title.author.c_str());
  cairo_pdf_surface_set_metadata(paper->surface, CAIRO_PDF_METADATA_CREATOR, "Adit");
  cairo_pdf_surface_set_metadata(paper->surface, CAIRO_PDF_METADATA_CREATE_DATE, title.date.c_str());
  return Canvas(std::move(paper));
}

Canvas Canvas::svg(double width_mm, double height_mm) {
  auto paper = std::make_unique<Paper>(width_mm, height_mm);
  paper->surface =
      cairo_svg_surface_create_for_stream(append, &paper->bytes, width_mm * points_per_mm, height_mm * points_per_mm);
  return Canvas(std::move(paper));
}

Canvas Canvas::raster(double width_mm, double height_mm, double dots_per_inch) {
  const double scale = dots_per_inch / 25.4;
  const auto pixels = [&](double mm) { return static_cast<int>(std::lround(mm * scale)); };
  return over(blank_picture(pixels(width_mm), pixels(height_mm)), dots_per_inch);
}

Canvas Canvas::over(const Picture& picture, double dots_per_inch) {
  auto paper = std::make_unique<Paper>(picture.width * 25.4 / dots_per_inch, picture.height * 25.4 / dots_per_inch);
  paper->is_picture = true;
  paper->surface = cairo_surface_of(picture);
  Canvas canvas(std::move(paper));
  cairo_scale(canvas.paper_->cairo, dots_per_inch / 72.0, dots_per_inch / 72.0);
  return canvas;
}

double Canvas::width_mm() const {
  return paper_->width_mm;
}
double Canvas::height_mm() const {
  return paper_->height_mm;
}

void Canvas::next_page() {
  cairo_show_page(paper_->cairo);
}
void Canvas::save() {
  cairo_save(paper_->cairo);
}
void Canvas::restore() {
  cairo_restore(paper_->cairo);
}
void Canvas::translate(double right_mm, double down_mm) {
  cairo_translate(paper_->cairo, right_mm * points_per_mm, down_mm * points_per_mm);
}
void Canvas::rotate(double clockwise_rad) {
  cairo_rotate(paper_->cairo, clockwise_rad);
}

void Canvas::clip(const Rect& rect) {
  cairo_rectangle(paper_->cairo, rect.left * points_per_mm, rect.top * points_per_mm, rect.width * points_per_mm,
                  rect.height * points_per_mm);
  cairo_clip(paper_->cairo);
}

void Canvas::line(const PaperPoint& from, const PaperPoint& to, const Pen& pen) {
  polyline({from, to}, pen);
}

void Canvas::polyline(const PaperRing& points, const Pen& pen, bool closed) {
  path_of(paper_->cairo, points, closed);
  stroke(paper_->cairo, pen);
}

void Canvas::fill(const std::vector<PaperRing>& rings, const Colour& colour) {
  for (const PaperRing& ring : rings) path_of(paper_->cairo, ring, true);
  set_colour(paper_->cairo, colour);
  cairo_fill(paper_->cairo);
}

void Canvas::fill(const Rect& rect, const Colour& colour) {
  fill({ring_of(rect)}, colour);
}
void Canvas::frame(const Rect& rect, const Pen& pen) {
  polyline(ring_of(rect), pen, true);
}

void Canvas::hatch(const std::vector<PaperRing>& rings, const Pen& pen, double spacing_mm, double turn_rad) {
  Eigen::AlignedBox2d box;
  for (const PaperRing& ring : rings)
    for (const PaperPoint& p : ring) box.extend(p);
  if (box.isEmpty()) return;
  save();
  for (const PaperRing& ring : rings) path_of(paper_->cairo, ring, true);
  cairo_clip(paper_->cairo);
  const Eigen::Vector2d along(std::cos(turn_rad), std::sin(turn_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  const double reach = box.diagonal().norm() / 2.0;
  const int lines = static_cast<int>(std::ceil(reach / spacing_mm));
  // Whole multiples of the spacing from the paper's corner: neighbouring hatches meet.
  const double first = std::round(across.dot(box.center()) / spacing_mm);
  for (int i = -lines; i <= lines; ++i) {
    const PaperPoint foot = along * along.dot(box.center()) + across * ((first + i) * spacing_mm);
    path_of(paper_->cairo, {foot - along * reach, foot + along * reach}, false);
  }
  stroke(paper_->cairo, pen);
  restore();
}

void Canvas::disc(const PaperPoint& centre, double radius_mm, const Colour& colour) {
  cairo_new_path(paper_->cairo);
  cairo_arc(paper_->cairo, centre.x() * points_per_mm, centre.y() * points_per_mm, radius_mm * points_per_mm, 0.0,
            2.0 * M_PI);
  set_colour(paper_->cairo, colour);
  cairo_fill(paper_->cairo);
}

Eigen::Vector2d Canvas::text_size(const std::string& text, const TextStyle& style) const {
  const Layout layout = make_layout(paper_->cairo, text, style);
  PangoRectangle box;
  pango_layout_get_extents(layout.get(), nullptr, &box);
  return Eigen::Vector2d(box.width, box.height) / (PANGO_SCALE * points_per_mm);
}

void Canvas::text(const PaperPoint& at, const std::string& text, const TextStyle& style) {
  if (text.empty()) return;
  cairo_t* cairo = paper_->cairo;
  const Layout layout = make_layout(cairo, text, style);
  PangoRectangle box;
  pango_layout_get_extents(layout.get(), nullptr, &box);
  const double width =
      style.wrap_mm > 0.0 ? style.wrap_mm * points_per_mm : static_cast<double>(box.width) / PANGO_SCALE;
  const double height = static_cast<double>(box.height) / PANGO_SCALE;
  cairo_save(cairo);
  cairo_translate(cairo, at.x() * points_per_mm, at.y() * points_per_mm);
  cairo_rotate(cairo, style.turn_rad);
  cairo_move_to(cairo, -share_across(style.across) * width, -share_down(style.down) * height);
  if (style.halo_mm > 0.0) {
    double x = 0.0, y = 0.0;
    cairo_get_current_point(cairo, &x, &y);
    pango_cairo_layout_path(cairo, layout.get());
    stroke(cairo, {style.halo, 2.0 * style.halo_mm, {}});
    cairo_move_to(cairo, x, y);
  }
  set_colour(cairo, style.colour);
  pango_cairo_show_layout(cairo, layout.get());
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

void Canvas::picture(const Picture& picture, const Rect& rect, bool smooth) {
  if (picture.width == 0 || picture.height == 0) return;
  cairo_t* cairo = paper_->cairo;
  cairo_surface_t* image = cairo_surface_of(picture);
  cairo_save(cairo);
  cairo_translate(cairo, rect.left * points_per_mm, rect.top * points_per_mm);
  cairo_scale(cairo, rect.width * points_per_mm / picture.width, rect.height * points_per_mm / picture.height);
  cairo_set_source_surface(cairo, image, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo), smooth ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  // Without it the rim of a smoothed picture fades; documents leave that to the viewer.
  if (paper_->is_picture) cairo_pattern_set_extend(cairo_get_source(cairo), CAIRO_EXTEND_PAD);
  cairo_rectangle(cairo, 0.0, 0.0, picture.width, picture.height);
  cairo_fill(cairo);
  cairo_restore(cairo);
  cairo_surface_destroy(image);
}

std::string Canvas::finish() {
  if (paper_->is_picture) throw Error("a picture canvas has no document");
  cairo_surface_finish(paper_->surface);
  if (cairo_surface_status(paper_->surface) != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("a drawing could not be written: ") +
                cairo_status_to_string(cairo_surface_status(paper_->surface)));
  return std::move(paper_->bytes);
}

Picture Canvas::finish_picture() {
  if (!paper_->is_picture) throw Error("a document canvas has no picture");
  return picture_of(paper_->surface);
}

PaperRing ring_of(const Rect& rect) {
  return {{rect.left, rect.top}, {rect.right(), rect.top}, {rect.right(), rect.bottom()}, {rect.left, rect.bottom()}};
}

}  // namespace adit::render
