#include "ui/screen.h"

#include <imgui.h>

#include <algorithm>

#include "render/section_drawing.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;

/// An ImGui window at a fixed place, closed when this goes out of scope.
class Region {
 public:
  Region(const char* name, const ImVec2& at, const ImVec2& size, ImGuiWindowFlags more = ImGuiWindowFlags_None) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, fixed_window | more);
  }
  ~Region() { ImGui::End(); }
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;
};

void draw_status(const Workspace& workspace) {
  std::string words = workspace.job_path().string();
  if (const Section* section = workspace.section()) words += "    " + render::section_title(*section);
  ImGui::TextUnformatted(words.c_str());
}

void listen_to_keys(Workspace& workspace) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) workspace.cancel();
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_PageDown))) workspace.next_section();
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_PageUp))) workspace.previous_section();
}

}  // namespace

void Screen::draw_tabs(Workspace& workspace) {
  if (!ImGui::BeginTabBar("views")) return;
  const auto tab = [&](const char* name, const auto& content) {
    if (!begin_tab(workspace.script(), name)) return;
    content();
    ImGui::EndTabItem();
  };
  tab("3D view", [&] { view_3d_.draw(workspace); });
  tab("Map", [&] { map_.draw(workspace); });
  tab("Sections", [&] { sections_.draw(workspace); });
  tab("Registration", [&] { draw_registration(workspace); });
  tab("Volumes", [&] { draw_volumes(workspace); });
  ImGui::EndTabBar();
}

void Screen::draw(Workspace& workspace) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float scale = scale_of_theme();
  if (!workspace.has_job()) {
    const Region region("start", {0.0F, 0.0F}, size);
    start_.draw(workspace);
    return;
  }
  listen_to_keys(workspace);
  const float bottom = ImGui::GetFrameHeight() + 6.0F * scale;
  const float left = std::min(380.0F * scale, 0.4F * size.x);
  const float height = size.y - bottom;
  const float steps = std::min(360.0F * scale, 0.5F * height);
  {
    const Region region("job", {0.0F, 0.0F}, {left, height - steps});
    draw_job(workspace);
  }
  {
    const Region region("steps", {0.0F, height - steps}, {left, steps});
    draw_steps(workspace);
  }
  {
    const Region region("views", {left, 0.0F}, {size.x - left, height});
    draw_tabs(workspace);
  }
  const Region region("status", {0.0F, height}, {size.x, bottom}, ImGuiWindowFlags_NoScrollbar);
  draw_status(workspace);
}

}  // namespace adit::ui
