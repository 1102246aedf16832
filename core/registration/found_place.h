#pragma once
// The place of one scan in another without a guess, or why there is none.

#include "core/foundation/progress.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// What came of a search, from the worst to the best.
enum class SearchOutcome { nothing_alike, alike_elsewhere, undetermined, placed };

struct PairFound {
  SearchOutcome outcome = SearchOutcome::nothing_alike;
  Pose target_from_source = Pose::Identity();  ///< refined; means nothing when there is nothing alike
};

/// Placed only when the best place is clearly better than any other, agrees with what both scanners saw, and is
/// determined in every direction. Nothing alike where it is not known where the
/// scanners stood.
PairFound found_place(const PreparedScan& target, const PreparedScan& source, const RegistrationOptions& options,
                      Progress& progress);

}  // namespace adit
