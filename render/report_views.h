#pragma once
// The 3D pictures of a report.

#include <optional>
#include <vector>

#include "core/foundation/progress.h"
#include "render/picture.h"
#include "render/report.h"

namespace adit::render {

/// A picture, its file name and the words beneath it.
struct ReportView {
  std::string name;
  std::string words;
  Picture picture;
};

/// scans_above.png and scans_along.png where there are clouds, deviation_above.png and deviation_along.png where there
/// is a mesh.
std::vector<ReportView> draw_views(const ReportContent& content, const GlContext& context, Progress& progress);

/// The axis as far as the sections know it, local frame, in order of chainage.
std::vector<Eigen::Vector3d> local_axis(const ReportContent& content);

}  // namespace adit::render
