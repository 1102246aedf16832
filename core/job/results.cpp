#include "core/job/results.h"

#include <algorithm>

namespace adit {

Findings all_findings(const Results& results) {
  Findings all = results.import.findings;
  const auto add = [&](const Findings& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(results.registration.findings);
  if (results.surface) add(results.surface->findings);
  if (results.profile) add(results.profile->findings);
  if (results.volume) add(results.volume->findings);
  return all;
}

bool needs_a_person(const Results& results) {
  const Findings all = all_findings(results);
  return std::any_of(all.begin(), all.end(), [](const Finding& f) { return f.severity == Severity::decision; });
}

}  // namespace adit
