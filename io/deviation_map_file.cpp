#include "io/deviation_map_file.h"

#include <cstring>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/sha256.h"

namespace adit::io {
namespace {

constexpr std::string_view magic = "ADITMAP3";
constexpr std::size_t header_size = 8 + 4 * 8 + 2 * 8;
constexpr std::size_t cell_size = 4 + 4 + 4 + 4 + 1;
constexpr std::size_t checksum_size = 64;

template <typename Value>
void put(std::string& bytes, Value value) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

}  // namespace

void write_deviation_map(const std::filesystem::path& path, const DeviationMap& map) {
  std::string bytes(magic);
  for (const double value : {map.from_m, map.to_m, map.step_s_m, map.step_q_m}) put(bytes, value);
  put(bytes, std::uint64_t{map.rows});
  put(bytes, std::uint64_t{map.columns});
  for (const MapCell& cell : map.cells) {
    put(bytes, cell.deviation_m);
    put(bytes, cell.spread_m);
    put(bytes, cell.count);
    put(bytes, cell.incidence);
    put(bytes, static_cast<std::uint8_t>(cell.kind));
  }
  bytes += sha256_of_bytes(bytes);
  write_file_atomically(path, bytes);
}

DeviationMap read_deviation_map(const std::filesystem::path& path) {
  const InputFile file(path);
  const Error damaged("this is not a whole deviation map of this version", file.name(), "run the job again");
  if (file.size() < header_size + checksum_size) throw damaged;
  const auto bytes = file.read(0, file.size(), "the deviation map");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.substr(0, magic.size()) != magic) throw damaged;
  if (sha256_of_bytes(text.substr(0, text.size() - checksum_size)) != text.substr(text.size() - checksum_size))
    throw damaged;
  const std::byte* at = bytes.data() + magic.size();
  DeviationMap map;
  for (double* value : {&map.from_m, &map.to_m, &map.step_s_m, &map.step_q_m}) {
    *value = little<double>(at);
    at += 8;
  }
  map.rows = little<std::uint64_t>(at);
  map.columns = little<std::uint64_t>(at + 8);
  at += 16;
  const std::size_t cells = (file.size() - header_size - checksum_size) / cell_size;
  if (map.columns == 0 || map.rows != cells / map.columns || map.rows * map.columns != cells) throw damaged;
  map.cells.resize(cells);
  for (MapCell& cell : map.cells) {
    cell.deviation_m = little<float>(at);
    cell.spread_m = little<float>(at + 4);
    cell.count = little<std::uint32_t>(at + 8);
    cell.incidence = little<float>(at + 12);
    cell.kind = static_cast<CellKind>(little<std::uint8_t>(at + 16));
    at += cell_size;
  }
  return map;
}

}  // namespace adit::io
