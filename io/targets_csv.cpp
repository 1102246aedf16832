#include "io/targets_csv.h"

#include <map>
#include <utility>

#include "core/foundation/error.h"
#include "io/csv_rows.h"
#include "io/text_line.h"

namespace adit::io {

std::vector<TargetObservation> read_targets_csv(const std::filesystem::path& file) {
  const std::string form = "scan,id,x,y,z";
  CsvRows rows(file, CsvRows::Blanks::belong_to_words, 2);
  std::vector<TargetObservation> targets;
  std::map<std::pair<std::string, std::string>, int> line_of_target;
  while (rows.next()) {
    if (targets.empty()) rows.expect_header({"s", "itnp#", "x", "y", "z"}, form);
    rows.expect_fields(5, 5, form);
    TargetObservation target{rows.text(0), rows.text(1), {rows.coordinate(2), rows.coordinate(3), rows.coordinate(4)}};
    if (target.scan.empty()) rows.lines().fail(rows.fields()[0], "the target has no scan", "name the scan");
    if (target.id.empty()) rows.lines().fail(rows.fields()[1], "the target has no id", "give every target an id");
    const auto [before, is_new] = line_of_target.emplace(std::pair(target.scan, target.id), rows.lines().line_number());
    if (!is_new) {
      rows.lines().fail(rows.fields()[1],
                        "target " + quoted_word(target.id) + " of scan " + quoted_word(target.scan) +
                            " is given twice, first in line " + std::to_string(before->second),
                        "keep one of them");
    }
    targets.push_back(std::move(target));
  }
  if (targets.empty()) throw Error("the file holds no targets", file.string(), "write " + form);
  return targets;
}

std::string targets_csv_text(const std::vector<TargetObservation>& targets) {
  std::string text = "scan,id,x,y,z\n";
  for (const TargetObservation& target : targets) {
    TextLine line(',');
    line.add(csv_word(target.scan)).add(csv_word(target.id));
    for (const double value : target.position) line.add(value, 6);
    text += line.ended();
  }
  return text;
}

}  // namespace adit::io
