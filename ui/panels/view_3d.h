#pragma once
// The registered scans or the surface in 3D, with the stations and the section of the cursor.

#include <imgui.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "render/scene_view.h"
#include "ui/later.h"
#include "ui/overview.h"
#include "ui/workspace.h"

namespace adit::ui {

/// Drawn again only when something has changed. Made and destroyed with the window's context current.
class View3D {
 public:
  void draw(Workspace& workspace);
  bool busy() const { return making_.busy(); }

 private:
  void take_overview(const Workspace& workspace);
  void draw_tools(Workspace& workspace);
  void draw_picture(Workspace& workspace, const ImVec2& size);
  void draw_over(const Workspace& workspace, const ImVec2& corner, const ImVec2& size) const;
  void listen();
  void fit();
  /// What can be shown of what is wanted.
  SceneShows shown() const { return overview_.mesh ? shows_ : SceneShows::scans; }

  std::shared_ptr<const app::JobState> state_;  ///< of the overview asked for last
  std::filesystem::path job_;                   ///< the camera was fitted to
  Later<Overview> making_;
  std::string error_;
  Overview overview_;
  std::unique_ptr<render::SceneView> view_;
  render::Camera camera_;
  SceneShows shows_ = SceneShows::scans;
  std::optional<std::size_t> scan_;  ///< selected in the scene
  ImVec2 size_{1.0F, 1.0F};
  bool fit_wanted_ = false;
  bool scene_changed_ = false;
  bool picture_old_ = true;
};

}  // namespace adit::ui
