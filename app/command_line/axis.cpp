// adit axis FILE: the coordinate list of an axis, or chainage, offset and height of points.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/command_line/command.h"
#include "core/foundation/angle.h"
#include "core/foundation/options.h"
#include "io/csv_rows.h"
#include "io/read_axis.h"
#include "io/read_control.h"
#include "io/text_place.h"

namespace adit::app {
namespace {

using json = nlohmann::ordered_json;

struct Arguments {
  std::string file;
  std::string name;
  std::string points;
  double every_m = 1.0;
  std::optional<double> start_m;
  std::optional<double> from_m, to_m;  ///< of the list
  bool main_points = false;
};

/// A number of the output: how many decimals it is given, and whether there is one.
struct Number {
  const char* key;
  int decimals;
  std::optional<double> value;
};

constexpr int micrometres = 6;

/// Rows on stdout, as CSV or as a list of objects.
class Rows {
 public:
  Rows(bool as_json, bool with_id, const std::vector<Number>& columns) : as_json_(as_json) {
    if (as_json_) return;
    std::string header = with_id ? "id" : "";
    for (const Number& column : columns) header += (header.empty() ? "" : ",") + std::string(column.key);
    std::printf("%s\n", header.c_str());
  }

  void add(const std::optional<std::string>& id, const std::vector<Number>& numbers) {
    if (as_json_) {
      json row = json::object();
      if (id) row["id"] = *id;
      for (const Number& number : numbers) row[number.key] = number.value ? json(rounded(number)) : json(nullptr);
      rows_.push_back(std::move(row));
      return;
    }
    std::string text;
    bool first = true;
    const auto put = [&](const std::string& word) {
      text += (first ? "" : ",") + word;
      first = false;
    };
    if (id) put(io::csv_word(*id));
    for (const Number& number : numbers) put(number.value ? digits(number) : std::string());
    std::printf("%s\n", text.c_str());
  }

  /// The list under its key, with what else is to be said.
  void end(json about, const char* key) {
    if (!as_json_) return;
    about[key] = std::move(rows_);
    std::printf("%s\n", about.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
  }

 private:
  static std::string digits(const Number& number) {
    char text[400];
    const double value = *number.value == 0.0 ? 0.0 : *number.value;  // no minus before nothing
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, number.decimals).ptr};
  }
  static double rounded(const Number& number) {
    const double steps = std::pow(10.0, number.decimals);
    return std::round(*number.value * steps) / steps;
  }

