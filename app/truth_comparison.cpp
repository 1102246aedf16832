#include "app/truth_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/statistics.h"

namespace adit::app {

TruthComparison compare_with_truth(const Results& results, const Truth& truth) {
  TruthComparison comparison;
  comparison.true_volume = truth.volume;
  for (std::size_t i = 0; i < results.registration.scans.size(); ++i) {
    for (std::size_t k = 0; k < truth.scan_names.size(); ++k) {
      if (truth.scan_names[k] != results.registration.scans[i].name || !results.registration.scans[i].placed) continue;
      const Pose pose = site_from_scan(results, i);
      comparison.worst_position_error_m =
          std::max(comparison.worst_position_error_m, distance_between_m(pose, truth.site_from_scan[k]));
      comparison.worst_rotation_error_rad =
          std::max(comparison.worst_rotation_error_rad, rotation_between_rad(pose, truth.site_from_scan[k]));
    }
  }
  // The truth is that of vertical planes.
  const bool vertical = results.profile && !results.profile->sections.empty() &&
                        results.profile->sections.front().plane == SectionPlane::vertical;
  if (results.volume && !results.volume->lines.empty()) {
    const Volume& volume = results.volume->lines.front();
    const bool same_stretch =
        std::abs(volume.from_m - truth.from_m) < 1e-6 && std::abs(volume.to_m - truth.to_m) < 1e-6;
    const bool same_design = std::abs(volume.slices.design_m3 / truth.volume.design_m3 - 1.0) < 1e-3;
    if (same_stretch && same_design && vertical && volume.line_offset_m == 0.0) {
      comparison.excavated_error = volume.slices.excavated_m3 / truth.volume.excavated_m3 - 1.0;
      comparison.overbreak_error = volume.slices.overbreak_m3 / truth.volume.overbreak_m3 - 1.0;
      comparison.underbreak_error_m3 = volume.slices.underbreak_m3 - truth.volume.underbreak_m3;
    }
  }
  if (vertical) {
    std::vector<double> errors;
    for (const Section& section : results.profile->sections)
      for (const TrueSection& known : truth.sections)
        if (std::abs(known.chainage_m - section.chainage_m) < 1e-6 && section.lines.front().line_offset_m == 0.0)
          errors.push_back(section.lines.front().area_m2 / known.area_m2 - 1.0);
    if (!errors.empty()) comparison.section_area_rms = root_mean_square(errors);
  }
  return comparison;
}

}  // namespace adit::app
