#include <algorithm>
#include <cmath>

#include "core/foundation/options.h"
#include "render/number_text.h"
#include "render/report_pages.h"
#include "render/ring_drawing.h"

namespace adit::render {
namespace {

constexpr int across = 3, down = 4;

std::string known(double value, int decimals) {
  return std::isfinite(value) ? fixed(value, decimals) : std::string("\u2013");
}

std::string how_fitted(const JobRings& job, const RingsResult& result) {
  const RingDesign& design = job.design;
  std::string words =
      "Each ring's plane is the one that fits its points best; in it the circle of least squares. The centre is compared "
      "with the axis";
  if (design.center_offset_m != 0.0 || design.center_height_m != 0.0)
    words += ", " + with_sign(design.center_offset_m, 3) + " m to the right and " +
             with_sign(design.center_height_m, 3) + " m up";
  words +=
      ": right and up positive, looking up-chainage. Radii are those of the surface: the target offset is added. "
      "Ovality is the largest less the smallest diameter of the best ellipse.";
  if (design.radius_m > 0.0 && !result.rings.empty()) {
    double mean = 0.0;
    for (const RingResult& ring : result.rings) mean += ring.radius_m / static_cast<double>(result.rings.size());
    words += " Design radius " + fixed(design.radius_m, 4) + " m; the rings have " +
             with_sign(1e3 * (mean - design.radius_m), 1) + " mm on average.";
  }
  if (design.tolerance_m > 0.0)
    words += " The centre may lie off by " + fixed(1e3 * design.tolerance_m, 1) +
             " mm to the side and in height; beyond that it is red, and broken where two sigmas do not explain it.";
  return words;
}

TableCell off_mm(double deviation_m, const RingResult& ring, double tolerance_m) {
  const bool beyond = tolerance_m > 0.0 && std::abs(deviation_m) > tolerance_m;
  return {with_sign(1e3 * deviation_m, 1), beyond ? colours::red : colours::black,
          beyond && ring.verdict == ToleranceVerdict::broken};
}

Table ring_table(const RingsResult& result, const RingDesign& design) {
  const double design_radius_m = design.radius_m;
  Table table{{{"ring", 16, false},
               {"chainage m", 20, true},
               {"station m", 20, true},
               {"east m", 25, true},
               {"north m", 26, true},
               {"elev. m", 19, true},
               {"hor. mm", 15, true},
               {"vert. mm", 15, true},
               {"\u00b1 2\u03c3 mm", 14, true},
               {"radius m", 18, true},
               {"ovality mm", 16, true},
               {"rms mm", 13, true},
               {"n", 8, true}},
              {},
              2.1};
  if (design_radius_m > 0.0) table.columns.insert(table.columns.begin() + 10, {"\u0394R mm", 13, true});
  for (const RingResult& r : result.rings) {
    std::vector<TableCell> row{r.ring,
                               fixed(r.chainage_m, 3),
                               fixed(r.station_m, 3),
                               fixed(r.center.x(), 3),
                               fixed(r.center.y(), 3),
                               fixed(r.center.z(), 3),
                               off_mm(r.horizontal_deviation_m, r, design.tolerance_m),
                               off_mm(r.vertical_deviation_m, r, design.tolerance_m),
                               known(2e3 * r.sigma_center_m, 1),
                               fixed(r.radius_m, 4),
                               known(1e3 * r.ovality_m, 1),
                               fixed(1e3 * r.rms_m, 1),
                               std::to_string(r.residuals.size())};
    if (design_radius_m > 0.0) row.insert(row.begin() + 10, with_sign(1e3 * (r.radius_m - design_radius_m), 1));
    table.rows.push_back(std::move(row));
  }
  return table;
}

void add_drawings(PageFlow& flow, const RingsResult& result) {
  double largest_m = 0.0;
  for (const RingResult& ring : result.rings)
    for (const RingResidual& residual : ring.residuals) largest_m = std::max(largest_m, std::abs(residual.residual_m));
  flow.start("Rings: residuals");
  flow.paragraph(
      "Looking up-chainage; residuals from the best circle in mm, outside red, inside blue, drawn on one scale "
      "in all rings.",
      colours::black, 2.4);
  const double width = flow.width_mm() / across;
  const double height = (a4_height_mm - 60.0) / down;
  for (std::size_t i = 0; i < result.rings.size(); i += across) {
    const Rect row = flow.take(height);
    for (std::size_t k = i; k < std::min(i + across, result.rings.size()); ++k)
      draw_ring(flow.canvas(), {row.left + static_cast<double>(k - i) * width, row.top, width, height}, result.rings[k],
                largest_m);
  }
}

}  // namespace

void add_ring_pages(PageFlow& flow, const ReportContent& content) {
  if (!content.results->rings || !content.job->rings) return;
  const RingsResult& result = *content.results->rings;
  flow.start("Rings against the axis");
  flow.paragraph(how_fitted(*content.job->rings, result), colours::black, 2.4);
  if (result.rings.empty()) {
    flow.paragraph("No ring could be fitted.", colours::red);
    return;
  }
  const Rect chart = flow.take(85.0);
  draw_ring_deviations(flow.canvas(), chart, result.rings);
  flow.table(ring_table(result, content.job->rings->design));
  add_drawings(flow, result);
}

}  // namespace adit::render
