#include "ui/panels/start.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {

void StartPanel::draw(Workspace& workspace) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float width = std::min(640.0F * scale_of_theme(), room.x);
  ImGui::SetCursorPos({(room.x - width) / 2.0F, 0.3F * room.y});
  ImGui::BeginChild("start", {width, 0.0F});
  heading("Adit");
  remark("Tunnel scans in, defensible overbreak and volumes out.");
  ImGui::Dummy({0.0F, ImGui::GetTextLineHeight()});
  ImGui::TextUnformatted("Folder of a job, or its job.json");
  const float open_px = 90.0F * scale_of_theme();
  ImGui::SetNextItemWidth(width - open_px - ImGui::GetStyle().ItemSpacing.x);
  const bool entered = ImGui::InputText("##path", &path_, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  const bool wanted = button(workspace.script(), "Open", !path_.empty(), open_px) || entered;
  remark("Or drop the folder onto this window. \"adit demo DIR\" makes a job to try.");
  ImGui::EndChild();
  if (wanted && !path_.empty()) workspace.open(path_);
}

}  // namespace adit::ui
