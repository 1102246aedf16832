#pragma once
// What a LAS header declares, checked before anything is made of it.

#include <Eigen/Core>

#include <cstdint>
#include <optional>

#include "core/geometry/bounding_box.h"
#include "io/bytes.h"

namespace adit::io {

/// Where the parts of a point record stand, by point format.
struct LasPointFormat {
  std::uint16_t least_bytes = 0;
  std::optional<std::uint16_t> colour_offset;
};
inline constexpr std::uint16_t las_intensity_offset = 12;
/// Point formats 0 to 10.
LasPointFormat las_point_format(unsigned number);

struct LasHeader {
  unsigned minor_version = 0;
  unsigned point_format = 0;
  std::uint16_t record_bytes = 0;
  std::uint64_t points = 0;
  std::uint16_t header_bytes = 0;  ///< variable length records begin behind them
  std::uint32_t records = 0;       ///< how many variable length records
  std::uint64_t points_offset = 0;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  BoundingBox box;  ///< as the header says it
};

/// How the points of a file are kept: one record after the other (LAS), or compressed (LAZ).
enum class LasPoints { plain, compressed };

/// Reads and checks a header: version, point format, scale, and for plain points a count that the file holds exactly.
/// Error when the points are kept in the other way.
LasHeader read_las_header(const InputFile& file, LasPoints kept = LasPoints::plain);

}  // namespace adit::io
