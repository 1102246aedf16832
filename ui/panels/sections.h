#pragma once
// One section after the other: the sheet of the report and the numbers of every line.

#include <memory>

#include "ui/texture.h"
#include "ui/workspace.h"

namespace adit::ui {

class SectionPanel {
 public:
  void draw(Workspace& workspace);

 private:
  void draw_sheet(const Workspace& workspace, const ImVec2& size);

  /// What the texture shows.
  std::shared_ptr<const app::JobState> state_;
  std::size_t index_ = 0;
  ImVec2 size_{0.0F, 0.0F};
  Texture sheet_;
};

}  // namespace adit::ui
