#include "core/foundation/options.h"
#include "render/number_text.h"
#include "render/report_pages.h"

namespace adit::render {
namespace {

constexpr const char* conventions[] = {
    "Sections are vertical planes square to the plan tangent of the axis; chainage is the length along the plan axis "
    "(internal, without station equations).",
    "Offset x is positive to the right looking up-chainage, height z positive above the grade line.",
    "Deviation is measured along the outward normal of the design line in the section: positive outside (overbreak), "
    "negative inside (underbreak).",
    "p is the arc length along the design line from the crown, clockwise looking up-chainage: negative on the left, "
    "positive on the right.",
    "Volumes: slices of thickness ds hold ds times the double integral of (1 \u2212 k x) dx dz over the over- and "
    "underbreak areas, k being the plan curvature (right "
    "positive). Where nothing was seen the rock is taken to lie on the line.",
    "Poses are site-from-scan. Site coordinates are east, north, elevation in metres.",
    "Uncertainties are one standard deviation unless two (2\u03c3) are named."};

void add_inputs(PageFlow& flow, const ImportResult& import) {
  flow.subheading("Files read");
  if (import.inputs.empty()) {
    flow.paragraph("None recorded.", colours::grey);
    return;
  }
  Table table{{{"file", 62, false}, {"points", 24, true}, {"SHA-256", 92, false}}, {}, 2.0};
  for (const InputRecord& input : import.inputs)
    table.rows.push_back({input.file, input.points > 0 ? grouped(input.points) : "", input.sha256});
  flow.table(table);
  flow.paragraph("Project origin: E " + fixed(import.origin.position.x(), 0) + "  N " +
                     fixed(import.origin.position.y(), 0) + "  H " + fixed(import.origin.position.z(), 0) +
                     " m. Everything inside the program is site minus this.",
                 colours::black, 2.4);
}

void add_notes(PageFlow& flow, const Results& results) {
  Findings notes;
  for (const Finding& f : all_findings(results))
    if (f.severity == Severity::note) notes.push_back(f);
  if (notes.empty()) return;
  flow.subheading("Notes");
  flow.table(findings_table(notes));
}

void add_options(PageFlow& flow, const Job& job) {
  flow.subheading("Settings");
  Table table{
      {{"group", 24, false}, {"setting", 38, false}, {"value", 18, true}, {"unit", 12, false}, {"meaning", 88, false}},
      {},
      2.1};
  for_each_group(job.options, [&](const char* group, const auto& options) {
    for (const OptionRow& row : option_rows(group, options))
      table.rows.push_back({row.group, row.name, row.value, row.unit, row.help});
  });
  flow.table(table);
}

void add_mesh(PageFlow& flow, const Results& results) {
  if (!results.surface) return;
  const MeshSummary& m = results.surface->mesh;
  flow.subheading("Surface mesh");
  Table table{{{"points", 20, true},
               {"triangles", 20, true},
               {"area m\u00b2", 20, true},
               {"mean edge m", 20, true},
               {"pieces", 16, true},
               {"open rims", 18, true},
               {"holes m", 18, true},
               {"mean deviation m", 25, true},
               {"spread m", 20, true}},
              {},
              2.3};
  table.rows.push_back({grouped(m.points), grouped(m.triangles), fixed(m.area_m2, 1), fixed(m.mean_edge_m, 3),
                        grouped(m.components), grouped(m.boundary_loops), fixed(m.holes_m, 1),
                        with_sign(m.mean_deviation_m, 3), fixed(m.sigma_deviation_m, 3)});
  flow.table(table);
}

}  // namespace

std::vector<std::string> absent_parts(const ReportContent& content) {
  const Results& results = *content.results;
  std::vector<std::string> absent;
  if (is_of_rings_alone(results)) return {"scans, and all that is made of them"};
  if (results.registration.pairs.empty()) absent.push_back("pairs of scans (one scan, or none that overlap)");
  if (results.registration.control.empty()) absent.push_back("control (no targets on control points)");
  if (content.design == nullptr) absent.push_back("design lines (nothing was compared with a design)");
  if (!results.profile || results.profile->sections.empty()) absent.push_back("sections (no profile step)");
  if (content.map == nullptr || content.map->cells.empty()) absent.push_back("deviation map");
  if (!results.volume || results.volume->lines.empty()) absent.push_back("volumes (no volume step)");
  if (content.mesh == nullptr || content.mesh->triangles.empty()) absent.push_back("surface mesh");
  if (content.clouds.empty()) absent.push_back("pictures of the scans");
  return absent;
}

void add_provenance_pages(PageFlow& flow, const ReportContent& content) {
  flow.start("Provenance");
  flow.paragraph("Made by Adit " + content.results->version + ". The same files and settings give the same numbers.",
                 colours::black, 2.6, true);
  add_inputs(flow, content.results->import);
  add_notes(flow, *content.results);
  add_mesh(flow, *content.results);
  flow.subheading("Conventions");
  for (const char* words : conventions) flow.paragraph(std::string("\u2022 ") + words, colours::black, 2.4);
  add_options(flow, *content.job);
}

}  // namespace adit::render
