#include "io/curve_sorter.h"

#include <algorithm>
#include <bit>
#include <compare>

namespace adit::io {
namespace {

using Points = std::span<CurvePoint>;

/// The bits in which the keys differ.
std::uint64_t differing_bits(Points points) {
  std::uint64_t differing = 0;
  for (const CurvePoint& point : points) differing |= point.key ^ points.front().key;
  return differing;
}

/// Counts of a digit become the places where each of its values begins.
void counts_to_places(std::span<std::uint32_t> counts) {
  std::uint32_t sum = 0;
  for (std::uint32_t& count : counts) {
    const std::uint32_t mine = count;
    count = sum;
    sum += mine;
  }
}

/// One pass of a radix sort: from -> to, in the order of the digit at `shift`; place: as long as the digit has values.
/// Afterwards place[d] is where value d ends.
void sort_by_digit(Points from, Points to, unsigned shift, std::span<std::uint32_t> place) {
  const std::uint64_t mask = place.size() - 1;
  std::fill(place.begin(), place.end(), 0U);
  for (const CurvePoint& point : from) ++place[point.key >> shift & mask];
  counts_to_places(place);
  for (const CurvePoint& point : from) to[place[point.key >> shift & mask]++] = point;
}

/// Sorts by key, least digit first; the result is in one of the two.
Points sorted_by_key(Points points, Points scratch) {
  constexpr std::size_t few = 48;
  if (points.size() <= few) {
    std::sort(points.begin(), points.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.key < b.key; });
    return points;
  }
  const std::uint64_t differing = differing_bits(points);
  const unsigned most_width = points.size() < 8192 ? 8 : 11;
  unsigned shift = differing == 0 ? 64U : static_cast<unsigned>(std::countr_zero(differing));
  const unsigned end = static_cast<unsigned>(std::bit_width(differing));
  const unsigned passes = end > shift ? (end - shift + most_width - 1) / most_width : 0;
  std::array<std::uint32_t, 2048> place;
  for (unsigned pass = passes; pass > 0; --pass) {
    const unsigned width = (end - shift + pass - 1) / pass;
    sort_by_digit(points, scratch, shift, std::span(place).first(std::size_t{1} << width));
    std::swap(points, scratch);
    shift += width;
  }
  return points;
}

bool attributes_before(const UnsortedPoints& all, std::uint32_t a, std::uint32_t b) {
  if (!all.intensity.empty() && all.intensity[a] != all.intensity[b]) return all.intensity[a] < all.intensity[b];
  return !all.colour.empty() && all.colour[a] < all.colour[b];
}

void put_equal_keys_in_order(Points points, const UnsortedPoints& all) {
  for (auto begin = points.begin(); begin != points.end();) {
    auto end = begin + 1;
    while (end != points.end() && end->key == begin->key) ++end;
    if (end - begin > 1)
      std::sort(begin, end, [&](const CurvePoint& a, const CurvePoint& b) {
        const auto order = order_of(a.position, b.position);
        return std::is_neq(order) ? std::is_lt(order) : attributes_before(all, a.index, b.index);
      });
    begin = end;
  }
}

/// Puts sorted points where `to` holds its points from `begin` on.
void put(Points points, const UnsortedPoints& all, StoredPoints& to, std::size_t begin) {
  for (std::size_t i = 0; i < points.size(); ++i) to.positions[begin + i] = points[i].position;
  if (!all.intensity.empty())
    for (std::size_t i = 0; i < points.size(); ++i) to.intensity[begin + i] = all.intensity[points[i].index];
  if (!all.colour.empty())
    for (std::size_t i = 0; i < points.size(); ++i) to.colour[begin + i] = all.colour[points[i].index];
}

}  // namespace

StoredPoints& CurveSorter::sorted(UnsortedPoints& unsorted) {
  // The foremost digit first, so wide that the points of one value fit near the processor; those are then sorted there.
  constexpr unsigned first_digit_bits = 16;
  const std::size_t count = unsorted.size();
  sorted_.positions.resize(count);
  sorted_.intensity.resize(unsorted.intensity.size());
  sorted_.colour.resize(unsorted.colour.size());
  if (count == 0) return sorted_;
  scratch_.resize(count);
  place_.resize(std::size_t{1} << first_digit_bits);
  const Points all = unsorted.points();
  const Points scratch(scratch_);
  const auto bits = static_cast<unsigned>(std::bit_width(differing_bits(all)));
  sort_by_digit(all, scratch, bits > first_digit_bits ? bits - first_digit_bits : 0, place_);
  std::size_t begin = 0;
  for (const std::uint32_t end : place_) {
    if (end == begin) continue;
    const Points bucket = sorted_by_key(scratch.subspan(begin, end - begin), all.subspan(begin, end - begin));
    put_equal_keys_in_order(bucket, unsorted);
    put(bucket, unsorted, sorted_, begin);
    begin = end;
  }
  return sorted_;
}

}  // namespace adit::io
