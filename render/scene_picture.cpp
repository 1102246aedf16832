#include <algorithm>
#include <cmath>

#include "render/canvas.h"
#include "render/map_signs.h"
#include "render/scene_view.h"

namespace adit::render {
namespace {

constexpr double dots_per_inch = 200.0;  // 1600 pixels are then 203 mm: text is as large as on a page
constexpr double mm_per_pixel = 25.4 / dots_per_inch;

void draw_labels(Canvas& canvas, const Scene& scene, const Camera& camera, int width, int height) {
  const Colour halo = scene.dark ? colours::black : colours::white;
  const Colour ink = scene.dark ? colours::white : colours::black;
  for (const SceneLabel& label : scene.labels) {
    const auto pixel = pixel_of(camera, width, height, label.position);
    if (!pixel || pixel->x() < 0.0 || pixel->x() > width || pixel->y() < 0.0 || pixel->y() > height) continue;
    const PaperPoint at = *pixel * mm_per_pixel;
    const double above = label.marker ? 2.2 : 0.0;
    if (label.marker) {
      canvas.fill({{at + PaperPoint(0.0, -2.1), at + PaperPoint(1.9, 1.4), at + PaperPoint(-1.9, 1.4)}},
                  colours::white);
      canvas.fill({{at + PaperPoint(0.0, -1.6), at + PaperPoint(1.4, 1.0), at + PaperPoint(-1.4, 1.0)}}, colours::red);
    }
    canvas.text(at - PaperPoint(0.0, above), label.text,
                {.size_mm = 2.8,
                 .colour = ink,
                 .bold = true,
                 .across = Across::centre,
                 .down = label.marker ? Down::bottom : Down::middle,
                 .halo_mm = 0.5,
                 .halo = halo});
  }
}

void draw_signs(Canvas& canvas, const Scene& scene, const Camera& camera, int height) {
  const double w = canvas.width_mm(), h = canvas.height_mm();
  if (camera.orthographic) {
    const double bottom = scene.name_clouds ? h - 3.0 : 8.0;  // where the names do not stand
    canvas.fill(Rect{1.5, bottom - 5.5, 0.2 * w + 4.0, 7.0}, {1.0, 1.0, 1.0, 0.8});
    draw_scale_bar(canvas, {3.0, bottom}, height / camera.view_height_m * mm_per_pixel, 0.2 * w, 2.6);
    const CameraAxes axes = axes_of(camera);
    // Only in plan: elsewhere an arrow to the north would mislead.
    if (axes.ahead.z() < -0.999) draw_north_arrow(canvas, {w - 7.0, 9.0}, 8.0, std::atan2(axes.right.y(), axes.up.y()));
  }
  if (scene.scale) {
    const double wide = std::min(98.0, 0.62 * w);
    const Rect box{w - wide - 2.0, h - 14.0, wide, 13.0};
    canvas.fill(box, {1.0, 1.0, 1.0, 0.85});
    draw_deviation_legend(canvas, {box.left + 5.0, box.top + 1.5, box.width - 19.0, 10.0}, *scene.scale);
  }
  if (scene.name_clouds) {
    std::vector<NamedColour> names;
    for (const SceneCloud& cloud : scene.clouds) names.push_back({cloud.name, cloud.colour});
    const auto room = static_cast<std::size_t>(std::max(1.0, (h - 16.0) / 3.9));
    if (names.size() > room) {
      const std::size_t missing = names.size() - room + 1;
      names.resize(room - 1);
      names.push_back({"and " + std::to_string(missing) + " more", colours::white});
    }
    draw_names(canvas, {2.5, 2.5}, names, 2.6);
  }
}

}  // namespace

Picture annotated(const Picture& bare, const Scene& scene, const Camera& camera) {
  Canvas canvas = Canvas::over(bare, dots_per_inch);
  draw_labels(canvas, scene, camera, bare.width, bare.height);
  draw_signs(canvas, scene, camera, bare.height);
  return canvas.finish_picture();
}

Picture draw_scene(const Scene& scene, const Camera& camera, int width, int height, const GlContext& context) {
  context.make_current();
  SceneView view(width, height);
  view.set_scene(scene);
  view.set_camera(camera);
  view.render();
  return annotated(view.picture(), scene, camera);
}

}  // namespace adit::render
