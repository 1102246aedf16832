#include "io/las_description.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

namespace adit::io {
namespace {

constexpr std::size_t fixed_bytes = 227;  // what all versions have
constexpr std::size_t record_header_bytes = 54;
constexpr std::uint64_t most_records = 1000;

/// A text of fixed length, filled up with zeros or blanks.
std::string text_at(const std::vector<std::byte>& bytes, std::size_t offset, std::size_t length) {
  std::string text(reinterpret_cast<const char*>(bytes.data()) + offset, length);
  text.resize(std::min(text.find('\0'), text.size()));
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

std::string vector_text(const Eigen::Vector3d& v) {
  char text[100];
  std::snprintf(text, sizeof text, "%.12g %.12g %.12g", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no -0
  return text;
}

/// The header holds the day of the year, from 1.
std::string date_text(unsigned day, unsigned year) {
  if (day < 1 || day > 366 || year < 1) return {};
  const std::chrono::sys_days first = std::chrono::year(static_cast<int>(year)) / std::chrono::January / 1;
  const std::chrono::year_month_day date(first + std::chrono::days(day - 1));
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
  return text;
}

/// GeoTIFF keys: four numbers each, the first four say how many there are.
void take_geotiff_keys(const std::vector<std::byte>& bytes, std::string& epsg, std::string& unit) {
  const auto at = [&](std::size_t i) { return little<std::uint16_t>(bytes.data() + 2 * i); };
  constexpr unsigned geographic_system = 2048, projected_system = 3072, linear_unit = 3076, user_defined = 32767;
  for (std::size_t k = 4; 2 * (k + 4) <= bytes.size(); k += 4) {
    const unsigned key = at(k), elsewhere = at(k + 1), value = at(k + 3);
    if (elsewhere != 0 || value == 0 || value == user_defined) continue;
    if (key == projected_system || (key == geographic_system && epsg.empty())) epsg = "EPSG:" + std::to_string(value);
    if (key == linear_unit)
      unit = value == 9001   ? "metre"
             : value == 9002 ? "foot"
             : value == 9003 ? "US survey foot"
                             : "EPSG:" + std::to_string(value);
  }
}

struct CoordinateSystem {
  std::string wkt, geotiff_words, epsg, unit;
};

/// Walks through the records between the header and the points.
CoordinateSystem coordinate_system(const InputFile& file, const LasHeader& header, std::uint64_t begin,
                                   std::uint64_t records) {
  CoordinateSystem system;
  std::uint64_t at = begin;
  for (std::uint64_t i = 0; i < std::min(records, most_records) && at + record_header_bytes <= header.points_offset;
       ++i) {
    const auto head = file.read(at, record_header_bytes, "a record of the header");
    const std::size_t length = little<std::uint16_t>(head.data() + 20);
    at += record_header_bytes;
    if (at + length > header.points_offset) break;
    const unsigned number = little<std::uint16_t>(head.data() + 18);
    if (text_at(head, 2, 16) == "LASF_Projection" && (number == 2112 || number == 34735 || number == 34737)) {
      const auto content = file.read(at, length, "a record of the header");
      if (number == 2112) system.wkt = text_at(content, 0, length);
      if (number == 34735) take_geotiff_keys(content, system.epsg, system.unit);
      if (number == 34737) system.geotiff_words = text_at(content, 0, length);
    }
    at += length;
  }
  return system;
}

}  // namespace

std::vector<HeaderFact> las_description(const InputFile& file, const LasHeader& header) {
  const auto bytes = file.read(0, fixed_bytes, "the LAS header");
  const CoordinateSystem system = coordinate_system(file, header, little<std::uint16_t>(bytes.data() + 94),
                                                    little<std::uint32_t>(bytes.data() + 100));
  const unsigned extra_bytes = header.record_bytes - las_point_format(header.point_format).least_bytes;
  std::vector<HeaderFact> facts = {
      {"software", text_at(bytes, 58, 32)},
      {"system", text_at(bytes, 26, 32)},
      {"creation_date", date_text(little<std::uint16_t>(bytes.data() + 90), little<std::uint16_t>(bytes.data() + 92))},
      {"coordinate_system", system.wkt.empty() ? system.geotiff_words : system.wkt},
      {"epsg", system.epsg},
      {"unit", system.unit},
      {"point_format", std::to_string(header.point_format)},
      {"scale", vector_text(header.scale)},
      {"offset", vector_text(header.offset)},
      {"extra_bytes_per_point", extra_bytes > 0 ? std::to_string(extra_bytes) : ""},
  };
  std::erase_if(facts, [](const HeaderFact& fact) { return fact.text.empty(); });
  return facts;
}

}  // namespace adit::io
