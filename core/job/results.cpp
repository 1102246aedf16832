#include "core/job/results.h"

#include <algorithm>

namespace adit {

Pose site_from_scan(const Results& results, std::size_t scan) {
  Pose pose = results.registration.scans[scan].local_from_scan;
  const Eigen::Vector3d offset =
      scan < results.import.scans.size() ? results.import.scans[scan].offset : Eigen::Vector3d::Zero();
  pose.translation() += results.import.origin.position - pose.linear() * offset;
  return pose;
}

Findings all_findings(const Results& results) {
  Findings all = results.import.findings;
  const auto add = [&](const Findings& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(results.targets.findings);
  add(results.registration.findings);
  if (results.surface) add(results.surface->findings);
  if (results.profile) add(results.profile->findings);
  if (results.volume) add(results.volume->findings);
  if (results.compare) add(results.compare->findings);
  if (results.rings) add(results.rings->findings);
  add(results.earlier);
  return all;
}

bool needs_a_person(const Results& results) {
  const Findings all = all_findings(results);
  return std::any_of(all.begin(), all.end(), [](const Finding& f) { return f.severity == Severity::decision; });
}

}  // namespace adit
