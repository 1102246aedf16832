#include "io/las_description.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

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

std::string unit_name(unsigned epsg_code) {
  return epsg_code == 9001   ? "metre"
         : epsg_code == 9002 ? "foot"
         : epsg_code == 9003 ? "US survey foot"
                             : "EPSG:" + std::to_string(epsg_code);
}

struct CoordinateSystem {
  std::string wkt, geotiff_words, epsg, unit, vertical_unit;
  bool geographic = false;  ///< degrees
};

/// GeoTIFF keys: four numbers each, the first four say how many there are.
void take_geotiff_keys(const std::vector<std::byte>& bytes, CoordinateSystem& system) {
  const auto at = [&](std::size_t i) { return little<std::uint16_t>(bytes.data() + 2 * i); };
  constexpr unsigned model_type = 1024, geographic_model = 2;
  constexpr unsigned geographic_system = 2048, projected_system = 3072, linear_unit = 3076, vertical_unit = 4099,
                     user_defined = 32767;
  for (std::size_t k = 4; 2 * (k + 4) <= bytes.size(); k += 4) {
    const unsigned key = at(k), elsewhere = at(k + 1), value = at(k + 3);
    if (elsewhere != 0 || value == 0 || value == user_defined) continue;
    if (key == model_type) system.geographic = value == geographic_model;
    if (key == projected_system || (key == geographic_system && system.epsg.empty()))
      system.epsg = "EPSG:" + std::to_string(value);
    if (key == linear_unit) system.unit = unit_name(value);
    if (key == vertical_unit) system.vertical_unit = unit_name(value);
  }
}

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
      if (number == 34735) take_geotiff_keys(content, system);
      if (number == 34737) system.geotiff_words = text_at(content, 0, length);
    }
    at += length;
  }
  return system;
}

CoordinateSystem coordinate_system(const InputFile& file, const LasHeader& header) {
  const auto bytes = file.read(0, fixed_bytes, "the LAS header");
  return coordinate_system(file, header, little<std::uint16_t>(bytes.data() + 94),
                           little<std::uint32_t>(bytes.data() + 100));
}

/// The unit that stands directly in a part of well-known text (versions 1 and 2), not in one of its own parts.
std::string unit_in(std::string_view wkt, std::string_view part) {
  std::size_t at = wkt.find(part);
  if (at == std::string_view::npos) return {};
  at += part.size();
  for (int depth = 1; at < wkt.size() && depth > 0; ++at) {
    if (depth == 1 && wkt.substr(at).starts_with("UNIT[\"")) {
      const std::size_t begin = at + 6, end = wkt.find('"', begin);
      return end == std::string_view::npos ? std::string() : std::string(wkt.substr(begin, end - begin));
    }
    depth += wkt[at] == '[' ? 1 : wkt[at] == ']' ? -1 : 0;
  }
  return {};
}

bool is_metre(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return word == "metre" || word == "meter" || word == "m" || word == "metres" || word == "meters";
}

}  // namespace

std::string las_unit(const InputFile& file, const LasHeader& header) {
  const CoordinateSystem system = coordinate_system(file, header);
  if (system.geographic || system.wkt.starts_with("GEOGCS[") || system.wkt.starts_with("GEOGCRS[")) return "degree";
  std::vector<std::string> units = {system.unit, system.vertical_unit};
  for (const char* part : {"PROJCS[", "PROJCRS[", "VERT_CS[", "VERTCRS["}) units.push_back(unit_in(system.wkt, part));
  const auto unit = std::find_if(units.begin(), units.end(), [](const auto& u) { return !u.empty() && !is_metre(u); });
  return unit == units.end() ? std::string() : *unit;
}

std::vector<HeaderFact> las_description(const InputFile& file, const LasHeader& header) {
  const auto bytes = file.read(0, fixed_bytes, "the LAS header");
  const CoordinateSystem system = coordinate_system(file, header);
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
