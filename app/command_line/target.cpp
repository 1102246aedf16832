// adit target print|detect|locate|calibrate: coded targets on paper, in pictures, and cameras placed by them.

#include "app/command_line/target.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "app/landmarks.h"
#include "core/georeference/coded_pattern.h"

namespace adit::app {

namespace {

/// Those within stay: "1 2" is no id 12.
std::string_view without_spaces_about(std::string_view word) {
  while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
  while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
  return word;
}

}  // namespace

std::vector<int> ids_of(const std::string& words) {
  std::vector<int> ids;
  std::size_t at = 0;
  while (at <= words.size()) {
    const std::size_t comma = std::min(words.find(',', at), words.size());
    const std::string part = words.substr(at, comma - at);
    const std::size_t dash = part.find('-');
    const auto first = target_id(without_spaces_about(std::string_view(part).substr(0, dash)));
    const auto last =
        dash == std::string::npos ? first : target_id(without_spaces_about(std::string_view(part).substr(dash + 1)));
    if (!first || !last || *last < *first)
      throw Error("\"" + part + "\" names no ids", "--ids",
                  "write for instance 1-40,57; ids run from 1 to " + std::to_string(target_code_count));
    for (int id = *first; id <= *last; ++id) ids.push_back(id);
    at = comma + 1;
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

double length_m_of(const std::string& words, const char* option) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), value);
  const std::string unit(end, words.data() + words.size());
  const double metres = unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : unit == "m" ? 1.0 : unit == "in" ? 0.0254 : 0.0;
  if (error != std::errc() || metres == 0.0 || !std::isfinite(value) || value <= 0.0)
    throw Error("\"" + words + "\" is no length", option, "write one with its unit, for instance 150mm");
  return value * metres;
}

Action declare_target(CLI::App& command) {
  struct Part {
    const char* name;
    const char* words;
    Action (*declare)(CLI::App&);
  };
  command.require_subcommand(1);
  auto parts = std::make_shared<std::vector<std::pair<CLI::App*, Action>>>();
  for (const Part& part :
       {Part{"print", "targets on paper, or a board for calibration", declare_target_print},
        Part{"detect", "find and read targets in pictures", declare_target_detect},
        Part{"locate", "where the camera stood, from surveyed targets in its pictures", declare_target_locate},
        Part{"calibrate", "a camera's lens from pictures of a board", declare_target_calibrate}}) {
    CLI::App* sub = command.add_subcommand(part.name, part.words);
    sub->fallthrough();  // --json and --quiet are the command's
    parts->emplace_back(sub, part.declare(*sub));
  }
  return [parts](const CommonOptions& common, Progress& progress) {
    for (const auto& [sub, action] : *parts)
      if (sub->parsed()) return action(common, progress);
    return exit_bad_input;
  };
}

}  // namespace adit::app
