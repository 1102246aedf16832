#pragma once
// Puts points into the order of the space-filling curve, in memory.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/stored_points.h"

namespace adit::io {

/// A point on its way to its place.
struct CurvePoint {
  std::uint64_t key = 0;  ///< curve_key of the position
  StoredPosition position{};
  std::uint32_t index = 0;  ///< of its attributes
};

/// Points as they came; attributes are empty or as long as points.
struct UnsortedPoints {
  std::vector<CurvePoint> points;
  std::vector<float> intensity;
  std::vector<std::array<std::uint8_t, 3>> colour;

  std::size_t size() const { return points.size(); }
  void clear() {
    points.clear();
    intensity.clear();
    colour.clear();
  }
};

/// Sorts by comes_before; keeps its memory for the next time.
class CurveSorter {
 public:
  /// The sorted points, good until the next call; `unsorted` is left in disorder.
  StoredPoints& sorted(UnsortedPoints& unsorted);

 private:
  std::vector<CurvePoint> scratch_;
  std::vector<std::uint32_t> place_;
  StoredPoints sorted_;
};

}  // namespace adit::io
