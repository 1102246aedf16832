#pragma once
// The coded target that is printed: a black disc with a white quarter, a white ring, and a ring of twelve segments.

#include <cstdint>
#include <vector>

namespace adit {

/// Sizes over the outer radius of the ring of segments. Seen from the front, x right and y up, the white quarter of the
/// disc lies between 0 and 90 degrees; segment k reaches from 30 k to 30 (k + 1) degrees, counter-clockwise.
/// (Wang, Wu, Li 2011, figure 3; the widths of the layers are ours: equal to see, and the segments as long as they are
/// wide.)
namespace coded_pattern {
inline constexpr double disc_radius = 0.36;
inline constexpr double ring_radius = 0.64;   ///< inner radius of the segments
inline constexpr double clear_radius = 1.25;  ///< white paper up to here
inline constexpr int segments = 12;
}  // namespace coded_pattern

/// Twelve segments as a number, the first one the highest bit; 1 is black, as the paper prints them ("100010010101").
using TargetCode = std::uint16_t;
inline bool is_black(TargetCode code, int segment) {
  return ((code >> (coded_pattern::segments - 1 - segment)) & 1) != 0;
}

/// True at a black place of a code's pattern: x right, y up over the outer radius.
bool is_black_at(TargetCode code, double x, double y);

/// Codes that may be printed, by their id less one. Left out: codes with fewer than three black segments, which blur
/// and glare turn into nothing at all: 1 + 12 + 66 of 4096, so that 4017 are left, as many as the paper keeps. The
/// white quarter says where a code starts, so that none is another one turned. The order makes low ids the safe ones:
/// taken one by one as they differ from all before in four segments (ids up to codes_differing_in(4): one misread
/// segment is put right, two are noticed), then three, two and one.
const std::vector<TargetCode>& target_codes();
inline constexpr int target_code_count = 4017;

/// How many of the first ids differ from one another in at least so many segments (1 to 4).
int codes_differing_in(int segments);

/// 0 for a code that is not printed.
int id_of_code(TargetCode code);
/// `id` from 1 to target_code_count. Throws Error otherwise.
TargetCode code_of_id(int id);

}  // namespace adit