  bool as_json_;
  json rows_ = json::array();
};

/// Both ends, every whole multiple of the interval between them and, if wanted, where elements of the plan begin, where
/// grades meet and where their curves begin and end. Sorted, each once.
std::vector<double> listed_chainages(const Arguments& arguments, const Alignment& axis) {
  constexpr double same_m = 1e-3, most = 1e7;
  const HorizontalAlignment& plan = axis.horizontal();
  const double from_m = std::max(plan.from_m(), arguments.from_m.value_or(plan.from_m()));
  const double to_m = std::min(plan.to_m(), arguments.to_m.value_or(plan.to_m()));
  const double every_m = arguments.every_m;
  if (arguments.from_m && arguments.to_m && *arguments.from_m >= *arguments.to_m)
    throw Error("--to is not greater than --from", "command line", "exchange them");
  if (!(from_m < to_m))
    throw Error("there is nothing of the axis between them", "--from, --to",
                "the axis runs from " + short_number(std::round(1e3 * plan.from_m()) / 1e3) + " to " +
                    short_number(std::round(1e3 * plan.to_m()) / 1e3));
  if ((to_m - from_m) / every_m > most) throw Error("more than 10 million rows", "--every", "use a larger interval");
  std::vector<double> chainages{from_m, to_m};
  for (double k = std::floor(from_m / every_m) + 1.0; k * every_m < to_m; ++k) chainages.push_back(k * every_m);
  if (arguments.main_points) {
    for (std::size_t i = 0; i < plan.elements().size(); ++i) chainages.push_back(plan.element_from_m(i));
    for (std::size_t i = 0; i < axis.vertical().points().size(); ++i) {
      const VerticalAlignment::CurveExtent curve = axis.vertical().curve_extent(i);
      chainages.insert(chainages.end(), {curve.from_m, axis.vertical().points()[i].chainage_m, curve.to_m});
    }
  }
  std::erase_if(chainages, [&](double s) { return s < from_m || s > to_m; });
  std::sort(chainages.begin(), chainages.end());
  chainages.erase(std::unique(chainages.begin(), chainages.end(), [](double a, double b) { return b - a <= same_m; }),
                  chainages.end());
  return chainages;
}

std::vector<Number> row_at(const Alignment& axis, double chainage_m) {
  const PlanPoint plan = axis.horizontal().at(chainage_m);
  const VerticalAlignment& grade = axis.vertical();
  const bool graded = !grade.empty() && chainage_m >= grade.from_m() - 1e-3 && chainage_m <= grade.to_m() + 1e-3;
  const std::optional<VerticalPosition> vertical = graded ? std::optional(grade.at(chainage_m)) : std::nullopt;
  constexpr double last_digit_deg = 0.5e-8;
  double bearing_deg = std::fmod(deg_from_rad(plan.azimuth_rad), 360.0);
  if (bearing_deg < 0.0) bearing_deg += 360.0;
  if (bearing_deg >= 360.0 - last_digit_deg) bearing_deg = 0.0;  // not 360.00000000
  const auto of = [&](double VerticalPosition::*member) {
    return vertical ? std::optional(*vertical.*member) : std::nullopt;
  };
  return {{"chainage", micrometres, chainage_m},
          {"station", micrometres, axis.stations().displayed_m(chainage_m)},
          {"east", micrometres, plan.position.x()},
          {"north", micrometres, plan.position.y()},
          {"elevation", micrometres, of(&VerticalPosition::elevation_m)},
          {"bearing_deg", 8, bearing_deg},
          {"grade", 9, of(&VerticalPosition::grade)},
          {"curvature_per_m", 12, plan.curvature_per_m},
          {"cant_m", micrometres, axis.cant().at(chainage_m).cant_m}};
}

int list_coordinates(const Arguments& arguments, const Alignment& axis, bool as_json) {
  const std::vector<double> chainages = listed_chainages(arguments, axis);
  Rows rows(as_json, false, row_at(axis, chainages.front()));
  for (const double chainage_m : chainages) rows.add(std::nullopt, row_at(axis, chainage_m));
  json about{{"file", arguments.file}, {"alignment", axis.name()}};
  if (!axis.cant().empty()) {
    about["cant_base_m"] = axis.cant().base_m();
    about["cant_from"] = axis.cant().stations().front().chainage_m;
    about["cant_to"] = axis.cant().stations().back().chainage_m;
  }
  rows.end(std::move(about), "rows");
  return exit_good;
}

/// What the column cant_m cannot say of itself, on stderr.
void print_cant_note(const Cant& cant) {
  if (cant.empty()) return;
  const bool slope = cant.base_m() == 1.0;
  std::fprintf(stderr, "adit: cant_m is %s, known from chainage %s to %s; beyond them it is as there\n",
               slope ? "a slope, in metres for every metre of width"
                     : ("the height of one edge over the other, " + short_number(cant.base_m()) + " m apart").c_str(),
               short_number(cant.stations().front().chainage_m).c_str(),
               short_number(cant.stations().back().chainage_m).c_str());
}

/// Where a point stands; without a grade line its height is not known.
struct Found {
  double chainage_m, offset_m;
  std::optional<double> height_m;
};

std::optional<Found> found_on(const Alignment& axis, const Eigen::Vector3d& point) {
  if (axis.vertical().empty()) {
    const auto foot = axis.horizontal().foot(point.head<2>());
    return foot ? std::optional(Found{foot->chainage_m, foot->offset_m, std::nullopt}) : std::nullopt;
  }
  const auto at = axis.to_tunnel(point);
  return at ? std::optional(Found{at->s_m, at->x_m, at->z_m}) : std::nullopt;
}

std::vector<Number> columns_of(const Alignment& axis, const std::optional<Found>& at) {
  const auto of = [&](double Found::*member) { return at ? std::optional((*at).*member) : std::nullopt; };
  const auto station = at ? std::optional(axis.stations().displayed_m(at->chainage_m)) : std::nullopt;
  return {{"chainage", micrometres, of(&Found::chainage_m)},
          {"station", micrometres, station},
          {"offset", micrometres, of(&Found::offset_m)},
          {"height", micrometres, at ? at->height_m : std::nullopt}};
}

int list_points(const Arguments& arguments, const Alignment& axis, const CommonOptions& common) {
  const io::ControlFile file = io::read_control(arguments.points);
  Rows rows(common.json, true, columns_of(axis, std::nullopt));
  std::size_t without = 0;
  std::string first;
  for (const ControlPoint& point : file.points) {
    const auto at = found_on(axis, point.position);
    if (!at && without++ == 0) first = point.id;
    rows.add(point.id, columns_of(axis, at));
  }
  if (without > 0)
    std::fprintf(stderr,
                 "adit: %s: %zu of %zu points, first %s, have no single foot on the axis, which runs from %s to %s; "
                 "check their coordinates\n",
                 arguments.points.c_str(), without, file.points.size(), io::quoted_word(first).c_str(),
                 short_number(axis.from_m()).c_str(), short_number(axis.to_m()).c_str());
  rows.end({{"file", arguments.file}, {"alignment", axis.name()}}, "points");
  return without == 0 ? exit_good : exit_needs_a_person;
}

/// What the reader says of the axis, on stderr.
void print_findings(const io::AxisFile& file, const io::AxisOfFile& axis) {
  for (const Findings* findings : {&file.findings, &axis.findings})
    for (const Finding& finding : *findings)
      if (finding.severity != Severity::note)
        std::fprintf(stderr, "adit: %s: %s; %s\n", finding.subject.c_str(), finding.words.c_str(),
                     finding.mend.empty() ? "see docs/formats.md" : finding.mend.c_str());
}

}  // namespace

