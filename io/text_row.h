#pragma once
// The columns that all text formats write alike.

#include <Eigen/Core>

#include <array>
#include <cstdint>

#include "io/text_line.h"

namespace adit::io {

/// Coordinates [m]: the shortest form of a float32 where they are one, else to a hundredth of a millimetre.
inline void add_position(TextLine& line, const Eigen::Vector3d& position, bool is_float32) {
  constexpr int decimals = 5;
  for (const double c : position) {
    if (is_float32)
      line.add(static_cast<float>(c));
    else
      line.add(c, decimals);
  }
}

/// red green blue, 0 .. 255.
inline void add_colour(TextLine& line, const std::array<std::uint8_t, 3>& colour) {
  for (const std::uint8_t c : colour) line.add(unsigned{c});
}

inline void add_normal(TextLine& line, const Eigen::Vector3f& normal) {
  for (const float c : normal) line.add(c);
}

}  // namespace adit::io
