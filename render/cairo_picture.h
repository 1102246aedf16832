#pragma once
// Pictures to and from cairo surfaces; for the files of render/ named *_cairo alone.

#include <cairo.h>

#include "render/picture.h"

namespace adit::render {

/// A new surface with a copy of the picture (premultiplied; without alpha when the picture is opaque). The caller
/// destroys it.
cairo_surface_t* cairo_surface_of(const Picture& picture);

/// A copy of an image surface.
Picture picture_of(cairo_surface_t* surface);

}  // namespace adit::render
