#pragma once
// oneTBB loops with fixed blocks and ordered sums: the same bytes on any number of threads.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace adit {

/// Calls body(begin, end) for consecutive blocks of [0, n) of fixed size; blocks run on any thread in any order.
template <typename Body>
void parallel_blocks(std::size_t n, std::size_t block, const Body& body) {
  const std::size_t blocks = (n + block - 1) / block;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t b = range.begin(); b != range.end(); ++b) body(b * block, std::min(n, (b + 1) * block));
  });
}

/// Calls body(i) for every i of [0, n).
template <typename Body>
void parallel_for_each_index(std::size_t n, const Body& body, std::size_t block = 256) {
  parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) body(i);
  });
}

/// Sum over fixed blocks, added in block order: sum = zero + block(0) + block(1) + ...
/// block_sum(begin, end) returns the value of one block.
template <typename Value, typename BlockSum>
Value parallel_ordered_sum(std::size_t n, std::size_t block, Value zero, const BlockSum& block_sum) {
  const std::size_t blocks = (n + block - 1) / block;
  std::vector<Value> parts(blocks, zero);
  parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) { parts[begin / block] = block_sum(begin, end); });
  Value sum = zero;
  for (const Value& part : parts) sum += part;
  return sum;
}

/// Lists of fixed blocks, one after the other: block_list(begin, end) returns the std::vector of one block.
template <typename BlockList>
auto parallel_ordered_list(std::size_t n, std::size_t block, const BlockList& block_list) {
  using List = decltype(block_list(n, n));
  std::vector<List> parts((n + block - 1) / block);
  parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) { parts[begin / block] = block_list(begin, end); });
  std::vector<std::size_t> begins{0};
  for (const List& part : parts) begins.push_back(begins.back() + part.size());
  List all(begins.back());
  parallel_for_each_index(
      parts.size(),
      [&](std::size_t i) {
        std::copy(parts[i].begin(), parts[i].end(), all.begin() + static_cast<std::ptrdiff_t>(begins[i]));
      },
      1);
  return all;
}

}  // namespace adit
