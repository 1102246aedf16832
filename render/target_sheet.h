#pragma once
// Coded targets on paper.

#include <string>
#include <vector>

#include "core/georeference/coded_pattern.h"
#include "render/canvas.h"

namespace adit::render {

/// A sheet of paper, upright [mm].
struct PaperSize {
  std::string name = "A4";
  double width_mm = 210.0;
  double height_mm = 297.0;
};
/// A5 to A0, Letter, Legal, Tabloid; throws Error for other names.
PaperSize paper_size(const std::string& name);

/// The pattern alone, its ring of segments diameter_mm wide.
void draw_target(Canvas& canvas, const PaperPoint& centre, double diameter_mm, TargetCode code);

/// Pages of targets, as many a page as fit with crop marks, id, code and a ruler to check the printer by. Throws Error
/// when one does not fit the paper.
std::string target_pages(const std::vector<int>& ids, double diameter_mm, const PaperSize& paper,
                         const DocumentTitle& title);

/// A board of targets for calibration: one page, `columns` x `rows` of them evenly over the paper, the first ids row by
/// row. Throws Error when they do not fit, or when there are not so many ids.
struct TargetBoard {
  std::string pdf;
  std::vector<PaperPoint> centres_mm;  ///< from the first target: right and up, in order of `ids`
};
TargetBoard target_board(const std::vector<int>& ids, int columns, int rows, double diameter_mm, const PaperSize& paper,
                         const DocumentTitle& title);

}  // namespace adit::render
