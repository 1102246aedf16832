#pragma once
// results.json: what came out, for other programs (docs/formats.md).

#include <string>

#include "core/job/results.h"

namespace adit::io {

/// Stable keys, SI units, chainage internal; outlines are left out.
std::string results_text(const Results& results);

}  // namespace adit::io
