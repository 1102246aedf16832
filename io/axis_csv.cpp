#include "io/axis_csv.h"

#include <algorithm>

#include "io/axis_from_points.h"
#include "io/csv_rows.h"

namespace adit::io {
namespace {

const std::string form = "chainage,east,north,elevation";

struct Columns {
  std::optional<std::size_t> chainage, east, north, elevation;
  std::string unread;
};

bool begins(const std::string& word, std::initializer_list<const char*> with) {
  return std::any_of(with.begin(), with.end(), [&](const char* letters) { return word.starts_with(letters); });
}

Columns columns_of(const std::vector<std::string>& header) {
  Columns columns;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string& word = header[i];
    const auto take = [&](std::optional<std::size_t>& column) {
      if (!column) column = i;
    };
    if (begins(word, {"chain", "sta"})) {
      take(columns.chainage);
    } else if (begins(word, {"el", "height", "z"}) || word == "h") {
      take(columns.elevation);
    } else if (begins(word, {"east"}) || word == "e") {
      take(columns.east);
    } else if (begins(word, {"north"}) || word == "n") {
      take(columns.north);
    } else {
      columns.unread += (columns.unread.empty() ? "" : ", ") + quoted_word(word);
    }
  }
  return columns;
}

Columns columns_in(const CsvRows& rows, const std::filesystem::path& file) {
  if (rows.header().empty()) {
    rows.expect_fields(4, 4, form);
    return {0, 1, 2, 3, ""};
  }
  rows.expect_metres();
  Columns columns = columns_of(rows.header());
  if (!columns.east || !columns.north)
    throw Error("the header names no east and north", file.string(), "write the columns as " + form);
  return columns;
}

}  // namespace

AxisFile read_axis_csv(const std::filesystem::path& file, const std::optional<double>& start_chainage_m) {
  CsvRows rows(file, CsvRows::Blanks::separate, 0);
  Columns columns;
  ListedPoints points;
  while (rows.next()) {
    if (points.plan.empty()) columns = columns_in(rows, file);
    std::size_t needed = 0;
    for (const auto& column : {columns.chainage, columns.east, columns.north, columns.elevation})
      if (column) needed = std::max(needed, *column + 1);
    rows.expect_fields(needed, 1000, form);
    points.plan.emplace_back(rows.coordinate(*columns.east), rows.coordinate(*columns.north));
    if (columns.chainage) points.chainages_m.push_back(rows.coordinate(*columns.chainage));
    if (columns.elevation) points.elevations_m.push_back(rows.coordinate(*columns.elevation));
  }
  if (points.plan.empty()) throw Error("the file holds no points", file.string(), "write " + form);
  AxisFile read{file.string(), "table of points", {}, {}};
  read.axes.push_back(axis_from_points(file.stem().string(), points, start_chainage_m, file.string()));
  if (!columns.unread.empty())
    read.findings.push_back({Severity::note, file.string(), "not honoured: columns " + columns.unread, ""});
  return read;
}

}  // namespace adit::io
