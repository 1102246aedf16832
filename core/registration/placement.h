#pragma once
// Scans that nobody said where they stand: each is searched in the others until all that can be placed are.

#include <optional>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// Where a scan starts.
struct StartingPlace {
  std::optional<Pose> local_from_scan;
  std::string why_not;  ///< in words, when there is none
};

/// Starting places of all scans. `known` says where some stand already (guess or control); with none known, the first
/// scan of the largest group that fits together is the frame. A pair counts only when its best place is clearly better
/// than any other, agrees with what both scanners saw, and is determined in every direction: nothing is guessed.
std::vector<StartingPlace> place_scans(const std::vector<PreparedScan>& scans,
                                       const std::vector<std::optional<Pose>>& known,
                                       const RegistrationOptions& options, Progress& progress);

}  // namespace adit
