#pragma once
// What makes a list of segments a design line.

#include <vector>

#include "core/design/profile_piece.h"

namespace adit {

/// The segments as one closed ring: joins within 1 mm snapped, segments shorter than 0.1 mm left out. Throws Error when
/// a number is not finite, segments do not join, the line is open, crosses or touches itself, encloses less than
/// 0.01 m2 or is wider or higher than 500 m (a wrong unit); the message names the segments (counted from 1) and the
/// place (x, z) [m].
std::vector<ProfileSegment> checked_ring(const std::vector<ProfileSegment>& segments);

}  // namespace adit
