#include "io/laz_packing.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr const char* export_again = "the file is damaged; copy or export it again";
constexpr const char* cut_short = "the file is cut short; copy or export it again";
constexpr std::uint64_t record_head_bytes = 54;
constexpr std::uint64_t packing_bytes = 34;  // of LASzip's record, without its items
constexpr std::uint32_t differing_chunks = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void fail(const InputFile& file, std::uint64_t offset, const std::string& what_is_wrong,
                       const std::string& mend = export_again) {
  throw Error(what_is_wrong, file.at_byte(offset), mend);
}

/// A part of a point record as LASzip counts them, how many layers it has where points are kept in layers, and the ways
/// of packing it that LASzip knows.
struct Item {
  std::uint16_t type;
  std::uint16_t size;
  std::uint16_t layers;
  std::uint16_t oldest_version;
  std::uint16_t newest_version;
};
constexpr Item point10{6, 20, 0, 1, 2}, gps_time{7, 8, 0, 1, 2}, colour{8, 6, 0, 1, 2}, wave{9, 29, 0, 1, 1};
constexpr Item point14{10, 30, 9, 2, 4}, colour14{11, 6, 1, 2, 4}, colour_and_infrared14{12, 8, 2, 2, 4},
    wave14{13, 29, 1, 3, 4};

/// The items that a point format consists of.
std::vector<Item> items_of(const LasHeader& header) {
  static const std::array<std::vector<Item>, 11> rows = {{{point10},
                                                          {point10, gps_time},
                                                          {point10, colour},
                                                          {point10, gps_time, colour},
                                                          {point10, gps_time, wave},
                                                          {point10, gps_time, colour, wave},
                                                          {point14},
                                                          {point14, colour14},
                                                          {point14, colour_and_infrared14},
                                                          {point14, wave14},
                                                          {point14, colour_and_infrared14, wave14}}};
  std::vector<Item> items = rows.at(header.point_format);
  const unsigned extra = header.record_bytes - las_point_format(header.point_format).least_bytes;
  const auto bytes = static_cast<std::uint16_t>(extra);
  if (extra > 0 && header.point_format < 6) items.push_back({0, bytes, 0, 1, 2});
  if (extra > 0 && header.point_format >= 6) items.push_back({14, bytes, bytes, 2, 4});
  return items;
}

/// Where the payload of LASzip's variable length record lies.
struct Payload {
  std::uint64_t offset;
  std::uint16_t bytes;
};

Payload find_payload(const InputFile& file, const LasHeader& header) {
  std::optional<Payload> found;
  std::uint64_t at = header.header_bytes;
  for (std::uint32_t i = 0; i < header.records; ++i) {
    const std::string reaches = "variable length record " + std::to_string(i + 1) + " of " +
                                std::to_string(header.records) + " reaches into the points";
    if (at + record_head_bytes > header.points_offset) fail(file, at, reaches);
    const std::vector<std::byte> head = file.read(at, record_head_bytes, "a variable length record");
    const std::string_view user(reinterpret_cast<const char*>(head.data()) + 2, 16);
    const auto bytes = little<std::uint16_t>(head.data() + 20);
    const bool is_packing =
        user.starts_with(std::string_view("laszip encoded\0", 15)) && little<std::uint16_t>(head.data() + 18) == 22204;
    if (is_packing && found) fail(file, at, "there are two records of LASzip");
    if (is_packing) found = Payload{at + record_head_bytes, bytes};
    at += record_head_bytes + bytes;
    if (at > header.points_offset) fail(file, at, reaches);
  }
  if (!found)
    fail(file, header.header_bytes, "the points are marked as compressed, but the record of LASzip is missing");
  return *found;
}

/// Kind and size of the chunks. LASzip takes memory and steps by what the items say, so they must be those of the
/// format.
LazPacking take_payload(const InputFile& file, const LasHeader& header, const std::vector<Item>& items) {
  const Payload payload = find_payload(file, header);
  if (payload.bytes != packing_bytes + 6 * items.size())
    fail(file, payload.offset, "the record of LASzip does not fit point format " + std::to_string(header.point_format));
  const std::vector<std::byte> bytes = file.read(payload.offset, payload.bytes, "the record of LASzip");
  const auto number = [&](std::size_t offset) { return little<std::uint16_t>(bytes.data() + offset); };
  const bool layers = header.point_format >= 6;
  if (number(0) < 1 || number(0) > 3 || (number(0) == 3) != layers || number(2) != 0)
    fail(file, payload.offset,
         "compression " + std::to_string(number(0)) + " with coder " + std::to_string(number(2)) +
             " is not known for point format " + std::to_string(header.point_format));
  if (number(32) != items.size()) fail(file, payload.offset + 32, "the number of items does not fit the point format");
  for (std::size_t i = 0; i < items.size(); ++i)
    if (number(34 + 6 * i) != items[i].type || number(36 + 6 * i) != items[i].size ||
        number(38 + 6 * i) < items[i].oldest_version || number(38 + 6 * i) > items[i].newest_version)
      fail(file, payload.offset + 34 + 6 * i, "an item of the record of LASzip does not fit the point format");
  LazPacking packing;
  packing.kind = static_cast<LazPacking::Kind>(number(0));
  packing.points_in_chunk = little<std::uint32_t>(bytes.data() + 12);
  if (packing.points_in_chunk == differing_chunks) packing.points_in_chunk = 0;
  packing.record_offset = payload.offset;
  packing.record_bytes = payload.bytes;
  // Only layered chunks tell how long they are, and LASzip believes a chunk table of differing ones whatever it says.
  if (packing.points_in_chunk == 0 &&
      (packing.kind == LazPacking::Kind::chunks || (layers && header.minor_version < 4)))
    fail(file, payload.offset + 12, "chunks of differing sizes are known of LAS 1.4 points alone", "export as LAS");
  return packing;
}

