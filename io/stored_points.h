#pragma once
// Points as the store keeps them: whole tenths of a millimetre, or float32 to the bit.

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "core/geometry/morton.h"

namespace adit::io {

/// How coordinates are kept.
enum class Keep {
  tenth_millimetre,  ///< rounded to 0.1 mm: at most 0.05 mm off an axis, about half the bytes
  float32,           ///< the float32 nearest to coordinate less offset
};

/// Coordinates less the offset; the meaning of the three words is Keep's.
using StoredPosition = std::array<std::int32_t, 3>;

inline constexpr double stored_step_m = 1e-4;
inline constexpr double stored_steps_a_metre = 1e4;

inline std::int32_t stored_coordinate(double value_m, Keep keep) {
  const double steps = value_m * stored_steps_a_metre;
  return keep == Keep::float32 ? std::bit_cast<std::int32_t>(static_cast<float>(value_m))
                               : static_cast<std::int32_t>(steps + (steps < 0.0 ? -0.5 : 0.5));
}

inline StoredPosition stored_position(const Eigen::Vector3d& less_offset, Keep keep) {
  return {stored_coordinate(less_offset.x(), keep), stored_coordinate(less_offset.y(), keep),
          stored_coordinate(less_offset.z(), keep)};
}

inline Eigen::Vector3f position_of(const StoredPosition& stored, Keep keep) {
  Eigen::Vector3f position;
  for (std::size_t axis = 0; axis < 3; ++axis)
    position[static_cast<Eigen::Index>(axis)] =
        keep == Keep::float32 ? std::bit_cast<float>(stored[axis])
                              : static_cast<float>(static_cast<double>(stored[axis]) * stored_step_m);
  return position;
}

/// Points with their attributes, column by column; attributes are empty or as long as positions.
struct StoredPoints {
  std::vector<StoredPosition> positions;
  std::vector<float> intensity;
  std::vector<std::array<std::uint8_t, 3>> colour;

  std::size_t size() const { return positions.size(); }
  void clear() {
    positions.clear();
    intensity.clear();
    colour.clear();
  }
  /// Adds points begin .. end of others.
  void append(const StoredPoints& others, std::size_t begin, std::size_t end) {
    const auto copy = [&](auto& values, const auto& from) {
      if (!from.empty())
        values.insert(values.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
                      from.begin() + static_cast<std::ptrdiff_t>(end));
    };
    copy(positions, others.positions);
    copy(intensity, others.intensity);
    copy(colour, others.colour);
  }
};

inline constexpr std::int32_t farthest_curve_cell = (1 << 20) - 1;
// Scans reach some 100 m: with this much added their cells need 16 bits an axis, and the sort fewer passes.
inline constexpr std::int32_t middle_curve_cell = 1 << 15;

inline std::uint64_t curve_cell(std::int32_t stored, Keep keep) {
  constexpr int steps_a_cell_bits = 5;  // 32 steps of 0.1 mm
  constexpr double cells_a_metre = 312.5;
  std::int32_t cell = stored >> steps_a_cell_bits;
  if (keep == Keep::float32) {
    const double exact = std::floor(static_cast<double>(std::bit_cast<float>(stored)) * cells_a_metre);
    cell = static_cast<std::int32_t>(std::clamp<double>(exact, -farthest_curve_cell, farthest_curve_cell));
  }
  cell = std::clamp(cell, -farthest_curve_cell, farthest_curve_cell) + middle_curve_cell;
  return static_cast<std::uint64_t>(cell) & 0x1FFFFF;
}

/// Where a point stands along the space-filling curve: by its cell of 3.2 mm. Beyond 3 km from the offset all cells of
/// a side are one.
inline std::uint64_t curve_key(const StoredPosition& stored, Keep keep) {
  return morton_key(curve_cell(stored[0], keep), curve_cell(stored[1], keep), curve_cell(stored[2], keep));
}

/// By x, then y, then z. (std::array compares by a call of memcmp, which costs more than the three numbers.)
inline std::strong_ordering order_of(const StoredPosition& a, const StoredPosition& b) {
  if (a[0] != b[0]) return a[0] <=> b[0];
  if (a[1] != b[1]) return a[1] <=> b[1];
  return a[2] <=> b[2];
}

/// A total order of points: along the curve, then by coordinates and attributes. Two points that compare equal are the
/// same to the bit, so a sort does not depend on the order they came in.
bool comes_before(const StoredPoints& a, std::size_t i, std::uint64_t key_a, const StoredPoints& b, std::size_t k,
                  std::uint64_t key_b);

}  // namespace adit::io
