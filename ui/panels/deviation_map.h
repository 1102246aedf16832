#pragma once
// The unrolled map of deviations; a click moves the chainage cursor.

#include <memory>
#include <string>
#include <vector>

#include "render/deviation_map_drawing.h"
#include "ui/later.h"
#include "ui/paper.h"
#include "ui/texture.h"
#include "ui/workspace.h"

namespace adit::ui {

class MapPanel {
 public:
  void draw(Workspace& workspace);
  bool busy() const { return drawing_.busy(); }

 private:
  struct Drawn {
    render::Picture picture;
    Paper paper;
    std::vector<render::MapStrip> strips;
  };
  static Drawn drawn(const app::JobState& state, const ImVec2& size_px, float scale);
  void draw_anew(const std::shared_ptr<const app::JobState>& state, const ImVec2& size_px);
  void draw_cursor(const Workspace& workspace, const ImVec2& corner) const;
  void listen(Workspace& workspace, const ImVec2& corner) const;

  std::shared_ptr<const app::JobState> state_;  ///< of the drawing asked for last
  ImVec2 size_{0.0F, 0.0F};
  Later<Drawn> drawing_;
  Drawn shown_;  ///< its picture has become the texture
  Texture texture_;
  std::string error_;
};

}  // namespace adit::ui