/// Where the chunk table stands: said in front of the points, or at the file's end by programs that could not go back.
std::uint64_t find_table(const InputFile& file, std::uint64_t first_chunk) {
  const auto place_at = [&](std::uint64_t offset) {
    return little<std::uint64_t>(file.read(offset, 8, "the place of the chunk table").data());
  };
  std::uint64_t table = place_at(first_chunk - 8);
  if (table == ~std::uint64_t{0}) table = place_at(file.size() - 8);
  if (table == first_chunk - 8)
    fail(file, first_chunk - 8, "there is no chunk table; the program that wrote the file did not end well",
         "export it again");
  if (table < first_chunk) fail(file, first_chunk - 8, "the chunk table stands in front of the points");
  if (table > file.size() || file.size() - table < 8)
    fail(file, first_chunk - 8,
         "the chunk table stands at byte " + std::to_string(table) + ", the file has " + std::to_string(file.size()),
         cut_short);
  return table;
}

/// A layered chunk: a whole point, the number of points, the bytes
/// of each layer, the layers.
LazChunk layered_chunk(const InputFile& file, std::uint64_t at, std::uint16_t record_bytes, std::size_t layers) {
  const std::vector<std::byte> head = file.read(at, record_bytes + 4 + 4 * layers, "a chunk of points");
  const std::byte* number = head.data() + record_bytes;
  LazChunk chunk{at, at + head.size(), little<std::uint32_t>(number)};
  std::uint64_t bytes = 0;
  for (std::size_t i = 1; i <= layers; ++i) bytes += little<std::uint32_t>(number + 4 * i);
  if (bytes > std::numeric_limits<std::uint32_t>::max()) fail(file, at, "the sizes of a chunk's layers are impossible");
  chunk.end += bytes;
  return chunk;
}

void walk_layered_chunks(const InputFile& file, const LasHeader& header, const std::vector<Item>& items,
                         std::uint64_t first_chunk, std::uint64_t table, LazPacking& packing) {
  std::size_t layers = 0;
  for (const Item& item : items) layers += item.layers;
  std::uint64_t at = first_chunk;
  std::uint64_t points = 0;
  for (std::uint32_t i = 0; i < packing.chunks; ++i) {
    const LazChunk chunk = layered_chunk(file, at, header.record_bytes, layers);
    const std::string name = "chunk " + std::to_string(i + 1) + " of " + std::to_string(packing.chunks);
    if (chunk.end > table) fail(file, at, name + " reaches into the chunk table");
    const bool full = chunk.points == packing.points_in_chunk || i + 1 == packing.chunks;
    if (chunk.points == 0 || (packing.points_in_chunk > 0 && !full))
      fail(file, at, name + " says it has " + std::to_string(chunk.points) + " points");
    if (packing.points_in_chunk == 0) packing.differing.push_back(chunk);
    points += chunk.points;
    at = chunk.end;
  }
  if (points != header.points)
    fail(file, first_chunk,
         "the header says " + std::to_string(header.points) + " points, the chunks hold " + std::to_string(points));
  if (at != table) fail(file, at, "the chunks end before the chunk table");
}

}  // namespace

LazPacking read_laz_packing(const InputFile& file, const LasHeader& header) {
  const std::vector<Item> items = items_of(header);
  LazPacking packing = take_payload(file, header, items);
  if (header.points_offset > file.size() || file.size() - header.points_offset < 16)
    fail(file, header.points_offset, "the file ends where the points begin", cut_short);
  if (packing.kind == LazPacking::Kind::stream) return packing;
  const std::uint64_t first_chunk = header.points_offset + 8;
  const std::uint64_t table = find_table(file, first_chunk);
  const std::vector<std::byte> head = file.read(table, 8, "the chunk table");
  packing.chunks = little<std::uint32_t>(head.data() + 4);
  // Every chunk begins with a whole point.
  if (little<std::uint32_t>(head.data()) != 0 || packing.chunks == 0 ||
      packing.chunks > (table - first_chunk) / header.record_bytes)
    fail(file, table, "the chunk table is damaged");
  if (packing.points_in_chunk > 0) {
    const std::uint64_t chunks = (header.points - 1) / packing.points_in_chunk + 1;
    if (chunks != packing.chunks)
      fail(file, table,
           "the header says " + std::to_string(header.points) + " points in " + std::to_string(chunks) +
               " chunks, the chunk table has " + std::to_string(packing.chunks));
  }
  if (packing.kind == LazPacking::Kind::layers) walk_layered_chunks(file, header, items, first_chunk, table, packing);
  return packing;
}

}  // namespace adit::io
