#pragma once
// Puts points into the order of the space-filling curve, in memory.

#include <algorithm>
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

/// Points as they came; attributes are empty or as long as they.
class UnsortedPoints {
 public:
  std::vector<float> intensity;
  std::vector<std::array<std::uint8_t, 3>> colour;

  std::size_t size() const { return size_; }
  std::span<CurvePoint> points() { return std::span(points_).first(size_); }
  /// Places for so many more; the caller fills them.
  std::span<CurvePoint> add(std::size_t count) {
    points_.resize(std::max(points_.size(), size_ + count));
    size_ += count;
    return std::span(points_).subspan(size_ - count, count);
  }
  /// Keeps the memory.
  void clear() {
    size_ = 0;
    intensity.clear();
    colour.clear();
  }

 private:
  std::vector<CurvePoint> points_;  // never shorter than it was: new places would be filled twice
  std::size_t size_ = 0;
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
