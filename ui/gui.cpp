#define GL_GLEXT_PROTOTYPES
#include "ui/gui.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "core/foundation/error.h"
#include "ui/theme.h"

namespace adit::ui {
namespace {

// VTK leaves the state of OpenGL as it likes it; ImGui sets most of what it needs, this is the rest.
void begin_picture(const ImVec2& size) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, static_cast<int>(size.x), static_cast<int>(size.y));
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  const ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  glClearColor(colour.x, colour.y, colour.z, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

Gui::Gui(float scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the layout is fixed
  apply_theme(scale);
  if (ImGui_ImplOpenGL3_Init("#version 150")) return;
  ImGui::DestroyContext();
  throw Error("OpenGL 3.3 cannot be reached", "graphics driver", "install Mesa's or the vendor's driver");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Gui::set_scale(float scale) {
  apply_theme(scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Gui::draw(Screen& screen, Workspace& workspace) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  workspace.poll();
  screen.draw(workspace);
  workspace.script().end_frame();
  ImGui::Render();
  begin_picture(ImGui::GetIO().DisplaySize);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace adit::ui
