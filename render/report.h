#pragma once
// The report of a job: a PDF and its pictures, as bytes.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/foundation/progress.h"
#include "core/georeference/control.h"
#include "core/job/job.h"
#include "core/job/results.h"
#include "core/profiling/deviation_map.h"
#include "core/surface/mesh.h"
#include "render/gl_context.h"
#include "render/overlap_drawing.h"

namespace adit::render {

/// A thinned scan for the 3D pictures, local frame [m] (site minus project origin).
struct OverviewCloud {
  std::string name;
  std::vector<Eigen::Vector3f> points;
};

/// All a report is drawn from. job and results must be there; the rest may be absent and is then left out of the
/// report, with a line that says so. Everything but job and results.sections[].axis_site is in the local frame.
struct ReportContent {
  const Job* job = nullptr;
  const Results* results = nullptr;
  const DesignTunnel* design = nullptr;
  const DeviationMap* map = nullptr;
  const DeviationMap* change = nullptr;  ///< thickness between the earlier job and this one
  const MeshArrays* mesh = nullptr;
  std::vector<float> mesh_deviations_m;  ///< one for each mesh point, NaN where unknown; or empty
  std::vector<OverviewCloud> clouds;
  std::vector<PairSection> pair_sections;  ///< of used pairs, the worst first
  std::vector<ControlPoint> control;       ///< local frame
  std::vector<ControlPoint> landmarks;     ///< those that pictures show; local frame
  std::string date = "2000-01-01";         ///< ISO 8601, fixed by the caller: the same content gives the same bytes
};

struct ReportPicture {
  std::string name;  ///< "map.png"
  std::string png;
};

struct ReportFiles {
  std::string pdf;
  std::vector<ReportPicture> pictures;
};

/// Draws everything. Cancel is checked between pages and pictures (longest gap: one 3D picture, about half a second per
/// million overview points). Throws Error when the date is not ISO 8601 or job or results are missing.
ReportFiles draw_report(const ReportContent& content, const GlContext& context, Progress& progress);

}  // namespace adit::render
