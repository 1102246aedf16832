#pragma once
// From the darkness of twelve segments to a code, without doubt or not at all.

#include <array>
#include <optional>
#include <vector>

#include "core/georeference/target_fit.h"

namespace adit {

struct DecodedTarget {
  TargetCode code = 0;
  double margin = 0.0;  ///< how much farther the next code lies off, in segments
};

/// How dark each segment is, 0 as the paper and 1 as the disc: least squares on the ring, with the blur of the edges
/// and the brightness of the paper as a plane; places off by much count less. `black`: grey levels from white to the
/// disc. Nothing where the ring leaves the picture.
struct SegmentDarkness {
  std::array<double, coded_pattern::segments> value{};
  std::array<double, coded_pattern::segments> sigma{};
};
std::optional<SegmentDarkness> segment_darkness(const GreyPicture& picture, const TargetPlace& place, double blur_px,
                                                double black);

/// The code that lies nearest to the segments, when it is near and no other one is. `codes`: those that may be; empty:
/// all of target_codes(), and each segment must then be clear by itself.
std::optional<DecodedTarget> nearest_code(const SegmentDarkness& darkness, const std::vector<TargetCode>& codes);

/// Both.
std::optional<DecodedTarget> decode_segments(const GreyPicture& picture, const TargetPlace& place, double blur_px,
                                             double black, const std::vector<TargetCode>& codes);

}  // namespace adit
