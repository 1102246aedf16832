#include "ui/panels/deviation_map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/number_text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

constexpr double margin_mm = 3.0;
constexpr double most_height_px = 8000.0;  // long tunnels: their strips are drawn lower

/// Place on the paper under the mouse.
render::PaperPoint mouse_on(const Paper& paper, const ImVec2& corner) {
  const ImVec2 mouse = ImGui::GetMousePos();
  return render::PaperPoint(static_cast<double>(mouse.x - corner.x), static_cast<double>(mouse.y - corner.y)) /
         paper.pixels_per_mm();
}

bool holds(const render::Rect& rect, const render::PaperPoint& at) {
  return at.x() >= rect.left && at.x() <= rect.right() && at.y() >= rect.top && at.y() <= rect.bottom();
}

/// Height of the drawing on paper of a width, margins counted.
double height_mm(const DeviationMap& map, double width_mm) {
  return 2.0 * margin_mm + render::deviation_map_height(map, width_mm - 2.0 * margin_mm);
}

/// Decided before the bar takes its width, so that the drawing does not change size for its sake.
bool needs_scrolling(const DeviationMap& map) {
  const Paper paper = paper_of(ImGui::GetContentRegionAvail(), scale_of_theme());
  return height_mm(map, paper.width_mm) > paper.height_mm;
}

std::string words_of(const DeviationMap& map, double chainage_m, double share_across) {
  const auto index = [](double at, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count) - 1.0));
  };
  const MapCell& cell = map.cell(index((chainage_m - map.from_m) / map.step_s_m, map.rows),
                                 index(share_across * static_cast<double>(map.columns), map.columns));
  std::string words = "chainage " + render::fixed(chainage_m, 2) + "\n";
  if (cell.kind == CellKind::unseen) return words + "not seen";
  if (cell.kind == CellKind::opening) return words + "open: no rock within reach";
  words += "deviation " + render::with_sign(static_cast<double>(cell.deviation_m), 3) + " m";
  return cell.kind == CellKind::interpolated ? words + ", interpolated" : words;
}

}  // namespace

MapPanel::Drawn MapPanel::drawn(const app::JobState& state, const ImVec2& size_px, float scale) {
  Drawn result;
  result.paper = paper_of(size_px, scale);
  const DeviationMap& map = *state.map;
  const double width = result.paper.width_mm;
  const double most = most_height_px / result.paper.pixels_per_mm();
  result.paper.height_mm = std::min(height_mm(map, width), most);
  render::MapTexts texts{.line = "profile (offset 0)", .marks = {}, .rounds = state.job.rounds};
  if (state.design) texts.marks = render::line_marks(*state.design, map);
  auto canvas = render::Canvas::raster(width, result.paper.height_mm, result.paper.dots_per_inch);
  const render::Rect rect = result.paper.rect().inset(margin_mm);
  render::draw_deviation_map(canvas, rect, map, render::deviation_scale(render::seen_deviations(map)), texts);
  result.strips = render::map_strips(rect, map);
  result.picture = canvas.finish_picture();
  return result;
}

void MapPanel::draw_anew(const std::shared_ptr<const app::JobState>& state, const ImVec2& size_px) {
  if (auto result = drawing_.take()) {
    error_ = result->error;
    if (result->value) {
      texture_ = Texture(result->value->picture);
      shown_ = std::move(*result->value);
      shown_.picture = {};
    }
  }
  const bool asked_for = state_ == state && size_.x == size_px.x && size_.y == size_px.y;
  if (asked_for || drawing_.busy()) return;
  state_ = state;
  size_ = size_px;
  drawing_.begin([state, size_px, scale = scale_of_theme()] { return drawn(*state, size_px, scale); });
}

void MapPanel::draw_cursor(const Workspace& workspace, const ImVec2& corner) const {
  const Section* section = workspace.section();
  if (section == nullptr) return;
  const double px = shown_.paper.pixels_per_mm();
  for (const render::MapStrip& strip : shown_.strips) {
    const double share = (section->chainage_m - strip.from_m) / (strip.to_m - strip.from_m);
    if (share < -1e-9 || share > 1.0 + 1e-9) continue;
    const float x = corner.x + static_cast<float>(px * (strip.rect.left + share * strip.rect.width));
    const float top = corner.y + static_cast<float>(px * strip.rect.top);
    const float bottom = corner.y + static_cast<float>(px * strip.rect.bottom());
    ImGui::GetWindowDrawList()->AddLine({x, top}, {x, bottom}, packed(theme::accent), 2.0F * scale_of_theme());
  }
}

void MapPanel::listen(Workspace& workspace, const ImVec2& corner) const {
  if (!ImGui::IsItemHovered()) return;
  const render::PaperPoint at = mouse_on(shown_.paper, corner);
  for (const render::MapStrip& strip : shown_.strips) {
    if (!holds(strip.rect, at)) continue;
    const double along = (at.x() - strip.rect.left) / strip.rect.width;
    const double chainage = strip.from_m + along * (strip.to_m - strip.from_m);
    ImGui::SetTooltip("%s", words_of(*state_->map, chainage, (at.y() - strip.rect.top) / strip.rect.height).c_str());
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) workspace.show_chainage(chainage);
  }
}

void MapPanel::draw(Workspace& workspace) {
  const auto state = workspace.state();
  if (state == nullptr || !state->map || state->map->cells.empty()) {
    nothing_yet(state != nullptr && !state->has_design() ? "The job has no alignment and profile."
                                                         : "No map has been made yet.");
    return;
  }
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::paper);
  ImGui::BeginChild(
      "map", {0.0F, 0.0F}, false,
      needs_scrolling(*state->map) ? ImGuiWindowFlags_AlwaysVerticalScrollbar : ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleColor();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (room.x > 64.0F && room.y > 64.0F) draw_anew(state, {std::floor(room.x), std::floor(room.y)});
  if (!error_.empty()) ImGui::TextColored(theme::bad, "%s", error_.c_str());
  if (!texture_.empty() && state_ == state) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Image(texture_.id(), texture_.size());
    listen(workspace, corner);
    draw_cursor(workspace, corner);
  }
  ImGui::EndChild();
}

}  // namespace adit::ui
