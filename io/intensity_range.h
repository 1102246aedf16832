#pragma once
// Intensities into formats that hold a fixed range.

#include <algorithm>
#include <vector>

#include "io/scan_writer.h"

namespace adit::io {

/// How intensities fit into a format that holds 0 .. most: written = (value - zero) * factor.
struct IntensityRange {
  double zero = 0.0;
  double factor = 1.0;
  double operator()(float value) const { return (static_cast<double>(value) - zero) * factor; }
};

/// Values that fit are kept; values within 0 .. 1 are multiplied by `most` (where most > 1); all others are stretched
/// so that the least becomes 0 and the greatest `most`. whole: the format holds whole numbers, fractions do not fit.
inline IntensityRange intensity_range(const ScanFacts& facts, double most, bool whole) {
  if (!facts.header.attributes.intensity) return {};
  const double low = static_cast<double>(facts.least_intensity);
  const double high = static_cast<double>(facts.greatest_intensity);
  if (low >= 0.0 && high <= most && (!whole || facts.whole_intensities)) return {};
  if (low >= 0.0 && high <= 1.0) return {0.0, most};
  return {low, high > low ? most / (high - low) : 1.0};
}

/// The intensities of several scans as those of one.
inline ScanFacts all_intensities(const std::vector<ScanFacts>& scans) {
  ScanFacts all;
  for (const ScanFacts& scan : scans) {
    if (!scan.header.attributes.intensity) continue;
    const bool first = !all.header.attributes.intensity;
    all.header.attributes.intensity = true;
    all.least_intensity = first ? scan.least_intensity : std::min(all.least_intensity, scan.least_intensity);
    all.greatest_intensity =
        first ? scan.greatest_intensity : std::max(all.greatest_intensity, scan.greatest_intensity);
    all.whole_intensities = all.whole_intensities && scan.whole_intensities;
  }
  return all;
}

}  // namespace adit::io
