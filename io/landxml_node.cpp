#include "io/landxml_node.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/bytes.h"
#include "io/character_set.h"
#include "io/landxml_units.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t largest_file_bytes = std::uint64_t{1} << 30;

/// The whole file as UTF-8.
std::string read_text(const std::filesystem::path& path) {
  const InputFile file(path);
  if (file.size() > largest_file_bytes) {
    throw Error("the file is larger than 1 GiB", file.name(), "export the alignments alone");
  }
  std::string text(static_cast<std::size_t>(file.size()), '\0');
  text.resize(file.read_some(0, text.data(), text.size()));
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw Error("the text is UTF-16", file.name(), "save it as UTF-8");
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return as_utf8(std::move(text));
}

std::string_view local_name(std::string_view name) {
  const auto colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return text;
}

std::optional<double> finite_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_infinity(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  std::string word;
  for (const char c : text) word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word == "inf" || word == "infinity";
}

}  // namespace

LandXmlDocument::LandXmlDocument(const std::filesystem::path& file) : name(file.string()) {
  const std::string text = read_text(file);
  line_starts.push_back(0);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts.push_back(i + 1);
  }
  const auto result = xml.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    throw Error(std::string("the file is not well-formed XML: ") + result.description(), place(result.offset, true),
                "export it again");
  }
  const LandXmlNode root(*this, xml.document_element());
  if (root.name() != "LandXML")
    throw Error("the file is no LandXML: its root is <" + root.name() + ">", name, "export the axis as LandXML");
  units = read_landxml_units(root);
  for (const LandXmlNode& group : root.children("CgPoints")) group.add_points_to(cg_points);
}

std::string LandXmlDocument::place(std::ptrdiff_t offset, bool with_column) const {
  if (offset < 0) return name;
  const auto at = static_cast<std::size_t>(offset);
  const auto behind = std::upper_bound(line_starts.begin(), line_starts.end(), at);
  const std::size_t line = static_cast<std::size_t>(behind - line_starts.begin());
  std::string words = name + ":" + std::to_string(line);
  if (with_column) words += ":" + std::to_string(at - line_starts[line - 1] + 1);
  return words;
}

std::string LandXmlNode::name() const {
  return std::string(local_name(node_.name()));
}

std::vector<LandXmlNode> LandXmlNode::children() const {
  std::vector<LandXmlNode> found;
  for (const pugi::xml_node child : node_.children()) {
    if (child.type() == pugi::node_element) found.emplace_back(*document_, child);
  }
  return found;
}

std::vector<LandXmlNode> LandXmlNode::children(std::string_view name) const {
  std::vector<LandXmlNode> found;
  for (const pugi::xml_node child : node_.children()) {
    if (child.type() == pugi::node_element && local_name(child.name()) == name) found.emplace_back(*document_, child);
  }
  return found;
}

std::optional<LandXmlNode> LandXmlNode::child(std::string_view name) const {
  for (const pugi::xml_node child : node_.children()) {
    if (child.type() == pugi::node_element && local_name(child.name()) == name) return LandXmlNode(*document_, child);
  }
  return std::nullopt;
}

double LandXmlNode::number(const char* attribute) const {
  if (!has(attribute)) fail("<" + name() + "> lacks its " + attribute, "export it with all its attributes");
  const std::string_view text = trimmed(node_.attribute(attribute).value());
  const auto value = finite_number(text);
  if (!value)
    fail(std::string(attribute) + ": a number is needed, found " + quoted_word(text), "write it with a decimal point");
  return *value;
}

std::optional<double> LandXmlNode::optional_number(const char* attribute) const {
  if (!has(attribute)) return std::nullopt;
  return number(attribute);
}

std::optional<double> LandXmlNode::optional_length_m(const char* attribute) const {
  if (!has(attribute)) return std::nullopt;
  return length_m(attribute);
}

double LandXmlNode::curvature_per_m(const char* attribute) const {
  if (is_infinity(trimmed(node_.attribute(attribute).value()))) return 0.0;
  const double radius = length_m(attribute);
  if (radius == 0.0) fail(std::string(attribute) + " is zero", "write INF where the curve is straight");
  return 1.0 / radius;
}

std::vector<double> LandXmlNode::numbers(std::size_t least) const {
  const pugi::xml_text text = node_.text();
  const std::ptrdiff_t begin = text.data().offset_debug();
  const char* const whole = text.get();
  std::vector<double> values;
  for (const char* word = whole; *word != '\0';) {
    word += std::strspn(word, " \t\r\n");
    const std::size_t size = std::strcspn(word, " \t\r\n");
    if (size == 0) break;
    const auto value = finite_number({word, size});
    if (!value) {
      throw Error("<" + name() + ">: a number is needed, found " + quoted_word({word, size}),
                  begin < 0 ? place() : document_->place(begin + (word - whole), true),
                  "write it with a decimal point");
    }
    values.push_back(*value);
    word += size;
  }
  if (values.size() < least) {
    fail("<" + name() + "> holds " + std::to_string(values.size()) + " numbers, " + std::to_string(least) +
             " are needed",
         "write them with blanks between");
  }
  return values;
}

void LandXmlNode::add_points_to(std::map<std::string, pugi::xml_node>& points) const {
  for (const LandXmlNode& point : children("CgPoint"))
    if (point.has("name")) points.emplace(point.text("name"), point.node_);
}

std::optional<Eigen::Vector2d> LandXmlNode::referenced_point_m(const std::string& name) const {
  const auto found = document_->cg_points.find(name);
  if (found == document_->cg_points.end()) return std::nullopt;
  const std::vector<double> values = LandXmlNode(*document_, found->second).numbers(2);
  return units().metres_per_unit * Eigen::Vector2d(values[1], values[0]);
}

std::optional<Eigen::Vector2d> LandXmlNode::optional_point_m(std::string_view child_name) const {
  const auto point = child(child_name);
  if (!point) return std::nullopt;
  if (point->has("pntRef") && point->numbers(0).empty()) {
    const auto referenced = referenced_point_m(point->text("pntRef"));
    if (!referenced)
      point->fail("there is no CgPoint " + quoted_word(point->text("pntRef")), "export the points with the axis");
    return referenced;
  }
  const std::vector<double> values = point->numbers(2);
  return units().metres_per_unit * Eigen::Vector2d(values[1], values[0]);  // "northing easting [elevation]"
}

Eigen::Vector2d LandXmlNode::point_m(std::string_view child_name) const {
  const auto point = optional_point_m(child_name);
  if (!point) fail("<" + name() + "> lacks its <" + std::string(child_name) + ">", "export it with its points");
  return *point;
}

std::string unread_children(const LandXmlNode& node, const std::vector<std::string_view>& known) {
  std::vector<std::pair<std::string, int>> counts;
  for (const LandXmlNode& child : node.children()) {
    const std::string name = child.name();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto found = std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == name; });
    if (found == counts.end())
      counts.emplace_back(name, 1);
    else
      ++found->second;
  }
  std::string words;
  for (const auto& [name, count] : counts) {
    words += (words.empty() ? "" : ", ") + name + " (" + std::to_string(count) + ")";
  }
  return words;
}

}  // namespace adit::io
