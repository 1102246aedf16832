#include "render/deviation_map_drawing.h"
#include "render/report_pages.h"

namespace adit::render {

void add_map_page(PageFlow& flow, const ReportContent& content) {
  if (content.map == nullptr || content.map->cells.empty()) return;
  flow.start("Deviation map");
  flow.paragraph(
      "The rock surface unrolled along the design line, as seen from above and opened at the floor. Deviation along "
      "the outward normal of the "
      "profile in the section: red is outside (overbreak), blue inside (underbreak).",
      colours::black, 2.4);
  flow.skip(1.0);
  const DeviationMap& map = *content.map;
  MapTexts texts{.line = "profile (offset 0)", .marks = {}, .rounds = content.job->rounds};
  if (content.design != nullptr) texts.marks = line_marks(*content.design, map);
  const double height = std::min(deviation_map_height(map, flow.width_mm()), flow.room().height);
  draw_deviation_map(flow.canvas(), flow.take(height), map, deviation_scale(seen_deviations(map)), texts);
}

}  // namespace adit::render
