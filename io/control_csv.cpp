#include "io/control_csv.h"

#include <map>

#include "core/foundation/error.h"
#include "io/csv_rows.h"
#include "io/text_line.h"

namespace adit::io {

std::vector<ControlPoint> read_control_csv(const std::filesystem::path& file) {
  const std::string form = "id,east,north,elevation";
  CsvRows rows(file, CsvRows::Blanks::belong_to_words, 1);
  std::vector<ControlPoint> points;
  std::map<std::string, int> line_of_id;
  while (rows.next()) {
    if (points.empty()) {
      rows.expect_metres();
      rows.expect_header({"inp#", "ex", "ny", "ezhl"}, form);
    }
    rows.expect_fields(4, 4, form);
    ControlPoint point{rows.text(0), {rows.coordinate(1), rows.coordinate(2), rows.coordinate(3)}};
    if (point.id.empty()) rows.lines().fail(rows.fields()[0], "the point has no id", "give every point an id");
    const auto [before, is_new] = line_of_id.emplace(point.id, rows.lines().line_number());
    if (!is_new) {
      rows.lines().fail(
          rows.fields()[0],
          "point " + quoted_word(point.id) + " is given twice, first in line " + std::to_string(before->second),
          "keep one of them");
    }
    points.push_back(std::move(point));
  }
  if (points.empty()) throw Error("the file holds no control points", file.string(), "write " + form);
  return points;
}

std::string control_csv_text(const std::vector<ControlPoint>& points) {
  std::string text = "id,east,north,elevation\n";
  for (const ControlPoint& point : points) {
    TextLine line(',');
    line.add(csv_word(point.id));
    for (const double value : point.position) line.add(value, 6);
    text += line.ended();
  }
  return text;
}

}  // namespace adit::io
