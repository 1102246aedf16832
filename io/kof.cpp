#include "io/kof.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "io/axis_from_points.h"
#include "io/character_set.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr double least_northing_m = 1e6;  // UTM: 6.4 to 8 million; NTM counts from 1 million

std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

/// What stands between two columns, counted from 0 in characters.
std::string_view columns(std::string_view line, std::size_t from, std::size_t to) {
  const std::size_t begin = character_at(line, from);
  return line.substr(begin, character_at(line, to) - begin);
}

/// Name, code and numbers of a record 05.
struct Row {
  std::string name, code;
  std::vector<Field> numbers;
};

Row row_of(std::string_view line, int line_number) {
  Row row;
  if (line.find('\t') == std::string_view::npos) {
    row.name = trimmed(columns(line, 4, 15));
    row.code = trimmed(columns(line, 15, 24));
    const std::size_t rest = character_at(line, 24);
    split_at_blanks(line.substr(rest), line_number, row.numbers);
    for (Field& field : row.numbers) field.column += static_cast<int>(rest);
    return row;
  }
  std::vector<Field> words;
  split_at_blanks(line, line_number, words);
  const std::size_t first = words.size() > 5 ? 3 : 2;  // with a code or without
  if (words.size() > 1) row.name = words[1].text;
  if (first == 3) row.code = words[2].text;
  if (words.size() > first) row.numbers.assign(words.begin() + static_cast<std::ptrdiff_t>(first), words.end());
  return row;
}

/// Walks through the records.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : lines_(file) {}

  KofFile read() {
    while (lines_.next_with_text()) read_record(as_utf8(std::string(lines_.line())));
    if (open_) fail("a line (record 09 91) does not end", "end it with a record 09 99");
    const int against = !stated_.digit ? std::min(north_first_, east_first_)
                        : stated_.east ? north_first_
                                       : east_first_;
    if (against > 0)
      warn((stated_.digit ? "record 01 says " + std::string(stated_.east ? "east" : "north") + " first, "
                          : std::string("no record 01 says the order of coordinates, ")) +
           std::to_string(against) +
           " points are written the other way: their larger coordinate is taken for the "
           "northing");
    for (const std::string& record : unread_)
      file_.findings.push_back({Severity::note, lines_.file().name(), "not honoured: records " + record, ""});
    if (file_.points.empty())
      throw Error("the file holds no points (records 05)", lines_.file().name(), "export it again as KOF");
    return std::move(file_);
  }

 private:
  void read_record(const std::string& line) {
    const std::string record = trimmed(columns(line, 0, 3));
    if (record == "05") {
      read_point(line);
    } else if (record == "01") {
      read_order(line);
    } else if (record == "09") {
      read_call(line);
    } else if (record != "00") {
      unread_.insert(quoted_word(record));
    }
  }

  /// Of the unit's group, "$12100000000", the first digit says which coordinate comes first: 1 north, 2 east.
  void read_order(const std::string& line) {
    const auto unit = line.find('$');
    if (unit == std::string::npos || unit + 1 >= line.size()) return;
    const char digit = line[unit + 1];
    if (digit != '1' && digit != '2')
      fail("the order of coordinates is " + quoted_word(line.substr(unit, 2)), "write $1 (north first) or $2");
    stated_ = {true, digit == '2'};
  }

  /// Lines; whatever else stands behind 09 is somebody's note.
  void read_call(const std::string& line) {
    const std::string call = trimmed(columns(line, 3, 6));
    if (call == "91") {
      if (open_) fail("a line begins within a line", "end the one before with a record 09 99");
      open_ = true;
      file_.lines.emplace_back();
    } else if (call == "99" || call == "96") {
      if (!open_) fail("a line ends that has not begun", "begin it with a record 09 91");
      open_ = false;
      auto& points = file_.lines.back();
      if (call == "96" && !points.empty()) points.push_back(points.front());
    } else if (call.size() == 2 && call.find_first_not_of("0123456789") == std::string::npos) {
      if (open_) fail("record 09 " + call + " within a line is not supported", "export the line with points alone");
      unread_.insert("09 " + call);
    }
  }

  void read_point(const std::string& line) {
    const Row row = row_of(line, lines_.line_number());
    if (row.numbers.size() < 2) fail("a point needs two coordinates", "write them from column 25 on");
    KofPoint point{row.name, row.code, {}, {}, lines_.place()};
    const double first = coordinate(row.numbers[0]), second = coordinate(row.numbers[1]);
    if (row.numbers.size() > 2) point.elevation_m = coordinate(row.numbers[2]);
    const bool decided = (first >= least_northing_m) != (second >= least_northing_m);
    const bool east_first = decided ? second >= least_northing_m : stated_.east;
    if (decided) ++(east_first ? east_first_ : north_first_);
    point.plan = east_first ? Eigen::Vector2d(first, second) : Eigen::Vector2d(second, first);
    if (open_) file_.lines.back().push_back(file_.points.size());
    file_.points.push_back(std::move(point));
  }

  double coordinate(const Field& field) const {
    const double value = lines_.number(field);
    if (std::abs(value) > 1e8) lines_.fail(field, "a coordinate beyond 100,000 km", "metres are needed");
    return value;
  }

  void warn(const std::string& words) {
    file_.findings.push_back({Severity::warning, lines_.file().name(), words, "have the file exported again"});
  }
  [[noreturn]] void fail(const std::string& what, const std::string& mend) const { lines_.fail(what, mend); }

  LineReader lines_;
  KofFile file_;
  struct {
    bool digit = false;  ///< record 01 says something
    bool east = false;   ///< east first
  } stated_;
  int north_first_ = 0, east_first_ = 0;  ///< points whose numbers decide
  bool open_ = false;
  std::set<std::string> unread_;
};

}  // namespace

KofFile read_kof(const std::filesystem::path& file) {
  return Reader(file).read();
}

std::vector<ControlPoint> control_of(const KofFile& kof) {
  std::vector<ControlPoint> control;
  std::map<std::string, std::string> place_of_name;
  for (const KofPoint& point : kof.points) {
    if (point.name.empty()) throw Error("a point has no name", point.place, "name every point");
    if (!point.elevation_m)
      throw Error("point " + quoted_word(point.name) + " has no elevation", point.place, "control needs all three");
    const auto [before, is_new] = place_of_name.emplace(point.name, point.place);
    if (!is_new)
      throw Error("point " + quoted_word(point.name) + " is given twice, first at " + before->second, point.place,
                  "keep one of them");
    control.push_back({point.name, {point.plan.x(), point.plan.y(), *point.elevation_m}});
  }
  return control;
}

AxisFile axes_of(const KofFile& kof, const std::filesystem::path& file, const std::optional<double>& start_chainage_m) {
  AxisFile read{file.string(), "KOF", {}, kof.findings};
  if (kof.lines.empty())
    throw Error("the file holds points but no line (records 09 91 to 09 99)", file.string(),
                "export the axis as a line, or as a table chainage,east,north,elevation");
  for (const auto& line : kof.lines) {
    ListedPoints points;
    for (const std::size_t i : line) {
      points.plan.push_back(kof.points[i].plan);
      if (kof.points[i].elevation_m) points.elevations_m.push_back(*kof.points[i].elevation_m);
    }
    if (points.elevations_m.size() != points.plan.size()) points.elevations_m.clear();
    read.axes.push_back(
        axis_from_points("line " + std::to_string(read.axes.size() + 1), points, start_chainage_m, file.string()));
  }
  return read;
}

}  // namespace adit::io
