#include "ui/panels/view_3d.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/number_text.h"
#include "ui/navigation.h"
#include "ui/texture.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

ImVec2 on_screen(const ImVec2& corner, const Eigen::Vector2d& pixel) {
  return {corner.x + static_cast<float>(pixel.x()), corner.y + static_cast<float>(pixel.y())};
}

void draw_label(const ImVec2& at, const std::string& words) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float scale = scale_of_theme(), side = 5.0F * scale;
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  list.AddTriangleFilled({at.x - side, at.y + side}, {at.x + side, at.y + side}, {at.x, at.y - side},
                         packed(render::colours::black));
  const ImVec2 text{at.x - size.x / 2.0F, at.y - side - size.y - 2.0F * scale};
  list.AddRectFilled({text.x - 3.0F, text.y - 1.0F}, {text.x + size.x + 3.0F, text.y + size.y + 1.0F},
                     packed(render::Colour{1.0, 1.0, 1.0, 0.8}), 2.0F);
  list.AddText(text, packed(render::colours::black), words.c_str());
}

/// Boxes of the classes with their boundaries in cm, in the lower right corner.
void draw_legend(const render::DeviationScale& scale, const ImVec2& lower_right) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::vector<double> bounds = scale.boundaries_m();
  const float unit = ImGui::GetFontSize(), box = 2.6F * unit;
  const float left = lower_right.x - box * static_cast<float>(bounds.size() - 1) - 2.0F * unit;
  const float top = lower_right.y - 3.6F * unit;
  list.AddRectFilled({left - 1.5F * unit, top - 1.5F * unit},
                     {lower_right.x - 0.4F * unit, lower_right.y - 0.4F * unit},
                     packed(render::Colour{1.0, 1.0, 1.0, 0.85}), 3.0F);
  list.AddText({left, top - 1.3F * unit}, packed(render::colours::black), "deviation [cm], red is overbreak");
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const float x = left + box * static_cast<float>(i);
    if (i + 1 < bounds.size())
      list.AddRectFilled({x, top}, {x + box, top + 1.1F * unit},
                         packed(render::deviation_colour(scale, (bounds[i] + bounds[i + 1]) / 2.0)));
    const std::string words = render::fixed(100.0 * bounds[i], 0);
    list.AddText({x - ImGui::CalcTextSize(words.c_str()).x / 2.0F, top + 1.3F * unit}, packed(render::colours::black),
                 words.c_str());
  }
}

}  // namespace

void View3D::take_overview(const Workspace& workspace) {
  if (auto result = making_.take()) {
    error_ = result->error;
    overview_ = result->value ? std::move(*result->value) : Overview{};
    scene_changed_ = true;
    if (!overview_.empty() && job_ != state_->folder) {
      job_ = state_->folder;
      fit_wanted_ = true;
    }
  }
  if (state_ == workspace.state() || making_.busy()) return;
  state_ = workspace.state();
  making_.begin([state = state_] { return overview_of(*state); });
}

void View3D::fit() {
  const double aspect = static_cast<double>(size_.x / size_.y);
  camera_ = render::oblique(overview_.extent(shown()), overview_.heading(), aspect);
  picture_old_ = true;
}

void View3D::draw_tools(Workspace& workspace) {
  Script& script = workspace.script();
  const auto choose = [&](const char* name, SceneShows shows) {
    if (!choice(script, name, shows_ == shows)) return;
    shows_ = shows;
    scene_changed_ = true;
  };
  choose("Scans", SceneShows::scans);
  ImGui::SameLine();
  ImGui::BeginDisabled(!overview_.mesh);
  choose("Deviation", SceneShows::deviation);
  ImGui::EndDisabled();
  ImGui::SameLine(0.0F, 24.0F * scale_of_theme());
  const double aspect = static_cast<double>(size_.x / size_.y);
  const auto look = [&](const char* name, const auto& camera) {
    if (button(script, name, !overview_.empty())) {
      camera_ = camera();
      picture_old_ = true;
    }
    ImGui::SameLine();
  };
  look("Fit", [&] { return render::oblique(overview_.extent(shown()), overview_.heading(), aspect); });
  look("Top", [&] { return render::top_view(overview_.extent(shown()), overview_.heading(), aspect); });
  look("Along", [&] { return inside_view(overview_, workspace.section_index().value_or(0)); });
  ImGui::TextColored(theme::quiet, "%s",
                     busy() ? "reading the points" : "drag: turn   right drag: shift   wheel: nearer");
}

