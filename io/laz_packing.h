#pragma once
// How the points of a LAZ file are packed, checked before LASzip may believe it: it trusts sizes.

#include <cstdint>
#include <vector>

#include "io/bytes.h"
#include "io/las_header.h"

namespace adit::io {

/// A chunk of points that can be unpacked by itself.
struct LazChunk {
  std::uint64_t begin = 0;  ///< byte of the file
  std::uint64_t end = 0;
  std::uint64_t points = 0;
};

/// The parts of LASzip's record and chunk table that a reader needs.
struct LazPacking {
  /// Points of LAS 1.0 to 1.3 as one stream, the same in chunks, or points of LAS 1.4 with a layer for each attribute.
  enum class Kind : std::uint16_t { stream = 1, chunks = 2, layers = 3 };
  Kind kind = Kind::chunks;
  std::uint32_t points_in_chunk = 0;  ///< 0: the chunks differ
  std::uint32_t chunks = 0;           ///< 0 for a stream
  std::uint64_t record_offset = 0;    ///< where LASzip's variable length record stands, behind its own head
  std::uint16_t record_bytes = 0;
  std::vector<LazChunk> differing;  ///< all chunks, where they differ
};

/// Reads LASzip's record and the head of the chunk table, and walks through the chunks where their heads say how long
/// they are (layers). Error when they contradict the header or the file's size.
LazPacking read_laz_packing(const InputFile& file, const LasHeader& header);

}  // namespace adit::io
