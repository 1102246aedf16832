#pragma once
// What a 3D picture shows, as plain values in the local frame [m].

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/surface/mesh.h"
#include "render/camera.h"
#include "render/colour_map.h"
#include "render/gl_context.h"
#include "render/picture.h"

namespace adit::render {

/// Points in one colour or, when colours is as long as points, each in its own.
struct SceneCloud {
  std::string name;  ///< for the legend of names
  std::vector<Eigen::Vector3f> points;
  Colour colour = colours::grey;
  std::vector<std::array<std::uint8_t, 3>> colours;
  double point_px = 2.0;
};

/// A surface. deviations_m is empty (one colour) or one for each mesh point; NaN is drawn grey.
struct SceneMesh {
  MeshArrays surface;
  std::vector<float> deviations_m;
  Colour colour{0.75, 0.75, 0.72};
};

struct SceneLine {
  std::vector<Eigen::Vector3d> points;
  Colour colour = colours::ink_blue;
  double width_px = 2.0;
};

/// Words at a place; always on top. A marker is a small triangle under them.
struct SceneLabel {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::string text;
  bool marker = false;
};

struct Scene {
  std::vector<SceneCloud> clouds;
  std::vector<SceneMesh> meshes;
  std::vector<SceneLine> lines;
  std::vector<SceneLabel> labels;
  std::optional<DeviationScale> scale;  ///< colours of deviations and the legend
  bool dark = false;                    ///< near black instead of white behind everything
  bool name_clouds = false;             ///< legend of the clouds' names
};

/// The scene as a picture with labels, legend and, in orthographic views, a scale bar and a north arrow. Makes the
/// context current. Needs it for about half a second per million points.
Picture draw_scene(const Scene& scene, const Camera& camera, int width, int height, const GlContext& context);

/// Labels, legend, scale bar and north arrow on a picture of the bare scene.
Picture annotated(const Picture& bare, const Scene& scene, const Camera& camera);

}  // namespace adit::render
