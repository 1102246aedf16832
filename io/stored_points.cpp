#include "io/stored_points.h"

namespace adit::io {

bool comes_before(const StoredPoints& a, std::size_t i, std::uint64_t key_a, const StoredPoints& b, std::size_t k,
                  std::uint64_t key_b) {
  if (key_a != key_b) return key_a < key_b;
  if (const auto order = order_of(a.positions[i], b.positions[k]); std::is_neq(order)) return std::is_lt(order);
  if (!a.intensity.empty() && a.intensity[i] != b.intensity[k]) return a.intensity[i] < b.intensity[k];
  return !a.colour.empty() && a.colour[i] < b.colour[k];
}

}  // namespace adit::io
