#pragma once
// What PCL does for our PCD files: packing.

#include <string>
#include <string_view>

namespace adit::io {

/// LZF of bytes whose number fits 32 bits, without the two sizes that stand before it in a file.
std::string lzf_packed(std::string_view bytes);

}  // namespace adit::io
