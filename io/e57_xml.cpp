#include "io/e57_xml.h"

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>

#include "core/foundation/error.h"
#include "io/e57_pages.h"

namespace adit::io {
namespace {

constexpr std::uint64_t header_bytes = 48;
constexpr std::uint64_t page_bytes = 1024;
constexpr int deepest = 64;
constexpr std::uint64_t most_xml_bytes = std::uint64_t{64} << 20;  // of some thousand scans and images it is one MB
constexpr const char* damaged = "the file is damaged; copy or export it again";

/// Its length is compared with the file's before memory is taken.
std::string read_xml(const InputFile& file) {
  const std::vector<std::byte> header = file.read(0, header_bytes, "the E57 header");
  const auto number = [&](std::size_t offset) { return little<std::uint64_t>(header.data() + offset); };
  const auto fail = [&](std::uint64_t offset, const std::string& words, const char* mend) {
    throw Error(words, file.at_byte(offset), mend);
  };
  if (file.beginning(8) != "ASTM-E57")
    fail(0, "this is no E57 file (it does not begin with ASTM-E57)", "check the file's ending");
  if (number(16) != file.size())
    fail(16,
         "the header says " + std::to_string(number(16)) + " bytes, the file has " + std::to_string(file.size()) +
             (number(16) > file.size() ? ": it is cut short" : ""),
         damaged);
  if (number(40) != page_bytes) fail(40, "pages of " + std::to_string(number(40)) + " bytes are not known", damaged);
  const std::uint64_t begin = number(24);
  const std::uint64_t length = number(32);
  if (begin < header_bytes) fail(24, "the XML part cannot stand at byte " + std::to_string(begin), damaged);
  const E57Part part = e57_part(file, begin, length, "the XML part");
  if (length > most_xml_bytes) fail(32, "the XML part of " + std::to_string(length) + " bytes is too long", damaged);
  E57PageCheck(file, {0, header_bytes}).rest();
  return read_e57_content(file, part, "the XML part");
}

bool has(std::string_view xml, std::string_view word) {
  return xml.find(word) != std::string_view::npos;
}

/// The bracket that ends a tag; brackets in quotes are none.
std::size_t end_of_tag(std::string_view xml, std::size_t at) {
  char quote = 0;
  for (; at < xml.size(); ++at) {
    const char c = xml[at];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at;
    }
  }
  return std::string_view::npos;
}

/// The last bracket of what begins at `at`: a tag, a comment, CDATA or an instruction.
std::size_t end_of_markup(std::string_view xml, std::size_t at) {
  const std::string_view rest = xml.substr(at);
  const auto behind = [&](std::string_view end) {
    const std::size_t found = xml.find(end, at);
    return found == std::string_view::npos ? found : found + end.size() - 1;
  };
  if (rest.starts_with("<![CDATA[")) return behind("]]>");
  if (rest.starts_with("<!--")) return behind("-->");
  if (rest.starts_with("<?")) return behind("?>");
  return end_of_tag(xml, at);
}

/// Greatest number of elements around one another, told from the brackets alone.
int depth_of(std::string_view xml) {
  int depth = 0;
  int greatest = 0;
  for (std::size_t at = xml.find('<'); at != std::string_view::npos && at + 1 < xml.size(); at = xml.find('<', at)) {
    const std::size_t close = end_of_markup(xml, at);
    if (close == std::string_view::npos) break;
    const char kind = xml[at + 1];
    if (kind == '/') {
      --depth;
    } else if (kind != '?' && kind != '!' && xml[close - 1] != '/') {
      greatest = std::max(greatest, ++depth);
    }
    at = close;
  }
  return greatest;
}

}  // namespace

std::string read_plain_e57_xml(const InputFile& file) {
  std::string all = read_xml(file);
  std::string_view xml = all;
  const auto fail = [&](const std::string& words) {
    throw Error(words, file.name() + ": XML part", "export the scan again with another program");
  };
  if (xml.starts_with("\xEF\xBB\xBF")) xml.remove_prefix(3);
  const std::string_view declaration = xml.substr(0, xml.find("?>"));
  if (!xml.starts_with("<")) throw Error("the XML part does not begin as XML", file.name() + ": XML part", damaged);
  if (has(xml, std::string_view("\0", 1)) || (declaration.starts_with("<?xml") && has(declaration, "encoding") &&
                                              !has(declaration, "UTF-8") && !has(declaration, "utf-8")))
    fail("the XML is not UTF-8");
  if (has(xml, "<!DOCTYPE")) fail("the XML has a document type, which E57 forbids");
  if (has(xml, "schemaLocation") || has(xml, "SchemaLocation")) fail("the XML names a schema to be fetched");
  if (depth_of(xml) > deepest) fail("the elements are nested more than " + std::to_string(deepest) + " deep");
  return all;
}

std::vector<std::uint64_t> e57_record_places(const std::string& xml) {
  pugi::xml_document document;
  document.load_buffer(xml.data(), xml.size(), pugi::parse_minimal);  // what it cannot read, the library refuses
  std::vector<std::uint64_t> places;
  for (const pugi::xml_node scan : document.document_element().child("data3D").children())
    if (scan.type() == pugi::node_element) places.push_back(scan.child("points").attribute("fileOffset").as_ullong());
  return places;
}

}  // namespace adit::io
