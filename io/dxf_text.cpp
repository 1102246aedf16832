// The grammar of a DXF text: pairs of lines, a group code and its value.
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "core/foundation/error.h"
#include "io/dxf_entities.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

Field trimmed(const LineReader& lines) {
  const std::string_view line = lines.line();
  const auto begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {{}, lines.line_number(), 1};
  const auto end = line.find_last_not_of(" \t");
  return {line.substr(begin, end - begin + 1), lines.line_number(), static_cast<int>(begin) + 1};
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

bool holds_real(int code) {
  return (code >= 10 && code <= 59) || (code >= 140 && code <= 149) || (code >= 210 && code <= 239);
}

/// Codes by which an entity says how many places or values follow: the library takes memory for as many.
bool is_count(std::string_view entity, int code) {
  if (entity == "LWPOLYLINE") return code == 90;
  if (entity == "SPLINE") return code >= 72 && code <= 74;
  if (entity == "LEADER") return code == 76;
  return entity == "HATCH" && code >= 91 && code <= 98;
}

/// Walks through the pairs, keeping section and entity.
class DxfPairs {
 public:
  explicit DxfPairs(const std::filesystem::path& file) : lines_(file) {}

  void check() {
    if (lines_.file().beginning(22).starts_with("AutoCAD Binary DXF")) {
      throw Error("the drawing is a binary DXF", lines_.file().name(), "save it as ASCII DXF");
    }
    while (lines_.next()) {
      const Field code_field = trimmed(lines_);
      const auto code = whole_number(code_field.text);
      if (!code) {
        lines_.fail(code_field, "a group code is needed, found " + quoted_word(code_field.text),
                    "save the drawing again");
      }
      if (!lines_.next()) break;
      if (check_value(*code, trimmed(lines_))) return;
    }
    throw Error("the drawing is cut off: it does not end with EOF", lines_.file().name(), "copy or save it again");
  }

 private:
  /// True at the end of the drawing.
  bool check_value(int code, const Field& value) {
    if (code == 0) {
      entity_ = value.text;
      return value.text == "EOF";
    }
    if (code == 2 && entity_ == "SECTION") section_ = value.text;
    if (section_ != "HEADER" && section_ != "ENTITIES" && section_ != "BLOCKS") return false;
    if (holds_real(code)) lines_.number(value);
    if (section_ != "HEADER" && is_count(entity_, code)) {
      const std::uint64_t count = lines_.count(value);
      if (count > lines_.file().size())
        lines_.fail(value, "more places are announced than the file holds", "save it again");
    }
    return false;
  }

  LineReader lines_;
  std::string section_;
  std::string entity_;
};

}  // namespace

void check_dxf_text(const std::filesystem::path& file) {
  DxfPairs(file).check();
}

}  // namespace adit::io
