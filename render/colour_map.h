#pragma once
// Which colour a number gets: deviations in round classes, scans by a list of distinct colours.

#include <cstddef>
#include <vector>

#include "render/colour.h"

namespace adit::render {

/// Round classes of deviation [m] from least to most, which are multiples of the step; least <= 0 <= most. Each side of
/// zero has its own full colour, so that a little underbreak is seen beside much overbreak.
struct DeviationScale {
  double least_m = -0.2;
  double most_m = 0.5;
  double step_m = 0.1;

  /// Boundaries of the classes, least_m ... most_m.
  std::vector<double> boundaries_m() const;
};

/// The scale with about eight round classes that holds 99.9 % of the deviations; NaN are passed over. A default
/// scale where there are none.
DeviationScale deviation_scale(const std::vector<float>& deviations_m);

/// Blue (underbreak), near white at zero, red (overbreak): distinct for colour-blind eyes. The colour of the class the
/// deviation falls into; beyond the ends that of the last class. Grey for NaN.
Colour deviation_colour(const DeviationScale& scale, double deviation_m);

/// The i-th of twelve distinct colours, from the start again after the twelfth.
Colour scan_colour(std::size_t i);
inline constexpr std::size_t scan_colour_count = 12;

/// The largest of 1, 2, 2.5 or 5 times a power of ten that is not above the value (> 0).
double round_down(double value);

/// The smallest of 1, 2, 2.5 or 5 times a power of ten that is not below the value (> 0).
double round_up(double value);

}  // namespace adit::render
