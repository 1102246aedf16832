// adit info FILE...: what a file holds.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "app/command_line/command.h"
#include "app/command_line/summary.h"
#include "app/run_job.h"
#include "core/foundation/error.h"
#include "io/control_csv.h"
#include "io/file_ending.h"
#include "io/json_place.h"
#include "io/kof.h"
#include "io/read_axis.h"
#include "io/read_profile.h"
#include "io/read_rings.h"
#include "io/scan_formats.h"
#include "io/targets_csv.h"
#include "io/text_place.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

json numbers(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

json numbers(const Pose& pose) {
  json rows = json::array();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) rows.push_back(pose.matrix()(r, c));
  return rows;
}

/// Two digits, for numbers that are not known better.
double about(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.1e", value);
  return std::strtod(digits, nullptr);
}

json density_json(const io::PointDensity& density) {
  json out{{"points_per_m2", about(density.points_per_m2)}, {"spacing_mm", about(1000.0 * density.spacing_m())}};
  out["distance_m"] = density.distance_m ? json(*density.distance_m) : json(nullptr);
  return out;
}

json scan_json(const io::ScanSummary& scan) {
  json out{{"name", scan.name}, {"points", scan.points}};
  if (scan.points_estimated) out["points_estimated"] = true;
  if (scan.no_returns) out["no_returns"] = *scan.no_returns;
  out["pose"] = scan.pose ? numbers(*scan.pose) : json(nullptr);
  out["min"] = scan.box.isEmpty() ? json(nullptr) : numbers(scan.box.min());
  out["max"] = scan.box.isEmpty() ? json(nullptr) : numbers(scan.box.max());
  if (!scan.box_from.empty()) out["box_from"] = scan.box_from;
  out["attributes"] = scan.attributes;
  if (scan.columns > 0) out["raster"] = {{"columns", scan.columns}, {"rows", scan.rows}};
  if (scan.density) out["density"] = density_json(*scan.density);
  if (scan.sampled_points > 0) out["sampled_points"] = scan.sampled_points;
  return out;
}

/// A fact that is said several times (comments) becomes a list.
json header_json(const std::vector<io::HeaderFact>& facts) {
  json out = json::object();
  for (const io::HeaderFact& fact : facts) {
    if (!out.contains(fact.name))
      out[fact.name] = fact.text;
    else if (out[fact.name].is_array())
      out[fact.name].push_back(fact.text);
    else
      out[fact.name] = {out[fact.name], fact.text};
  }
  return out;
}

json scan_info(const fs::path& file, Progress& progress) {
  const io::ScanFileSummary summary = io::summarise_scan_file(file, progress);
  json out{{"file", file.string()}, {"format", summary.format}};
  if (!summary.header.empty()) out["header"] = header_json(summary.header);
  out["scans"] = json::array();
  for (const io::ScanSummary& scan : summary.scans) out["scans"].push_back(scan_json(scan));
  return out;
}

json findings_info(const Findings& findings) {
  json list = json::array();
  for (const Finding& finding : findings) list.push_back(finding.subject + ": " + finding.words);
  return list;
}

/// Formats that state no chainages are shown from 0 on.
json axis_info(const fs::path& file, const std::optional<double>& start_chainage_m = std::nullopt) {
  const io::AxisFile content = io::read_axis(file, start_chainage_m);
  json out{{"file", file.string()}, {"format", content.format}, {"alignments", json::array()}};
  for (const auto& alignment : content.axes) {
    json one{{"name", alignment.name}};
    if (alignment.axis) {
      const HorizontalAlignment& plan = alignment.axis->horizontal();
      one["from"] = plan.from_m();
      one["to"] = plan.to_m();
      one["elements"] = plan.elements().size();
      one["grade_points"] = alignment.axis->vertical().points().size();
      one["station_equations"] = alignment.axis->stations().equations().size();
      one["cant_stations"] = alignment.axis->cant().stations().size();
    }
    if (alignment.refusal) one["refused"] = alignment.refusal->what();
    if (alignment.grade_refusal) one["grade_refused"] = alignment.grade_refusal->what();
    one["findings"] = findings_info(alignment.findings);
    out["alignments"].push_back(one);
  }
  out["findings"] = findings_info(content.findings);
  return out;
}

json profile_info(const fs::path& file) {
  const Profile profile = io::read_profile(file);
  const auto box = profile.box();
  return {{"file", file.string()},
          {"format", "profile"},
          {"segments", profile.segments().size()},
          {"area_m2", profile.area_m2()},
          {"length_m", profile.length_m()},
          {"width_m", box.sizes().x()},
          {"height_m", box.sizes().y()}};
}

json kof_info(const fs::path& file) {
  const io::KofFile kof = io::read_kof(file);
  json out{{"file", file.string()}, {"format", "KOF"}, {"points", kof.points.size()}, {"lines", kof.lines.size()}};
  if (!kof.lines.empty()) out["alignments"] = axis_info(file, 0.0)["alignments"];
  out["findings"] = findings_info(kof.findings);
  return out;
}

/// A drawing holds an axis or a profile: an open line is an axis.
json dxf_info(const fs::path& file) {
  try {
    return profile_info(file);
  } catch (const Error&) {
    try {
      return axis_info(file, 0.0);
    } catch (const Error&) {
    }
    throw;
  }
}

