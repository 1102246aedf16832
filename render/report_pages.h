#pragma once
// The pages of a report, in their order; one file each in report_pages/.

#include <vector>

#include "render/deviation_map_drawing.h"
#include "render/page.h"
#include "render/report.h"
#include "render/report_views.h"

namespace adit::render {

void add_title_page(PageFlow& flow, const ReportContent& content, const std::vector<ReportView>& views);
void add_registration_pages(PageFlow& flow, const ReportContent& content);
void add_chainage_pages(PageFlow& flow, const ReportContent& content);
void add_volume_pages(PageFlow& flow, const ReportContent& content);
void add_review_pages(PageFlow& flow, const ReportContent& content);
void add_comparison_pages(PageFlow& flow, const ReportContent& content);
void add_ring_pages(PageFlow& flow, const ReportContent& content);
void add_map_page(PageFlow& flow, const ReportContent& content);
void add_view_pages(PageFlow& flow, const std::vector<ReportView>& views);
void add_section_pages(PageFlow& flow, const ReportContent& content, const Progress& progress);
void add_provenance_pages(PageFlow& flow, const ReportContent& content);

/// What stands around the map of thickness between two jobs.
MapTexts layer_texts(const ReportContent& content);

/// The sections that get a drawing: all of them, or evenly chosen ones when there are more than 200.
std::vector<const Section*> drawn_sections(const ReportContent& content);

/// Words for every part this report lacks.
std::vector<std::string> absent_parts(const ReportContent& content);

/// Rows of findings: subject, words, mend; decisions in red.
Table findings_table(const Findings& findings);

/// True for a job of rings without scans.
bool is_of_rings_alone(const Results& results);

/// True when no one needs to look: the registration is accepted and no finding asks for a decision.
bool is_accepted(const Results& results);

}  // namespace adit::render
