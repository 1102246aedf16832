#include "render/number_text.h"
#include "render/report_pages.h"
#include "render/section_drawing.h"

namespace adit::render {
namespace {

constexpr std::size_t most_drawn = 200;
constexpr std::size_t columns = 2;
constexpr std::size_t rows = 3;

}  // namespace

std::vector<const Section*> drawn_sections(const ReportContent& content) {
  std::vector<const Section*> drawn;
  if (!content.results->profile) return drawn;
  const auto& sections = content.results->profile->sections;
  const std::size_t step = (sections.size() + most_drawn - 1) / most_drawn;
  for (std::size_t i = 0; i < sections.size(); i += step) drawn.push_back(&sections[i]);
  return drawn;
}

void add_section_pages(PageFlow& flow, const ReportContent& content, const Progress& progress) {
  const std::vector<const Section*> drawn = drawn_sections(content);
  if (drawn.empty()) return;
  flow.start("Section drawings");
  if (drawn.size() < content.results->profile->sections.size())
    flow.paragraph("Drawn: " + std::to_string(drawn.size()) + " of " +
                       std::to_string(content.results->profile->sections.size()) +
                       " sections, evenly chosen. The table holds all of them.",
                   colours::grey, 2.4);
  const double gap = 4.0;
  double row_height = 0.0;
  for (std::size_t i = 0; i < drawn.size(); i += columns) {
    progress.step(i, drawn.size());
    if (row_height == 0.0) row_height = flow.room().height / static_cast<double>(rows) - 0.01;
    const Rect row = flow.take(row_height);
    const double width = (row.width - gap) / static_cast<double>(columns);
    for (std::size_t k = 0; k < columns && i + k < drawn.size(); ++k) {
      const Section& section = *drawn[i + k];
      const std::vector<SectionLine> lines =
          content.design != nullptr ? section_lines(*content.design, section.chainage_m) : std::vector<SectionLine>{};
      draw_section(flow.canvas(), {row.left + static_cast<double>(k) * (width + gap), row.top, width, row_height - 3.0},
                   section, lines);
    }
  }
}

}  // namespace adit::render
