#pragma once
// A4 pages with a frame of facts: what the report flows onto.

#include <string>

#include "render/canvas.h"
#include "render/table_drawing.h"

namespace adit::render {

inline constexpr double a4_width_mm = 210.0;
inline constexpr double a4_height_mm = 297.0;

/// What stands on every page.
struct TitleBlock {
  std::string job;
  std::string client;
  std::string surveyor;
  std::string version;
  std::string date;
  int pages = 0;  ///< of the whole report; 0 while counting
};

/// Fills page after page from top to bottom. Nothing is drawn past the lower margin.
class PageFlow {
 public:
  PageFlow(Canvas& canvas, TitleBlock title) : canvas_(canvas), title_(std::move(title)) {}

  Canvas& canvas() { return canvas_; }
  int pages() const { return page_; }
  double width_mm() const;

  /// A new page under a heading; pages that the content runs on to repeat the heading with "continued".
  void start(const std::string& heading);

  /// What is left of the page.
  Rect room() const;
  /// The next `height_mm` of the page, of the next page when they do not fit any more.
  Rect take(double height_mm);
  void skip(double height_mm) { y_ += height_mm; }

  /// A smaller heading, kept together with at least keep_mm of what follows.
  void subheading(const std::string& words, double keep_mm = 25.0);
  void paragraph(const std::string& words, const Colour& colour = colours::black, double text_mm = 2.6,
                 bool bold = false);
  /// A table as wide as the page, split where needed, its header repeated.
  void table(Table table);

 private:
  void next_page();
  void draw_frame();

  Canvas& canvas_;
  TitleBlock title_;
  std::string heading_;
  bool continued_ = false;
  int page_ = 0;
  double y_ = 0.0;
};

}  // namespace adit::render
