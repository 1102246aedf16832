#pragma once
// The decoding loops of the libraries behind E57 and LAZ, alone: how fast an import can be at best.

#include <cstdint>
#include <filesystem>

namespace adit::bench {

/// Decodes coordinates, intensity and colour of all scans; returns how many points there were.
std::uint64_t decode_e57(const std::filesystem::path& file);
std::uint64_t decode_laz(const std::filesystem::path& file);

}  // namespace adit::bench
