#pragma once
// A drawing surface in millimetres on paper: the same drawing code gives PDF pages, SVG and pictures.

#include <Eigen/Geometry>

#include <memory>
#include <string>
#include <vector>

#include "render/colour.h"
#include "render/picture.h"

namespace adit::render {

/// A place on the paper [mm]: x to the right, y down, from the upper left corner.
using PaperPoint = Eigen::Vector2d;
using PaperRing = std::vector<PaperPoint>;

/// A rectangle on the paper [mm].
struct Rect {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  PaperPoint centre() const { return {left + width / 2.0, top + height / 2.0}; }
  /// Smaller by a margin on every side.
  Rect inset(double margin) const { return {left + margin, top + margin, width - 2.0 * margin, height - 2.0 * margin}; }
};

struct Pen {
  Colour colour = colours::black;
  double width_mm = 0.25;
  std::vector<double> dashes_mm;  ///< on, off, on, ...; empty: solid
};

enum class Across { left, centre, right };
enum class Down { top, middle, bottom };

/// How text stands about the point it is given: the box of the text is left of, centred on or right of it.
struct TextStyle {
  double size_mm = 2.8;  ///< of the letters' em square
  Colour colour = colours::black;
  bool bold = false;
  Across across = Across::left;  ///< which side of the text lies at the point
  Down down = Down::top;
  double turn_rad = 0.0;    ///< clockwise on the paper, about the point
  double wrap_mm = 0.0;     ///< lines are broken at this width; 0: never
  double shorten_mm = 0.0;  ///< one line; wider text ends in an ellipsis; 0: never
  double halo_mm = 0.0;     ///< a white rim, so that text can be read on a picture
  Colour halo = colours::white;
};

/// What a document says about itself. date is ISO 8601 ("2024-05-31" or "2024-05-31T12:00:00Z") and comes from the
/// caller, so that the same drawing gives the same bytes.
struct DocumentTitle {
  std::string title;
  std::string author;
  std::string date = "2000-01-01T00:00:00Z";
};

/// Text is DejaVu Sans, plain (no markup), any UTF-8; broken UTF-8 is shown as replacement characters. After finish()
/// or picture() nothing more can be drawn.
class Canvas {
 public:
  /// A document of pages of one size. Throws Error when the date is not ISO 8601.
  static Canvas pdf(double width_mm, double height_mm, const DocumentTitle& title);
  static Canvas svg(double width_mm, double height_mm);
  /// White paper as a picture.
  static Canvas raster(double width_mm, double height_mm, double dots_per_inch);
  /// Draws on a copy of a picture; its size in mm follows from the resolution.
  static Canvas over(const Picture& picture, double dots_per_inch);

  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;
  ~Canvas();

  double width_mm() const;
  double height_mm() const;

  /// Ends the page (PDF).
  void next_page();

  void save();
  void restore();
  void translate(double right_mm, double down_mm);
  void rotate(double clockwise_rad);
  void clip(const Rect& rect);

  void line(const PaperPoint& from, const PaperPoint& to, const Pen& pen);
  void polyline(const PaperRing& points, const Pen& pen, bool closed = false);
  /// Rings are closed; overlapping ones are holes (even-odd).
  void fill(const std::vector<PaperRing>& rings, const Colour& colour);
  void hatch(const std::vector<PaperRing>& rings, const Pen& pen, double spacing_mm, double turn_rad);
  void fill(const Rect& rect, const Colour& colour);
  void frame(const Rect& rect, const Pen& pen);
  void disc(const PaperPoint& centre, double radius_mm, const Colour& colour);

  /// Width and height [mm] the text takes (unturned).
  Eigen::Vector2d text_size(const std::string& text, const TextStyle& style) const;
  void text(const PaperPoint& at, const std::string& text, const TextStyle& style);

  /// smooth: between pixels; otherwise every pixel stays a rectangle.
  void picture(const Picture& picture, const Rect& rect, bool smooth = true);

  /// The bytes of a PDF or SVG.
  std::string finish();
  /// The picture of a raster canvas.
  Picture finish_picture();

 private:
  struct Paper;
  explicit Canvas(std::unique_ptr<Paper> paper);
  std::unique_ptr<Paper> paper_;
};

/// Four corners of a rectangle as a ring.
PaperRing ring_of(const Rect& rect);

}  // namespace adit::render
