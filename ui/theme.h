#pragma once
// Fonts, scale and colours of the window.

#include <imgui.h>

#include "core/foundation/finding.h"
#include "render/colour.h"

namespace adit::ui {

namespace theme {
inline const ImVec4 quiet{0.42F, 0.44F, 0.47F, 1.0F};
inline const ImVec4 good{0.07F, 0.45F, 0.20F, 1.0F};
inline const ImVec4 doubt{0.66F, 0.38F, 0.00F, 1.0F};
inline const ImVec4 bad{0.75F, 0.08F, 0.10F, 1.0F};
inline const ImVec4 accent{0.12F, 0.36F, 0.62F, 1.0F};
inline const ImVec4 paper{1.0F, 1.0F, 1.0F, 1.0F};
}  // namespace theme

/// DejaVu Sans (ImGui's own font where it is not installed) and light colours, for a screen of this scale (1: 96 dots
/// per inch). The font's texture must be made anew afterwards.
void apply_theme(float scale);

/// Scale of the theme in use: pixels that were 1 at 96 dots per inch.
float scale_of_theme();

/// Text drawn while this lives is bold.
class BoldText {
 public:
  BoldText();
  ~BoldText();
  BoldText(const BoldText&) = delete;
  BoldText& operator=(const BoldText&) = delete;
};

ImVec4 colour_of(Severity severity);
ImU32 packed(const render::Colour& colour);
ImU32 packed(const ImVec4& colour);

}  // namespace adit::ui
