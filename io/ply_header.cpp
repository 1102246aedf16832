#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "core/foundation/error.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::size_t longest_header_bytes = std::size_t{1} << 20;

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> type_names = {{{"char", PlyType::int8},
                                                  {"int8", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"uint8", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"int16", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"int32", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"float32", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"float64", PlyType::float64}}};

struct TargetName {
  std::string_view name;
  PlyTarget target;
};
constexpr std::array<TargetName, 19> target_names = {{{"x", PlyTarget::x},
                                                      {"y", PlyTarget::y},
                                                      {"z", PlyTarget::z},
                                                      {"intensity", PlyTarget::intensity},
                                                      {"scalar_intensity", PlyTarget::intensity},
                                                      {"reflectance", PlyTarget::intensity},
                                                      {"scalar_reflectance", PlyTarget::intensity},
                                                      {"red", PlyTarget::red},
                                                      {"green", PlyTarget::green},
                                                      {"blue", PlyTarget::blue},
                                                      {"diffuse_red", PlyTarget::red},
                                                      {"diffuse_green", PlyTarget::green},
                                                      {"diffuse_blue", PlyTarget::blue},
                                                      {"nx", PlyTarget::nx},
                                                      {"ny", PlyTarget::ny},
                                                      {"nz", PlyTarget::nz},
                                                      {"normal_x", PlyTarget::nx},
                                                      {"normal_y", PlyTarget::ny},
                                                      {"normal_z", PlyTarget::nz}}};

/// Walks through the header's lines; each function takes one kind of line.
class HeaderParser {
 public:
  explicit HeaderParser(const InputFile& file) : file_(file), text_(file.beginning(longest_header_bytes)) {}

  PlyHeader parsed() {
    if (!next_line() || words_.size() != 1 || words_[0].text != "ply")
      fail("this is no PLY file", "check the file's ending");
    bool has_format = false;
    while (true) {
      if (!next_line()) fail("the header has no end_header", "the file is cut short; copy or export it again");
      if (words_.empty()) continue;
      const std::string_view word = words_[0].text;
      if (word == "end_header") break;
      if (word == "comment" || word == "obj_info") {
        if (words_.size() > 1)
          header_.comments.emplace_back(words_[1].text.data(), words_.back().text.data() + words_.back().text.size());
        continue;
      }
      if (word == "format") {
        take_format();
        has_format = true;
      } else if (word == "element") {
        take_element();
      } else if (word == "property") {
        take_property();
      } else {
        fail("unknown header word " + quoted_word(word), "the header is damaged; export the file again");
      }
    }
    if (!has_format) fail("the header has no format line", "export the file again");
    header_.body_offset = next_;
    header_.body_line = line_ + 1;
    return std::move(header_);
  }

