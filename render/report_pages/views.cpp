#include <algorithm>

#include "render/report_pages.h"

namespace adit::render {

void add_view_pages(PageFlow& flow, const std::vector<ReportView>& views) {
  if (views.empty()) return;
  flow.start("Views");
  for (const ReportView& view : views) {
    const double height = flow.width_mm() * view.picture.height / view.picture.width;
    const Rect rect = flow.take(height + 8.0);
    const Rect frame{rect.left, rect.top, rect.width, height};
    flow.canvas().picture(view.picture, frame);
    flow.canvas().frame(frame, {colours::light_grey, 0.2, {}});
    flow.canvas().text({rect.left, frame.bottom() + 1.0}, view.words,
                       {.size_mm = 2.4, .colour = colours::grey, .shorten_mm = rect.width});
  }
}

}  // namespace adit::render
