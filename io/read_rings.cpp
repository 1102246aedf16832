#include "io/read_rings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "io/csv_rows.h"
#include "io/file_ending.h"
#include "io/landxml_node.h"

namespace adit::io {
namespace {

constexpr double largest_offset_m = 0.5;
const std::string form = "ring,point,east,north,elevation,target_offset";

/// Adds points, each once. Those without a name get #1, #2, ... in their ring.
class Collector {
 public:
  explicit Collector(double target_offset_m) : target_offset_m_(target_offset_m) {}

  template <typename Fail>
  void add(RingPoint point, const std::optional<double>& offset_m, const Fail& fail) {
    if (point.ring.empty()) fail("the point has no ring", "name the ring of every point");
    if (point.point.empty()) do
        point.point = "#" + std::to_string(++unnamed_[point.ring]);
      while (seen_.count({point.ring, point.point}) != 0);
    point.place.target_offset_m = offset_m.value_or(target_offset_m_);
    if (std::abs(point.place.target_offset_m) > largest_offset_m)
      fail("a target offset of more than half a metre", "metres are needed");
    if (!seen_.emplace(point.ring, point.point).second)
      fail("point " + quoted_word(point.point) + " of ring " + quoted_word(point.ring) + " is given twice",
           "keep one of them");
    file_.points.push_back(std::move(point));
  }

  RingFile take(const std::string& file) {
    if (file_.points.empty()) throw Error("the file holds no points of rings", file, "write " + form);
    return std::move(file_);
  }
  Findings& findings() { return file_.findings; }

 private:
  double target_offset_m_;
  RingFile file_;
  std::set<std::pair<std::string, std::string>> seen_;
  std::map<std::string, int> unnamed_;  ///< of each ring
};

/// Where the columns stand: ring, point, east, north, elevation, target offset.
struct Columns {
  std::optional<std::size_t> ring, point, east, north, elevation, offset;
  std::string unread;

  std::size_t needed() const {
    std::size_t most = 0;
    for (const auto& column : {ring, point, east, north, elevation})
      if (column) most = std::max(most, *column + 1);
    return most;
  }
};

Columns columns_of(const std::vector<std::string>& header) {
  Columns columns;
  if (header.empty()) return {0, 1, 2, 3, 4, 5, ""};
  const auto begins = [](const std::string& word, std::initializer_list<const char*> with) {
    return std::any_of(with.begin(), with.end(), [&](const char* letters) { return word.starts_with(letters); });
  };
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string& word = header[i];
    std::optional<std::size_t>* column = nullptr;
    if (begins(word, {"ring", "profile"})) column = &columns.ring;
    if (begins(word, {"point", "id"})) column = &columns.point;
    if (begins(word, {"east"}) || word == "e") column = &columns.east;
    if (begins(word, {"north"}) || word == "n") column = &columns.north;
    if (begins(word, {"elev", "height", "z"}) || word == "h") column = &columns.elevation;
    if (begins(word, {"offset", "target"})) column = &columns.offset;
    if (column != nullptr && !*column)
      *column = i;
    else if (!word.empty())
      columns.unread += (columns.unread.empty() ? "" : ", ") + quoted_word(word);
  }
  return columns;
}

RingFile read_table(const std::filesystem::path& file, double target_offset_m) {
  CsvRows rows(file, CsvRows::Blanks::belong_to_words, 2);
  Collector collector(target_offset_m);
  Columns columns;
  bool first = true;
  while (rows.next()) {
    if (first) {
      rows.expect_metres();
      columns = columns_of(rows.header());
    }
    first = false;
    if (!columns.ring || !columns.east || !columns.north || !columns.elevation)
      throw Error("the header lacks a column", file.string(), "write the columns as " + form);
    rows.expect_fields(columns.needed(), 1000, form);
    RingPoint point{rows.text(*columns.ring), columns.point ? rows.text(*columns.point) : std::string(), {}};
    point.place.position = {rows.coordinate(*columns.east), rows.coordinate(*columns.north),
                            rows.coordinate(*columns.elevation)};
    const bool has_offset =
        columns.offset && *columns.offset < rows.fields().size() && !rows.fields()[*columns.offset].text.empty();
    const auto offset_m = has_offset ? std::optional(rows.number(*columns.offset)) : std::nullopt;
    collector.add(std::move(point), offset_m, [&](const std::string& what, const std::string& mend) {
      rows.lines().fail(rows.fields()[0], what, mend);
    });
  }
  if (!columns.unread.empty())
    collector.findings().push_back({Severity::note, file.string(), "not honoured: columns " + columns.unread, ""});
  return collector.take(file.string());
}

std::optional<double> stated_offset_m(const LandXmlNode& point) {
  for (const LandXmlNode& feature : point.children("Feature"))
    for (const LandXmlNode& property : feature.children("Property"))
      if (property.text("label") == "targetOffset") return property.length_m("value");
  return std::nullopt;
}

RingFile read_document(const std::filesystem::path& file, double target_offset_m) {
  const LandXmlDocument document(file);
  const LandXmlNode root(document, document.xml.document_element());
  Collector collector(target_offset_m);
  for (const LandXmlNode& group : root.children("CgPoints"))
    for (const LandXmlNode& node : group.children("CgPoint")) {
      const std::vector<double> values = node.numbers(3);
      const LandXmlUnits& units = node.units();
      RingPoint point{group.text("name"), node.text("name"), {}};
      point.place.position = {values[1] * units.metres_per_unit, values[0] * units.metres_per_unit,
                              values[2] * units.elevation_metres_per_unit};
      collector.add(std::move(point), stated_offset_m(node),
                    [&](const std::string& what, const std::string& mend) { node.fail(what, mend); });
    }
  return collector.take(document.name);
}

}  // namespace

RingFile read_rings(const std::filesystem::path& file, double target_offset_m) {
  const std::string ending = lower_ending(file);
  return ending == ".xml" || ending == ".landxml" ? read_document(file, target_offset_m)
                                                  : read_table(file, target_offset_m);
}

}  // namespace adit::io
