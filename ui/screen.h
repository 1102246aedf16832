#pragma once
// The panels and where they stand: job and steps on the left, what is looked at in the middle, a line of words below.

#include "ui/panels/deviation_map.h"
#include "ui/panels/sections.h"
#include "ui/panels/start.h"
#include "ui/panels/view_3d.h"
#include "ui/workspace.h"

namespace adit::ui {

/// Holds textures: made and destroyed with the window's context current.
class Screen {
 public:
  /// All panels, into the ImGui frame that has been begun.
  void draw(Workspace& workspace);

  /// True while something is being made beside the window: frames must go on.
  bool busy() const { return view_3d_.busy() || map_.busy(); }

 private:
  void draw_tabs(Workspace& workspace);

  StartPanel start_;
  View3D view_3d_;
  MapPanel map_;
  SectionPanel sections_;
};

}  // namespace adit::ui
