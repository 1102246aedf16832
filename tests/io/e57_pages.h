#pragma once
// Edits to E57 files that keep their checksums right, as somebody would make them who wants to hurt.

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace adit::tests {

inline constexpr std::size_t e57_page = 1024;
inline constexpr std::size_t e57_content = 1020;

/// CRC-32C of Castagnoli.
inline std::uint32_t crc32c(const char* bytes, std::size_t count) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0x82F63B78U : 0U);
  }
  return ~crc;
}

/// The content without the checksums.
inline std::string without_checksums(const std::string& file) {
  std::string content;
  for (std::size_t at = 0; at < file.size(); at += e57_page) content += file.substr(at, e57_content);
  return content;
}

/// Pages with right checksums.
inline std::string with_checksums(std::string content) {
  content.resize((content.size() + e57_content - 1) / e57_content * e57_content, '\0');
  std::string file;
  for (std::size_t at = 0; at < content.size(); at += e57_content) {
    const std::uint32_t crc = crc32c(content.data() + at, e57_content);
    file.append(content, at, e57_content);
    for (int shift = 24; shift >= 0; shift -= 8)
      file += static_cast<char>((crc >> static_cast<unsigned>(shift)) & 255U);
  }
  return file;
}

inline std::uint64_t number_at(const std::string& bytes, std::size_t offset) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}
inline void put_number(std::string& bytes, std::size_t offset, std::uint64_t value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// Where the XML begins in the content without checksums.
inline std::size_t xml_begin(const std::string& content) {
  const std::uint64_t physical = number_at(content, 24);
  return physical / e57_page * e57_content + physical % e57_page;
}
inline std::string xml_of(const std::string& file) {
  const std::string content = without_checksums(file);
  return content.substr(xml_begin(content), number_at(content, 32));
}

/// The file with another XML part, which stands at its end.
inline std::string with_xml(const std::string& file, const std::string& xml) {
  std::string content = without_checksums(file);
  content = content.substr(0, xml_begin(content)) + xml;
  put_number(content, 32, xml.size());
  put_number(content, 16, (content.size() + e57_content - 1) / e57_content * e57_page);
  return with_checksums(content);
}

/// The file with the first `from` in its XML replaced; empty when it has none.
inline std::string with_words(const std::string& file, const std::string& from, const std::string& to) {
  std::string xml = xml_of(file);
  const std::size_t at = xml.find(from);
  return at == std::string::npos ? std::string() : with_xml(file, xml.replace(at, from.size(), to));
}

}  // namespace adit::tests
