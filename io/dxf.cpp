#include "io/dxf.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/dxf_chain.h"
#include "io/dxf_entities.h"

namespace adit::io {
namespace {

std::string rounded(double value) {
  return short_number(std::round(value * 1000.0) / 1000.0);
}
std::string place(const Eigen::Vector2d& p) {
  return "(" + rounded(p.x()) + ", " + rounded(p.y()) + ") m";
}

std::string layers_of(const std::vector<DxfLine>& lines) {
  std::set<std::string> layers;
  for (const DxfLine& line : lines) layers.insert("\"" + line.layer + "\"");
  std::string words;
  for (const std::string& layer : layers) words += (words.empty() ? "" : ", ") + layer;
  return words;
}

std::vector<DxfLine> on_layer(const DxfDrawing& drawing, const std::string& layer) {
  std::vector<DxfLine> lines;
  for (DxfLine line : drawing.lines) {
    if (!layer.empty() && line.layer != layer) continue;
    for (ProfileSegment& segment : line.segments) {
      segment.start *= drawing.metres_per_unit;
      segment.end *= drawing.metres_per_unit;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

[[noreturn]] void refuse_without_closed_line(const DxfDrawing& drawing, const DxfChains& chains,
                                             const std::string& file) {
  std::string what = "the drawing holds no closed line";
  std::string mend = "draw the profile with lines, arcs or polylines";
  if (chains.branch) {
    what += ": three or more ends meet at " + place(*chains.branch);
    mend = "leave the profile alone on its layer, every line drawn once";
  } else if (!chains.open.empty()) {
    const auto longest =
        std::max_element(chains.open.begin(), chains.open.end(),
                         [](const DxfLine& a, const DxfLine& b) { return a.segments.size() < b.segments.size(); });
    what += ": one on layer \"" + longest->layer + "\" runs from " + place(longest->segments.front().start) + " to " +
            place(longest->segments.back().end);
    mend = "close the line along the floor";
  }
  if (!drawing.unread.empty()) what += " (not read: " + drawing.unread + ")";
  throw Error(what, file, mend);
}

}  // namespace

Profile read_dxf_profile(const std::filesystem::path& file, const std::string& layer) {
  const DxfDrawing drawing = read_dxf_entities(file);
  const std::vector<DxfLine> lines = on_layer(drawing, layer);
  if (lines.empty() && !layer.empty() && !drawing.lines.empty()) {
    throw Error("the drawing has nothing on layer \"" + layer + "\"", file.string(),
                "name one of " + layers_of(drawing.lines));
  }
  const DxfChains chains = chained(lines);
  if (chains.closed.empty()) refuse_without_closed_line(drawing, chains, file.string());
  if (chains.closed.size() > 1) {
    throw Error("the drawing holds " + std::to_string(chains.closed.size()) + " closed lines, on layers " +
                    layers_of(chains.closed),
                file.string(), "put the profile alone on a layer and name it");
  }
  try {
    return Profile(file.stem().string() + "/" + chains.closed.front().layer, chains.closed.front().segments);
  } catch (const Error& error) {
    throw Error(error.what_is_wrong(), file.string(), error.mend());
  }
}

}  // namespace adit::io