json job_info(const fs::path& file, Progress& progress) {
  RunOptions options;
  options.only_take_up = true;
  const auto state = run_job(file, options, progress);
  json out{{"file", file.string()},
           {"format", "job"},
           {"name", state->job.name},
           {"scans", json::array()},
           {"steps", json::object()}};
  for (const JobScan& scan : state->job.scans) out["scans"].push_back(scan.name + " (" + scan.file + ")");
  for (const Step& step : all_steps()) {
    const bool fresh = std::any_of(state->results.timing.begin(), state->results.timing.end(),
                                   [&](const StepTime& time) { return time.step == step.name; });
    out["steps"][step.name] = !step.wanted(*state) ? "nothing to do" : fresh ? "up to date" : "to be run";
  }
  return out;
}

/// First line with text, in lower case, to tell tables apart.
std::string table_header(const fs::path& file) {
  io::LineReader lines(file);
  if (!lines.next_with_text()) return {};
  std::string header(lines.line());
  std::transform(header.begin(), header.end(), header.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return header;
}

json rings_info(const fs::path& file) {
  const io::RingFile content = io::read_rings(file, 0.0);
  std::set<std::string> rings;
  for (const RingPoint& point : content.points) rings.insert(point.ring);
  return {{"file", file.string()},
          {"format", "rings"},
          {"rings", rings.size()},
          {"points", content.points.size()},
          {"findings", findings_info(content.findings)}};
}

json table_info(const fs::path& file, Progress& progress) {
  const std::string header = table_header(file);
  const auto starts = [&](const char* word) { return header.find(word) != std::string::npos; };
  if (starts("scan") && starts("id"))
    return {{"file", file.string()}, {"format", "targets"}, {"targets", io::read_targets_csv(file).size()}};
  if ((starts("ring") || starts("profile")) && starts("point") && starts("east")) return rings_info(file);
  if (starts("id") && starts("east"))
    return {{"file", file.string()}, {"format", "control"}, {"points", io::read_control_csv(file).size()}};
  if (starts("offset") && starts("height")) return profile_info(file);
  if (starts("chain") && starts("east") && starts("north")) return axis_info(file);
  return scan_info(file, progress);
}

json info(const fs::path& file, Progress& progress) {
  if (!fs::exists(file)) throw Error("there is no such file", file.string(), "check the path");
  const std::string ending = io::lower_ending(file);
  if (ending == ".json" && !fs::is_directory(file) && io::parse_json_file(file).contains("pieces"))
    return profile_info(file);
  if (fs::is_directory(file) || ending == ".json") return job_info(file, progress);
  if (ending == ".xml" || ending == ".landxml" || ending == ".ifc") return axis_info(file);
  if (ending == ".kof") return kof_info(file);
  if (ending == ".dxf") return dxf_info(file);
  if (ending == ".csv" || ending == ".txt") return table_info(file, progress);
  return scan_info(file, progress);
}

/// What others wrote, for the terminal: printing letters, and not too many.
std::string one_line(std::string text) {
  constexpr std::size_t longest = 300;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = '?';
  return text.size() <= longest ? text : text.substr(0, longest) + " ...";
}

std::string plain(const json& value) {
  if (value.is_string()) return one_line(value.get<std::string>());
  if (value.is_null()) return "-";
  if (value.is_number_float()) {
    char number[40];
    std::snprintf(number, sizeof number, "%.10g", value.get<double>());
    return number;
  }
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const auto& one : value) text += (text.empty() ? "" : " ") + plain(one);
  return text;
}

std::string density_words(const json& density) {
  return "about " + plain(density["points_per_m2"]) + " points/m2" +
         (density["distance_m"].is_null() ? "" : " at " + plain(density["distance_m"]) + " m") + ", spacing about " +
         plain(density["spacing_mm"]) + " mm";
}

/// Keys and values, indented; lists of objects one below the other.
void print_plain(const json& object, int indent) {
  for (const auto& [key, value] : object.items()) {
    if (key == "density") {
      std::printf("%*s%s: %s\n", indent, "", key.c_str(), density_words(value).c_str());
    } else if (value.is_object()) {
      std::printf("%*s%s:\n", indent, "", key.c_str());
      print_plain(value, indent + 2);
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      for (const auto& one : value) {
        std::printf("%*s%s\n", indent, "", key.substr(0, key.size() - 1).c_str());
        print_plain(one, indent + 2);
      }
    } else if (value.is_array() && !value.empty() && value.front().is_string() && key == "findings") {
      for (const auto& one : value) std::printf("%*s- %s\n", indent, "", one.get<std::string>().c_str());
    } else if (!(value.is_array() && value.empty())) {
      std::printf("%*s%s: %s\n", indent, "", key.c_str(), plain(value).c_str());
    }
  }
}

void print(const json& content, bool as_json) {
  if (as_json)
    std::printf("%s\n", content.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
  else
    print_plain(content, 0);
}

}  // namespace

Action declare_info(CLI::App& command) {
  auto files = std::make_shared<std::vector<std::string>>();
  command.add_option("FILE", *files, "scans, alignments, profiles, control files, jobs")->required()->check(some_name);
  return [files](const CommonOptions& common, Progress& progress) {
    BadFiles bad;
    for (const std::string& file : *files) {
      try {
        print(info(file, progress), common.json);
      } catch (const Error& error) {
        bad.errors.push_back(error);
      } catch (const fs::filesystem_error& error) {
        bad.errors.emplace_back(error.code().message(), file, "check the name and the permissions");
      }
    }
    if (!bad.errors.empty()) throw bad;
    return exit_good;
  };
}

}  // namespace adit::app
