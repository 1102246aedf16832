#include "io/axis_dxf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/options.h"
#include "io/axis_from_points.h"
#include "io/dxf_chain.h"

namespace adit::io {
namespace {

constexpr double reported_kink_rad = 2e-4;

/// Lines in metres.
std::vector<DxfLine> in_metres(const DxfDrawing& drawing) {
  std::vector<DxfLine> lines = drawing.lines;
  for (DxfLine& line : lines) {
    for (ProfileSegment& segment : line.segments) {
      segment.start *= drawing.metres_per_unit;
      segment.end *= drawing.metres_per_unit;
    }
    for (double& height : line.heights) height *= drawing.metres_per_unit;
  }
  return lines;
}

/// As it was drawn, whichever end the chain was walked from.
DxfLine as_drawn(DxfLine line) {
  if (line.directed == 0)
    throw Error("it is drawn of arcs alone, which do not say where it begins", {},
                "join them to one polyline that runs up-chainage");
  if (line.reversed == 0) return line;
  if (line.reversed < line.directed)
    throw Error("its " + std::to_string(line.directed) + " lines are drawn in different directions", {},
                "join them to one polyline that runs up-chainage");
  line.segments = reversed(line.segments);
  std::reverse(line.heights.begin(), line.heights.end());
  return line;
}

bool has_heights(const DxfLine& line) {
  return std::any_of(line.heights.begin(), line.heights.end(), [](double height) { return height != 0.0; });
}

/// A segment with bulge b turns left by 4 atan b.
HorizontalElement element_of(const ProfileSegment& segment, std::size_t number) {
  const Eigen::Vector2d chord = segment.end - segment.start;
  const double turn_right = -4.0 * std::atan(segment.bulge);
  HorizontalElement element;
  element.name = "piece " + std::to_string(number);
  element.start = segment.start;
  element.azimuth_rad = std::atan2(chord.x(), chord.y()) - 0.5 * turn_right;
  element.length_m = chord.norm();
  if (segment.bulge == 0.0) return element;
  element.kind = HorizontalKind::arc;
  element.start_curvature_per_m = element.end_curvature_per_m = 2.0 * std::sin(0.5 * turn_right) / chord.norm();
  element.length_m = turn_right / element.start_curvature_per_m;
  return element;
}

Findings kinks_of(const std::vector<HorizontalElement>& elements, const std::string& subject) {
  double sharpest = 0.0;
  std::size_t at = 0;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const double end = element_point(elements[i - 1], elements[i - 1].length_m).azimuth_rad;
    const double kink = std::abs(wrapped_rad(elements[i].azimuth_rad - end));
    if (kink > 0.5 * pi)
      throw Error(
          "the axis turns back by " + short_number(std::round(deg_from_rad(kink))) + " degrees at " + elements[i].name,
          {}, "draw it in order of chainage");
    if (kink > sharpest) at = i;
    sharpest = std::max(sharpest, kink);
  }
  if (sharpest < reported_kink_rad) return {};
  return {{Severity::warning, subject,
           "it bends by up to " + short_number(std::round(deg_from_rad(sharpest) * 1e4) / 1e4) + " degrees, at " +
               elements[at].name,
           "offsets jump there; ask whether the kinks are meant"}};
}

Alignment alignment_of(const std::string& name, const DxfLine& line, double start_chainage_m, Findings& findings) {
  std::vector<HorizontalElement> elements;
  std::vector<VerticalPoint> grade;
  double chainage = start_chainage_m;
  for (std::size_t i = 0; i <= line.segments.size(); ++i) {
    if (has_heights(line)) grade.push_back({chainage, line.heights.at(i)});
    if (i == line.segments.size()) break;
    elements.push_back(element_of(line.segments[i], i + 1));
    chainage += elements.back().length_m;
  }
  findings = kinks_of(elements, "alignment " + name);
  return Alignment(name, HorizontalAlignment(std::move(elements), start_chainage_m),
                   grade.empty() ? VerticalAlignment() : VerticalAlignment(std::move(grade)));
}

AxisOfFile axis_of(const std::string& name, const DxfLine& chain, const std::optional<double>& start_chainage_m,
                   const std::string& file) {
  AxisOfFile read;
  read.name = name;
  try {
    const DxfLine line = as_drawn(chain);
    const bool bulges = std::any_of(line.segments.begin(), line.segments.end(),
                                    [](const ProfileSegment& segment) { return segment.bulge != 0.0; });
    if (!bulges) {
      ListedPoints points;
      points.plan.push_back(line.segments.front().start);
      for (const ProfileSegment& segment : line.segments) points.plan.push_back(segment.end);
      if (has_heights(line)) points.elevations_m = line.heights;
      return axis_from_points(name, points, start_chainage_m, file);
    }
    if (!start_chainage_m)
      throw Error("the file states no chainages", {}, "give the chainage of the axis's first point");
    read.axis = alignment_of(name, line, *start_chainage_m, read.findings);
  } catch (const Error& error) {
    read.refusal.emplace("alignment " + name + ": " + error.what_is_wrong(), file, error.mend());
  }
  return read;
}

}  // namespace

AxisFile read_dxf_axes(const std::filesystem::path& file, const std::optional<double>& start_chainage_m) {
  const DxfDrawing drawing = read_dxf_entities(file);
  const DxfChains chains = chained(in_metres(drawing));
  AxisFile read{file.string(), "DXF", {}, {}};
  if (chains.open.empty())
    throw Error("the drawing holds no open line" +
                    (drawing.unread.empty() ? std::string() : " (not read: " + drawing.unread + ")"),
                file.string(), "draw the axis with lines, arcs or a polyline");
  std::map<std::string, int> count, number;
  for (const DxfLine& line : chains.open) ++count[line.layer];
  for (const DxfLine& line : chains.open) {
    const bool alone = count[line.layer] == 1;
    const std::string name = alone ? line.layer : line.layer + " " + std::to_string(++number[line.layer]);
    read.axes.push_back(axis_of(name, line, start_chainage_m, file.string()));
  }
  if (!drawing.unread.empty())
    read.findings.push_back({Severity::note, file.string(), "not honoured: " + drawing.unread, ""});
  if (!chains.closed.empty())
    read.findings.push_back(
        {Severity::note, file.string(), "not honoured: " + std::to_string(chains.closed.size()) + " closed lines", ""});
  return read;
}

}  // namespace adit::io
