#include <cstring>
#include <memory>

#include "core/foundation/error.h"
#include "render/cairo_picture.h"

namespace adit::render {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

std::uint32_t premultiplied(std::uint32_t value, std::uint32_t alpha) {
  return (value * alpha + 127) / 255;
}

std::uint8_t plain(std::uint32_t value, std::uint32_t alpha) {
  return alpha == 0 ? std::uint8_t{0}
                    : static_cast<std::uint8_t>(std::min<std::uint32_t>(255, (value * 255 + alpha / 2) / alpha));
}

bool opaque(const Picture& picture) {
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] != 255) return false;
  return true;
}

cairo_status_t append(void* closure, const unsigned char* bytes, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

struct Reading {
  const std::string& bytes;
  std::size_t at = 0;
};

cairo_status_t take(void* closure, unsigned char* bytes, unsigned int length) {
  auto& reading = *static_cast<Reading*>(closure);
  if (reading.bytes.size() - reading.at < length) return CAIRO_STATUS_READ_ERROR;
  std::memcpy(bytes, reading.bytes.data() + reading.at, length);
  reading.at += length;
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

cairo_surface_t* cairo_surface_of(const Picture& picture) {
  const auto format = opaque(picture) ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32;
  cairo_surface_t* surface = cairo_image_surface_create(format, picture.width, picture.height);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(surface);
    throw Error("a picture of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                " pixels cannot be made");
  }
  cairo_surface_flush(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  unsigned char* rows = cairo_image_surface_get_data(surface);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto p = picture.pixel(x, y);
      const std::uint32_t value = std::uint32_t{p[3]} << 24 | premultiplied(p[0], p[3]) << 16 |
                                  premultiplied(p[1], p[3]) << 8 | premultiplied(p[2], p[3]);
      std::memcpy(rows + static_cast<std::size_t>(y) * stride + 4 * static_cast<std::size_t>(x), &value, 4);
    }
  cairo_surface_mark_dirty(surface);
  return surface;
}

Picture picture_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  Picture picture = blank_picture(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  const bool has_alpha = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_ARGB32;
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  const unsigned char* rows = cairo_image_surface_get_data(surface);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      std::uint32_t value = 0;
      std::memcpy(&value, rows + static_cast<std::size_t>(y) * stride + 4 * static_cast<std::size_t>(x), 4);
      const std::uint32_t alpha = has_alpha ? value >> 24 : 255;
      picture.set_pixel(x, y,
                        {plain(value >> 16 & 255, alpha), plain(value >> 8 & 255, alpha), plain(value & 255, alpha),
                         static_cast<std::uint8_t>(alpha)});
    }
  return picture;
}

std::string png_bytes(const Picture& picture) {
  const Surface surface(cairo_surface_of(picture), cairo_surface_destroy);
  std::string bytes;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw Error("a picture could not be written as PNG");
  return bytes;
}

Picture picture_from_png(const std::string& bytes) {
  Reading reading{bytes};
  const Surface surface(cairo_image_surface_create_from_png_stream(take, &reading), cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) throw Error("these bytes are no PNG picture");
  const auto format = cairo_image_surface_get_format(surface.get());
  if (format != CAIRO_FORMAT_ARGB32 && format != CAIRO_FORMAT_RGB24)
    throw Error("a PNG picture of 8 bits a channel is needed");
  return picture_of(surface.get());
}

}  // namespace adit::render
