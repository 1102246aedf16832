#include "ui/texture.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <cstdint>
#include <utility>

namespace adit::ui {

ImTextureID texture_id(unsigned int name) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name));
}

Texture::Texture(const render::Picture& picture) : width_(picture.width), height_(picture.height) {
  glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  // Drawings are shown pixel for pixel; smooth only while the panel is being resized.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
}

Texture::Texture(Texture&& other) noexcept
    : name_(std::exchange(other.name_, 0)), width_(other.width_), height_(other.height_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
  std::swap(name_, other.name_);
  width_ = other.width_;
  height_ = other.height_;
  return *this;
}

Texture::~Texture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

ImTextureID Texture::id() const {
  return texture_id(name_);
}

}  // namespace adit::ui
