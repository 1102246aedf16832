#include "io/landxml_stations.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/foundation/options.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr double reported_m = 1e-3;

std::string metres(double value) {
  return short_number(std::round(value * 1e4) / 1e4);
}

StationEquation read_equation(const LandXmlNode& node) {
  const std::string sense = node.text("staIncrement");
  if (!sense.empty() && sense != "increasing" && sense != "decreasing")
    node.fail("staIncrement is " + quoted_word(sense), "write increasing or decreasing");
  return {node.length_m("staInternal"), node.length_m("staAhead"), sense == "decreasing"};
}

/// What the equation does to the stations people read.
Finding jump(const StationEquation& equation, double back_m, const std::string& subject) {
  const std::string at = "the station equation at chainage " + metres(equation.chainage_m);
  if (equation.decreasing)
    return {Severity::warning, subject, at + " lets stations fall from " + metres(equation.ahead_m) + " on",
            "stations may occur twice: tell them apart by the chainage that stands beside every station"};
  const std::string both =
      metres(std::min(back_m, equation.ahead_m)) + " to " + metres(std::max(back_m, equation.ahead_m));
  if (equation.ahead_m < back_m)
    return {Severity::warning, subject, at + " goes back: stations " + both + " occur twice",
            "tell them apart by the chainage that stands beside every station"};
  return {Severity::note, subject, at + " leaves a gap: stations " + both + " do not occur", ""};
}

}  // namespace

LandXmlStations read_landxml_stations(const LandXmlNode& alignment, const HorizontalAlignment& plan,
                                      const std::string& subject) {
  LandXmlStations read;
  const std::vector<LandXmlNode> nodes = alignment.children("StaEquation");
  std::vector<StationEquation> equations;
  equations.reserve(nodes.size());
  for (const LandXmlNode& node : nodes) equations.push_back(read_equation(node));
  try {
    read.stations = StationEquations(equations);
  } catch (const Error& error) {
    throw Error(subject + ": " + error.what_is_wrong(), nodes.front().place(), error.mend());
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double back_m = read.stations.back_m(i);
    const auto stated = nodes[i].optional_length_m("staBack");
    if (stated && std::abs(*stated - back_m) > reported_m)
      read.findings.push_back({Severity::warning, subject,
                               "the station equation at chainage " + metres(equations[i].chainage_m) +
                                   " states a station back of " + metres(*stated) + ", the equations before it give " +
                                   metres(back_m),
                               "its place and the station ahead are used; ask which is meant"});
    if (equations[i].chainage_m < plan.from_m() || equations[i].chainage_m > plan.to_m())
      read.findings.push_back({Severity::warning, subject,
                               "the station equation at chainage " + metres(equations[i].chainage_m) +
                                   " lies beside the axis, which runs from " + metres(plan.from_m()) + " to " +
                                   metres(plan.to_m()),
                               "give its internal station"});
    if (std::abs(back_m - equations[i].ahead_m) > reported_m || equations[i].decreasing)
      read.findings.push_back(jump(equations[i], back_m, subject));
  }
  return read;
}

}  // namespace adit::io
