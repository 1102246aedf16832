#pragma once
// The two things PCL does for our PCD files: reading the body of binary files, and packing.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.h"
#include "io/pcd_header.h"

namespace adit::io {

/// Records of all points, header.point_bytes each, from a binary or compressed file whose header has been checked.
std::vector<std::uint8_t> pcd_records(const InputFile& file, const PcdHeader& header);

/// LZF of bytes whose number fits 32 bits, without the two sizes that stand before it in a file.
std::string lzf_packed(std::string_view bytes);

}  // namespace adit::io
