#pragma once
// What a PLY header declares, and which of it are points.

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/scan_stream.h"

namespace adit::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type);
/// A stored value as a double (exact for every type).
double ply_value(PlyType type, std::endian order, const std::byte* from);
/// `count` values that stand `stride` bytes apart.
void ply_values(PlyType type, std::endian order, const std::byte* from, std::size_t stride, std::size_t count,
                double* to);

struct PlyProperty {
  std::string name;  ///< lower case
  PlyType type = PlyType::float32;
  std::optional<PlyType> list_count;  ///< set for a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  /// Bytes of one row in a binary file; the least when it has lists.
  std::uint64_t row_bytes() const;
};

struct PlyHeader {
  bool ascii = false;
  std::endian order = std::endian::little;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< the words behind comment and obj_info
  std::size_t vertex = 0;             ///< which element holds the points
  std::uint64_t body_offset = 0;      ///< first byte after the header
  int body_line = 0;                  ///< its line
};

/// Reads and checks a header: known types, x y z present, no more rows than the file has room for (and, in a binary
/// file without lists, no fewer).
PlyHeader read_ply_header(const InputFile& file);

/// What one property of a vertex means to us.
enum class PlyTarget { none, x, y, z, intensity, red, green, blue, nx, ny, nz };
PlyTarget ply_target(const std::string& property_name);
/// Attributes that the vertices have in full.
Attributes ply_attributes(const PlyElement& vertex);

}  // namespace adit::io