Action declare_axis(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("FILE", arguments->file, "an alignment (.xml, .ifc, .dxf, .kof, .csv)")
      ->required()
      ->check(some_name);
  command.add_option("--name", arguments->name, "which alignment of a file that holds several");
  auto* every = command.add_option("--every", arguments->every_m, "list whole multiples of this chainage [m] (1)")
                    ->check(number_between(0.001, 1e6));
  auto* from = command.add_option("--from", arguments->from_m, "list from this chainage on [m]");
  auto* to = command.add_option("--to", arguments->to_m, "list up to this chainage [m]");
  auto* main_points =
      command.add_flag("--main-points", arguments->main_points, "list also where elements begin and grades meet");
  command.add_option("--points", arguments->points, "points to find on the axis: id,east,north,elevation")
      ->check(some_name)
      ->excludes(every)
      ->excludes(from)
      ->excludes(to)
      ->excludes(main_points);
  command.add_option("--start", arguments->start_m, "chainage of the first point, for files that state none [m]")
      ->check(number_between(-1e6, 1e7));
  return [arguments](const CommonOptions& common, Progress&) {
    const io::AxisFile file = io::read_axis(arguments->file, arguments->start_m);
    const io::AxisOfFile& read = io::named_axis(file, arguments->name);
    for (const auto& [name, value] : {std::pair("--from", arguments->from_m), std::pair("--to", arguments->to_m)})
      if (value && !std::isfinite(*value)) throw Error("no number of metres", name, "write one, for instance 120.0");
    if (!common.quiet) {
      print_findings(file, read);
      if (arguments->points.empty()) print_cant_note(read.axis->cant());
    }
    if (read.grade_refusal) std::fprintf(stderr, "adit: %s\n", read.grade_refusal->what());
    const int listed = arguments->points.empty() ? list_coordinates(*arguments, *read.axis, common.json)
                                                 : list_points(*arguments, *read.axis, common);
    return read.grade_refusal ? exit_needs_a_person : listed;
  };
}

}  // namespace adit::app