void View3D::listen() {
  const ImGuiIO& io = ImGui::GetIO();
  const double height = static_cast<double>(size_.y);
  const double right = static_cast<double>(io.MouseDelta.x), down = static_cast<double>(io.MouseDelta.y);
  const bool moved = right != 0.0 || down != 0.0;
  const render::Camera before = camera_;
  if (ImGui::IsItemActive() && moved) {
    const bool turning = ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift;
    camera_ = turning ? turned(camera_, right, down, height) : shifted(camera_, right, down, height);
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0F) camera_ = nearer(camera_, static_cast<double>(io.MouseWheel));
  picture_old_ = picture_old_ || before.position != camera_.position || before.focal_point != camera_.focal_point ||
                 before.view_height_m != camera_.view_height_m;
}

void View3D::draw_over(const Workspace& workspace, const ImVec2& corner, const ImVec2& size) const {
  const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  if (const Section* section = workspace.section()) {
    std::vector<ImVec2> ring;
    const std::vector<Eigen::Vector3d> points = ring_of(*workspace.state(), *section);
    for (const Eigen::Vector3d& p : points)
      if (const auto pixel = render::pixel_of(camera_, width, height, p)) ring.push_back(on_screen(corner, *pixel));
    if (!points.empty() && ring.size() == points.size())
      list.AddPolyline(ring.data(), static_cast<int>(ring.size()), packed(theme::accent), ImDrawFlags_Closed,
                       2.0F * scale_of_theme());
  }
  for (const render::SceneLabel& station : overview_.stations)
    if (const auto pixel = render::pixel_of(camera_, width, height, station.position))
      draw_label(on_screen(corner, *pixel), station.text);
  if (shown() == SceneShows::deviation && overview_.scale)
    draw_legend(*overview_.scale, {corner.x + size.x, corner.y + size.y});
  list.PopClipRect();
}

void View3D::draw_picture(Workspace& workspace, const ImVec2& size) {
  if (view_ == nullptr) view_ = std::make_unique<render::SceneView>(static_cast<int>(size.x), static_cast<int>(size.y));
  if (size.x != size_.x || size.y != size_.y) {
    size_ = size;
    view_->resize(static_cast<int>(size.x), static_cast<int>(size.y));
    picture_old_ = true;
  }
  if (std::exchange(fit_wanted_, false)) fit();
  if (scan_ != workspace.scan() || std::exchange(scene_changed_, false)) {
    scan_ = workspace.scan();
    view_->set_scene(scene_of(overview_, shown(), scan_));
    picture_old_ = true;
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(
      "picture", size,
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  listen();
  if (std::exchange(picture_old_, false)) {
    view_->set_camera(camera_);
    view_->render();
  }
  const ImVec2 far_corner{corner.x + size.x, corner.y + size.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, far_corner, packed(theme::paper));
  // VTK's rows begin at the bottom.
  list.AddImage(texture_id(view_->texture()), corner, far_corner, {0.0F, 1.0F}, {1.0F, 0.0F});
  draw_over(workspace, corner, size);
}

void View3D::draw(Workspace& workspace) {
  if (workspace.state() == nullptr) {
    nothing_yet("");
    return;
  }
  take_overview(workspace);
  if (!error_.empty()) ImGui::TextColored(theme::bad, "%s", error_.c_str());
  if (overview_.empty() && !busy()) {
    const bool running = workspace.doing() == Workspace::Doing::running;
    nothing_yet(running ? "The scans have not been registered yet."
                        : "The scans have not been registered yet: press Run.");
    return;
  }
  draw_tools(workspace);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 size{std::floor(room.x), std::floor(room.y)};
  if (size.x > 32.0F && size.y > 32.0F && !overview_.empty()) draw_picture(workspace, size);
}

}  // namespace adit::ui
