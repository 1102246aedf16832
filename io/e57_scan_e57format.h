#pragma once
// A scan of an E57 file as its XML describes it. Only files that end in _e57format.cpp include this.

#include <E57Format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/foundation/error.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// What a record may hold of a point.
enum E57Field : std::size_t {
  e57_x,
  e57_y,
  e57_z,
  e57_invalid,
  e57_range,
  e57_azimuth,
  e57_elevation,
  e57_spherical_invalid,
  e57_intensity,
  e57_intensity_invalid,
  e57_red,
  e57_green,
  e57_blue,
  e57_colour_invalid,
  e57_row,
  e57_column,
  e57_normal_x,
  e57_normal_y,
  e57_normal_z,
  e57_fields
};
/// Their names in the file.
inline constexpr std::array<const char*, e57_fields> e57_field_names = {
    "cartesianX",     "cartesianY",         "cartesianZ",         "cartesianInvalidState",
    "sphericalRange", "sphericalAzimuth",   "sphericalElevation", "sphericalInvalidState",
    "intensity",      "isIntensityInvalid", "colorRed",           "colorGreen",
    "colorBlue",      "isColorInvalid",     "rowIndex",           "columnIndex",
    "nor:normalX",    "nor:normalY",        "nor:normalZ"};

/// From stored colours to 0 .. 255: (stored - least) * to_bytes.
struct E57ColourRange {
  double least = 0.0;
  double to_bytes = 1.0;
};

/// A scan, without its points.
struct E57Scan {
  ScanHeader header;
  std::array<bool, e57_fields> has{};
  bool spherical = false;  ///< the coordinates are range, azimuth and elevation
  std::array<E57ColourRange, 3> colours;
  std::uint64_t rows = 0;  ///< of the raster; 0 when the file does not say
  std::uint64_t columns = 0;
  e57::CompressedVectorNode records;
  std::uint64_t records_begin = 0;  ///< byte of the file; 0 when the XML does not say
};

/// A file that has been looked through. The library leaves checksums to E57PageCheck; those of header and XML are
/// right.
struct OpenE57 {
  e57::ImageFile library;
  std::vector<std::uint64_t> record_places;  ///< of each scan (e57_record_places)
};
OpenE57 open_e57(const std::filesystem::path& path);

/// All scans of an open file. Error for a file without scans, points without coordinates, a pose that is not rigid, and
/// records that the file cannot hold.
std::vector<E57Scan> e57_scans(const OpenE57& file, const std::filesystem::path& path);

/// What the file says of itself beyond its scans: software, date, coordinate system, images, sensors.
std::vector<HeaderFact> e57_description(const e57::ImageFile& file);

/// The library's exception as an Error about the file.
Error e57_error(const e57::E57Exception& exception, const std::filesystem::path& path);

/// Calls `work`; whatever the library throws becomes an Error about the file.
template <typename Work>
auto with_e57_errors(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const e57::E57Exception& exception) {
    throw e57_error(exception, path);
  }
}

}  // namespace adit::io
