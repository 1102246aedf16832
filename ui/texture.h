#pragma once
// A picture as an OpenGL texture for ImGui.

#include <imgui.h>

#include "render/picture.h"

namespace adit::ui {

/// Made and destroyed with the window's context current.
class Texture {
 public:
  Texture() = default;
  explicit Texture(const render::Picture& picture);
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  ~Texture();

  bool empty() const { return name_ == 0; }
  ImTextureID id() const;
  ImVec2 size() const { return {static_cast<float>(width_), static_cast<float>(height_)}; }

 private:
  unsigned int name_ = 0;
  int width_ = 0;
  int height_ = 0;
};

/// An OpenGL texture name as ImGui takes it.
ImTextureID texture_id(unsigned int name);

}  // namespace adit::ui
