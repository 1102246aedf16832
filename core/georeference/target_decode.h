#pragma once
// From the darkness of twelve segments to a code, without doubt or not at all.

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/grey_picture.h"
#include "core/georeference/target_model.h"
#include "core/georeference/target_place.h"

namespace adit {

struct DecodedTarget {
  TargetCode code = 0;
  double margin = 0.0;  ///< how much farther the next code lies off, in segments
  bool alone = false;   ///< no other code is far off: only what each segment shows by itself speaks for it
};

/// How a target is blurred, and the grey levels from its white to its black.
struct TargetTone {
  double blur_px = 0.0;
  double bleed = 0.0;
  double black = 0.0;
};

/// How dark each segment is, 0 as the paper and 1 as the disc: least squares on the ring, with the blur of the edges
/// and the brightness of the paper as a plane; places off by much count less. `grid`: over the whole pattern. Nothing
/// where the ring leaves the picture.
struct SegmentDarkness {
  std::array<double, coded_pattern::segments> value{};
  std::array<double, coded_pattern::segments> sigma{};
};
std::optional<SegmentDarkness> segment_darkness(const GreyPicture& picture, const TargetPlace& place,
                                                const std::vector<PatternPlace>& grid, const TargetTone& tone);

/// The code that lies nearest to the segments, when it is near and no other one is, or each segment is clear by itself.
/// `codes`: those that may be; empty: all of target_codes(). What shows another code with all segments whole is none of
/// them.
std::optional<DecodedTarget> nearest_code(const SegmentDarkness& darkness, const std::vector<TargetCode>& codes);

/// Both.
std::optional<DecodedTarget> decode_segments(const GreyPicture& picture, const TargetPlace& place,
                                             const std::vector<PatternPlace>& grid, const TargetTone& tone,
                                             const std::vector<TargetCode>& codes);

}  // namespace adit
