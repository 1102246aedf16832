#include "io/xyz_columns.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace adit::io {
namespace {

struct TargetName {
  std::string_view name;
  XyzTarget target;
};
constexpr std::array<TargetName, 33> target_names = {{{"x", XyzTarget::x},
                                                      {"e", XyzTarget::x},
                                                      {"east", XyzTarget::x},
                                                      {"easting", XyzTarget::x},
                                                      {"y", XyzTarget::y},
                                                      {"n", XyzTarget::y},
                                                      {"north", XyzTarget::y},
                                                      {"northing", XyzTarget::y},
                                                      {"z", XyzTarget::z},
                                                      {"h", XyzTarget::z},
                                                      {"height", XyzTarget::z},
                                                      {"elev", XyzTarget::z},
                                                      {"elevation", XyzTarget::z},
                                                      {"altitude", XyzTarget::z},
                                                      {"intensity", XyzTarget::intensity},
                                                      {"scalar_intensity", XyzTarget::intensity},
                                                      {"reflectance", XyzTarget::intensity},
                                                      {"i", XyzTarget::intensity},
                                                      {"r", XyzTarget::red},
                                                      {"red", XyzTarget::red},
                                                      {"g", XyzTarget::green},
                                                      {"green", XyzTarget::green},
                                                      {"b", XyzTarget::blue},
                                                      {"blue", XyzTarget::blue},
                                                      {"nx", XyzTarget::nx},
                                                      {"normal_x", XyzTarget::nx},
                                                      {"ny", XyzTarget::ny},
                                                      {"normal_y", XyzTarget::ny},
                                                      {"nz", XyzTarget::nz},
                                                      {"normal_z", XyzTarget::nz},
                                                      {"x_m", XyzTarget::x},
                                                      {"y_m", XyzTarget::y},
                                                      {"z_m", XyzTarget::z}}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// "4,2": digits, one comma, digits.
bool has_decimal_comma(std::string_view word) {
  const auto comma = word.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < word.size() && is_digit(word[comma - 1]) &&
         is_digit(word[comma + 1]) && word.find(',', comma + 1) == std::string_view::npos;
}

struct ColumnName {
  std::string name;  ///< lower case, without quotes and unit
  std::string unit;  ///< from brackets
};

ColumnName column_name(std::string_view text) {
  ColumnName column;
  std::string lower;
  for (const char c : text)
    if (c != '"') lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto bracket = lower.find_first_of("[(");
  column.name = lower.substr(0, bracket);
  while (column.name.ends_with(' ')) column.name.pop_back();
  if (bracket != std::string::npos) {
    const auto end = lower.find_first_of("])", bracket);
    column.unit = lower.substr(bracket + 1, end == std::string::npos ? end : end - bracket - 1);
  }
  return column;
}

std::optional<XyzTarget> target_of(const std::string& name) {
  for (const TargetName& known : target_names)
    if (known.name == name) return known.target;
  return std::nullopt;
}

}  // namespace

Attributes XyzColumns::attributes() const {
  const auto has = [&](XyzTarget target) { return (*this)[target].has_value(); };
  return {has(XyzTarget::intensity), has(XyzTarget::red) && has(XyzTarget::green) && has(XyzTarget::blue),
          has(XyzTarget::nx) && has(XyzTarget::ny) && has(XyzTarget::nz)};
}

char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  if (line.find('\t') != std::string_view::npos) return '\t';
  if (line.find(',') == std::string_view::npos) return blanks;
  std::vector<Field> words;
  split_at_blanks(line, 0, words);
  const bool decimal_commas = words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, [](const Field& word) {
                                return has_decimal_comma(word.text);
                              });
  return decimal_commas ? blanks : ',';
}

std::vector<Field> columns_of_line(LineReader& lines, char separator) {
  std::vector<Field> fields = separator == blanks ? lines.fields_between_blanks() : lines.fields(separator);
  while (!fields.empty() && fields.back().text.empty()) fields.pop_back();
  return fields;
}

bool begins_with_number(const std::vector<Field>& fields) {
  if (fields.empty() || fields[0].text.empty()) return false;
  const std::string_view word = fields[0].text;
  const char first = word[0];
  if (is_digit(first) || first == '.' || first == '+' || first == '-') return true;
  const std::string name = column_name(word).name;
  return name == "nan" || name == "inf";
}

std::optional<XyzColumns> named_columns(const LineReader& lines, const std::vector<Field>& names) {
  XyzColumns columns;
  columns.count = names.size();
  std::optional<std::size_t> twice;
  std::optional<std::size_t> other_unit;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ColumnName column = column_name(names[i].text);
    const std::optional<XyzTarget> target = target_of(column.name);
    if (!target) continue;
    auto& place = columns.of_target[static_cast<std::size_t>(*target)];
    if (place) twice = i;
    if (*target <= XyzTarget::z && !column.unit.empty() && column.unit != "m") other_unit = i;
    place = i;
  }
  if (!columns[XyzTarget::x] || !columns[XyzTarget::y] || !columns[XyzTarget::z]) return std::nullopt;
  if (twice)
    lines.fail(names[*twice], "a second column for " + quoted_word(names[*twice].text), "name each column once");
  if (other_unit)
    lines.fail(names[*other_unit], "coordinates in " + quoted_word(column_name(names[*other_unit].text).unit),
               "export in metres");
  return columns;
}

XyzColumns first_three_columns(std::size_t count) {
  XyzColumns columns;
  columns.count = count;
  for (std::size_t i = 0; i < 3; ++i) columns.of_target[i] = i;
  return columns;
}

}  // namespace adit::io