 private:
  bool next_line() {
    const std::size_t end = text_.find('\n', next_);
    if (end == std::string::npos) return false;
    std::string_view line = std::string_view(text_).substr(next_, end - next_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    next_ = end + 1;
    split_at_blanks(line, ++line_, words_);
    return true;
  }

  void take_format() {
    const std::string_view kind = words_.size() > 1 ? words_[1].text : std::string_view();
    header_.ascii = kind == "ascii";
    header_.order = kind == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (!header_.ascii && kind != "binary_big_endian" && kind != "binary_little_endian")
      fail("unknown format " + quoted_word(kind), "export as ascii, binary_little_endian or binary_big_endian");
  }

  void take_element() {
    PlyElement element;
    if (words_.size() != 3) fail("an element needs a name and a count", "export the file again");
    element.name = words_[1].text;
    const std::string_view count = words_[2].text;
    const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (result.ec != std::errc{} || result.ptr != count.data() + count.size())
      fail("a count is needed, found " + quoted_word(count), "export the file again");
    header_.elements.push_back(std::move(element));
  }

  void take_property() {
    if (header_.elements.empty()) fail("a property stands before any element", "export the file again");
    const bool is_list = words_.size() > 1 && words_[1].text == "list";
    if (words_.size() != (is_list ? 5U : 3U)) fail("a property needs a type and a name", "export the file again");
    PlyProperty property;
    if (is_list) property.list_count = type_of(words_[2].text);
    property.type = type_of(words_[is_list ? 3 : 1].text);
    property.name = words_.back().text;
    std::transform(property.name.begin(), property.name.end(), property.name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type_of(std::string_view name) const {
    for (const TypeName& known : type_names)
      if (known.name == name) return known.type;
    fail("unknown type " + quoted_word(name), "export with float or double coordinates");
  }

  [[noreturn]] void fail(const std::string& what_is_wrong, const std::string& mend) const {
    throw Error(what_is_wrong, file_.name() + ":" + std::to_string(std::max(line_, 1)), mend);
  }

  const InputFile& file_;
  std::string text_;
  std::size_t next_ = 0;
  int line_ = 0;
  std::vector<Field> words_;
  PlyHeader header_;
};

std::size_t vertex_element(const InputFile& file, const PlyHeader& header) {
  std::size_t found = header.elements.size();
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    if (header.elements[i].name != "vertex") continue;
    if (found < header.elements.size()) throw Error("two elements are called vertex", file.name(), "export it again");
    found = i;
  }
  if (found == header.elements.size())
    throw Error("the file has no element vertex, so no points", file.name(), "export it again with its points");
  return found;
}

void expect_coordinates(const InputFile& file, const PlyElement& vertex) {
  for (const TargetName& wanted : target_names) {
    const auto count = std::count_if(
        vertex.properties.begin(), vertex.properties.end(),
        [&](const PlyProperty& property) { return !property.list_count && property.name == wanted.name; });
    if (count > 1)
      throw Error("the property " + std::string(wanted.name) + " of vertex is there twice", file.name(),
                  "export it again");
    if (count == 0 && wanted.target <= PlyTarget::z)
      throw Error("the points have no " + std::string(wanted.name), file.name(), "export it again with x, y and z");
  }
}

/// Every count against the bytes there are.
void expect_rows(const InputFile& file, const PlyHeader& header) {
  std::uint64_t offset = header.body_offset;
  bool exact = !header.ascii;
  for (const PlyElement& element : header.elements) {
    // A row of text holds a letter and an end for each value at least; the last line may lack its end.
    const std::uint64_t row =
        header.ascii ? std::max<std::uint64_t>(1, 2 * element.properties.size()) - 1 : element.row_bytes();
    const std::string what = element.name == "vertex" ? "points" : "rows of " + element.name;
    file.expect_records(offset, element.count, std::max<std::uint64_t>(row, 1), what);
    offset += element.count * row;
    exact = exact && !element.has_lists();
  }
  const std::uint64_t row = std::max<std::uint64_t>(header.elements[header.vertex].row_bytes(), 1);
  if (exact && file.size() - offset >= row)
    throw Error("the file holds " + std::to_string(file.size() - offset) + " bytes more than its header says (" +
                    std::to_string(header.elements[header.vertex].count) + " points of " + std::to_string(row) +
                    " bytes)",
                file.at_byte(offset), "the header is damaged; export the file again");
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

void ply_values(PlyType type, std::endian order, const std::byte* from, std::size_t stride, std::size_t count,
                double* to) {
  const auto convert = [&]<typename T>(T) {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<double>(stored_as<T>(order, from + i * stride));
  };
  switch (type) {
    case PlyType::int8:
      return convert(std::int8_t{});
    case PlyType::uint8:
      return convert(std::uint8_t{});
    case PlyType::int16:
      return convert(std::int16_t{});
    case PlyType::uint16:
      return convert(std::uint16_t{});
    case PlyType::int32:
      return convert(std::int32_t{});
    case PlyType::uint32:
      return convert(std::uint32_t{});
    case PlyType::float32:
      return convert(float{});
    case PlyType::float64:
      return convert(double{});
  }
}

double ply_value(PlyType type, std::endian order, const std::byte* from) {
  double value = 0.0;
  ply_values(type, order, from, 0, 1, &value);
  return value;
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.list_count.has_value(); });
}

std::uint64_t PlyElement::row_bytes() const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += size_of(property.list_count.value_or(property.type));
  return bytes;
}

PlyHeader read_ply_header(const InputFile& file) {
  PlyHeader header = HeaderParser(file).parsed();
  header.vertex = vertex_element(file, header);
  expect_coordinates(file, header.elements[header.vertex]);
  expect_rows(file, header);
  if (header.elements[header.vertex].count == 0)
    throw Error("the scan holds no points", file.name(), "export the scan again with its points");
  return header;
}

PlyTarget ply_target(const std::string& property_name) {
  for (const TargetName& known : target_names)
    if (known.name == property_name) return known.target;
  return PlyTarget::none;
}

Attributes ply_attributes(const PlyElement& vertex) {
  std::array<bool, 11> has{};
  for (const PlyProperty& property : vertex.properties)
    if (!property.list_count) has[static_cast<std::size_t>(ply_target(property.name))] = true;
  const auto all = [&](PlyTarget first, PlyTarget last) {
    return std::all_of(has.begin() + static_cast<int>(first), has.begin() + static_cast<int>(last) + 1,
                       [](bool is) { return is; });
  };
  return {all(PlyTarget::intensity, PlyTarget::intensity), all(PlyTarget::red, PlyTarget::blue),
          all(PlyTarget::nx, PlyTarget::nz)};
}

}  // namespace adit::io
