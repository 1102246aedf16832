#pragma once
// What a PCD header declares, checked before anything is made of it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "io/bytes.h"
#include "io/scan_stream.h"

namespace adit::io {

/// What one field of a point means to us.
enum class PcdTarget { none, x, y, z, intensity, packed_colour, nx, ny, nz };

struct PcdField {
  std::string name;
  PcdTarget target = PcdTarget::none;
  char type = 'F';           ///< F, U or I
  std::uint64_t size = 4;    ///< bytes of one value
  std::uint64_t count = 1;   ///< values
  std::uint64_t offset = 0;  ///< in the record of a point
};

enum class PcdEncoding { ascii, binary, compressed };

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  std::uint64_t points = 0;
  PcdEncoding encoding = PcdEncoding::ascii;
  std::optional<Pose> viewpoint;  ///< unless the identity
  std::uint64_t point_bytes = 0;
  std::uint64_t values = 0;  ///< on a line of an ascii file
  std::uint64_t body_offset = 0;
  int body_line = 0;
};

/// Reads and checks a header: fields with x y z, counts that agree with each other and with the file's size.
PcdHeader read_pcd_header(const InputFile& file);

/// Attributes that the points have in full.
Attributes pcd_attributes(const PcdHeader& header);

}  // namespace adit::io
