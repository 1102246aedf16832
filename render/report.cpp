#include "render/report.h"

#include "core/foundation/error.h"
#include "render/deviation_map_drawing.h"
#include "render/face_drawing.h"
#include "render/number_text.h"
#include "render/report_pages.h"
#include "render/section_drawing.h"
#include "render/volume_chart.h"

namespace adit::render {
namespace {

constexpr double picture_dpi = 150.0;

// Draws all pages; returns how many there were.
int draw_pages(Canvas& canvas, const ReportContent& content, const std::vector<ReportView>& views, int pages,
               const Progress& progress) {
  const Job& job = *content.job;
  PageFlow flow(canvas, {job.name, job.client, job.surveyor, content.results->version, content.date, pages});
  const auto then = [&](const auto& add_pages) {  // a cancel is heard between the parts
    progress.check();
    add_pages();
  };
  then([&] { add_title_page(flow, content, views); });
  if (!is_of_rings_alone(*content.results)) then([&] { add_registration_pages(flow, content); });
  then([&] { add_volume_pages(flow, content); });
  then([&] { add_review_pages(flow, content); });
  then([&] { add_chainage_pages(flow, content); });
  then([&] { add_comparison_pages(flow, content); });
  then([&] { add_ring_pages(flow, content); });
  then([&] { add_map_page(flow, content); });
  then([&] { add_view_pages(flow, views); });
  add_section_pages(flow, content, progress);
  add_provenance_pages(flow, content);
  return flow.pages();
}

std::string report_pdf(const ReportContent& content, const std::vector<ReportView>& views, Progress& progress) {
  const DocumentTitle title{content.job->name, content.job->surveyor, content.date};
  const auto paper = [&] { return Canvas::pdf(a4_width_mm, a4_height_mm, title); };
  // "page n of m": the first pass only counts.
  Canvas counting = paper();
  const int pages = draw_pages(counting, content, views, 0, progress.part(0.5, "counting pages"));
  Canvas canvas = paper();
  draw_pages(canvas, content, views, pages, progress.part(0.5, "drawing pages"));
  return canvas.finish();
}

Picture map_picture(const ReportContent& content) {
  const double width = 270.0, margin = 4.0;
  const double height = deviation_map_height(*content.map, width);
  Canvas canvas = Canvas::raster(width + 2.0 * margin, height + 2.0 * margin, picture_dpi);
  MapTexts texts{.line = "profile (offset 0)", .marks = {}, .rounds = content.job->rounds};
  if (content.design != nullptr) texts.marks = line_marks(*content.design, *content.map);
  draw_deviation_map(canvas, {margin, margin, width, height}, *content.map,
                     deviation_scale(seen_deviations(*content.map)), texts);
  return canvas.finish_picture();
}

Picture layer_picture(const ReportContent& content) {
  const double width = 270.0, margin = 4.0;
  const double height = deviation_map_height(*content.change, width);
  Canvas canvas = Canvas::raster(width + 2.0 * margin, height + 2.0 * margin, picture_dpi);
  draw_deviation_map(canvas, {margin, margin, width, height}, *content.change,
                     deviation_scale(seen_deviations(*content.change)), layer_texts(content));
  return canvas.finish_picture();
}

Picture face_picture(const ReportContent& content) {
  Canvas canvas = Canvas::raster(120.0, 110.0, picture_dpi);
  const FaceMap& face = content.results->compare->face;
  draw_face(
      canvas, {4.0, 3.0, 112.0, 104.0}, "Face", face,
      content.design != nullptr ? section_lines(*content.design, summarise(face).mean_m) : std::vector<SectionLine>{});
  return canvas.finish_picture();
}

Picture chart_picture(const ReportContent& content) {
  Canvas canvas = Canvas::raster(240.0, 105.0, picture_dpi);
  draw_volume_chart(canvas, {4.0, 3.0, 232.0, 99.0}, content.results->profile->sections, content.job->rounds);
  return canvas.finish_picture();
}

Picture section_picture(const ReportContent& content, const Section& section) {
  Canvas canvas = Canvas::raster(130.0, 120.0, picture_dpi);
  const auto lines =
      content.design != nullptr ? section_lines(*content.design, section.chainage_m) : std::vector<SectionLine>{};
  draw_section(canvas, {4.0, 3.0, 122.0, 114.0}, section, lines);
  return canvas.finish_picture();
}

std::string section_file(const Section& section) {
  std::string number = fixed(section.chainage_m, 2);
  if (section.chainage_m < 0.0) number = "-" + fixed(-section.chainage_m, 2);  // plain ASCII in a file's name
  return "section_" + number + ".png";
}

}  // namespace

ReportFiles draw_report(const ReportContent& content, const GlContext& context, Progress& progress) {
  if (content.job == nullptr || content.results == nullptr) throw Error("a report needs a job and its results");
  ReportFiles files;
  const auto add = [&](const std::string& name, const Picture& picture) {
    files.pictures.push_back({name, png_bytes(picture)});
  };
  Progress viewing = progress.part(0.4, "3D pictures");
  const std::vector<ReportView> views = draw_views(content, context, viewing);
  for (const ReportView& view : views) add(view.name, view.picture);
  Progress paging = progress.part(0.4, "report");
  files.pdf = report_pdf(content, views, paging);
  progress.check();
  if (content.map != nullptr && !content.map->cells.empty()) add("map.png", map_picture(content));
  progress.check();
  if (content.change != nullptr && !content.change->cells.empty()) add("layer.png", layer_picture(content));
  if (content.results->compare && !content.results->compare->face.cells.empty()) add("face.png", face_picture(content));
  progress.check();
  if (content.results->profile && !content.results->profile->sections.empty())
    add("volumes.png", chart_picture(content));
  const Progress drawing = progress.part(0.2, "section drawings");
  const std::vector<const Section*> sections = drawn_sections(content);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    drawing.step(i, sections.size());
    add(section_file(*sections[i]), section_picture(content, *sections[i]));
  }
  progress.check();
  return files;
}

}  // namespace adit::render
