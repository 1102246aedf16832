#pragma once
// The bare scene (no labels) drawn off screen in the current OpenGL context: what the window shows as a texture.

#include <memory>

#include "render/camera.h"
#include "render/picture.h"
#include "render/scene.h"

namespace adit::render {

/// All calls, the destructor too, with the same context current as at construction.
class SceneView {
 public:
  SceneView(int width, int height);
  ~SceneView();
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  /// Uploads points and triangles at the next render().
  void set_scene(const Scene& scene);
  void set_camera(const Camera& camera);
  void resize(int width, int height);
  int width() const;
  int height() const;

  /// Draws into the view's own framebuffer. Leaves other framebuffers alone, but OpenGL state as VTK likes it.
  void render();

  /// OpenGL name of the texture with the last frame (rows from the bottom); 0 before the first render().
  unsigned int texture() const;

  /// The last frame.
  Picture picture() const;

 private:
  struct Stage;
  std::unique_ptr<Stage> stage_;
};

}  // namespace adit::render
