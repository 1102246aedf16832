#include "render/report_views.h"

#include <algorithm>
#include <cmath>

#include "render/axes.h"
#include "render/number_text.h"
#include "render/scene.h"

namespace adit::render {
namespace {

constexpr int view_width = 1600;
constexpr int above_height = 620;
constexpr int along_height = 1000;
constexpr double eye_height_m = 1.7;

std::vector<Eigen::Vector3d> box_corners(const ReportContent& content) {
  BoundingBox box;
  for (const OverviewCloud& cloud : content.clouds)
    for (const Eigen::Vector3f& p : cloud.points) box.extend(p.cast<double>());
  if (content.mesh != nullptr)
    for (const Eigen::Vector3d& p : content.mesh->points) box.extend(p);
  return corners(box);
}

// For the frame of a picture: every n-th point is enough.
std::vector<Eigen::Vector3d> some_points(const ReportContent& content, bool of_mesh) {
  std::vector<Eigen::Vector3d> some;
  if (of_mesh) {
    const std::size_t step = content.mesh->points.size() / 20000 + 1;
    for (std::size_t i = 0; i < content.mesh->points.size(); i += step) some.push_back(content.mesh->points[i]);
  } else {
    for (const OverviewCloud& cloud : content.clouds)
      for (std::size_t i = 0; i < cloud.points.size(); i += cloud.points.size() / 5000 + 1)
        some.push_back(cloud.points[i].cast<double>());
  }
  return some;
}

struct Path {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d heading = Eigen::Vector3d::UnitX();  ///< from one end to the other
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();    ///< at the start
};

std::vector<Eigen::Vector3d> station_places(const ReportContent& content) {
  std::vector<Eigen::Vector3d> places;
  for (const PlacedScan& scan : content.results->registration.scans)
    if (scan.placed) places.push_back(scan.local_from_scan.translation());
  return places;
}

// Along the axis; without one from the first station to the last, then along the longest side of the box.
Path path_of(const ReportContent& content) {
  Path path;
  std::vector<Eigen::Vector3d> line = local_axis(content);
  if (line.size() > 1) {
    for (Eigen::Vector3d& p : line) p.z() += eye_height_m;
  } else {
    line = station_places(content);
  }
  if (line.size() < 2 || (line.back() - line.front()).norm() < 0.5) {
    const std::vector<Eigen::Vector3d> box = box_corners(content);
    if (box.empty()) return path;
    const Eigen::Vector3d size = box.back() - box.front(), middle = (box.back() + box.front()) / 2.0;
    const Eigen::Vector3d half =
        size.x() >= size.y() ? Eigen::Vector3d(size.x() / 2.2, 0, 0) : Eigen::Vector3d(0, size.y() / 2.2, 0);
    line = {middle - half, middle + half};
  }
  path.start = line.front();
  path.heading = (line.back() - line.front()).normalized();
  const std::size_t next = std::max<std::size_t>(1, line.size() / 5);
  path.ahead = (line[next] - line.front()).normalized();
  return path;
}

void add_axis(Scene& scene, const ReportContent& content, bool labels) {
  const std::vector<Eigen::Vector3d> axis = local_axis(content);
  if (axis.size() < 2) return;
  scene.lines.push_back({axis, colours::ink_blue, 2.0});
  if (!labels) return;
  const auto& sections = content.results->profile->sections;
  for (double s : nice_ticks(sections.front().chainage_m, sections.back().chainage_m, 8).values)
    for (std::size_t i = 0; i < sections.size(); ++i)
      if (std::abs(sections[i].chainage_m - s) < 1e-6) scene.labels.push_back({axis[i], fixed(s, 0), false});
}

void add_stations(Scene& scene, const ReportContent& content) {
  for (const PlacedScan& scan : content.results->registration.scans)
    if (scan.placed) scene.labels.push_back({scan.local_from_scan.translation(), scan.name, true});
}

Scene scene_of_scans(const ReportContent& content) {
  Scene scene;
  for (std::size_t i = 0; i < content.clouds.size(); ++i)
    scene.clouds.push_back({content.clouds[i].name, content.clouds[i].points, scan_colour(i), {}, 2.0});
  scene.name_clouds = true;
  return scene;
}

Scene scene_of_deviations(const ReportContent& content) {
  Scene scene;
  scene.meshes.push_back({*content.mesh, content.mesh_deviations_m});
  if (!content.mesh_deviations_m.empty()) scene.scale = deviation_scale(content.mesh_deviations_m);
  return scene;
}

}  // namespace

std::vector<Eigen::Vector3d> local_axis(const ReportContent& content) {
  std::vector<Eigen::Vector3d> axis;
  if (!content.results->profile) return axis;
  for (const Section& section : content.results->profile->sections)
    axis.push_back(content.results->import.origin.to_local(section.axis_site));
  return axis;
}

std::vector<ReportView> draw_views(const ReportContent& content, const GlContext& context, Progress& progress) {
  std::vector<ReportView> views;
  const Path path = path_of(content);
  const double aspect = static_cast<double>(view_width) / above_height;
  const Camera inside = along_tunnel(path.start, path.ahead);
  const bool on_axis = !local_axis(content).empty();
  const bool has_mesh = content.mesh != nullptr && !content.mesh->triangles.empty();
  const auto draw = [&](const char* name, const char* words, const Scene& scene, const Camera& camera, int height) {
    progress.check();
    views.push_back({name, words, draw_scene(scene, camera, view_width, height, context)});
  };
  if (!content.clouds.empty()) {
    Scene scene = scene_of_scans(content);
    draw("scans_along.png", on_axis ? "The scans from inside, looking up-chainage." : "The scans from inside.", scene,
         inside, along_height);
    add_axis(scene, content, false);
    add_stations(scene, content);
    draw("scans_above.png",
         on_axis ? "The scans from above, chainage to the right; a triangle at each station."
                 : "The scans from above; a triangle at each station.",
         scene, top_view(some_points(content, false), path.heading, aspect), above_height);
    std::swap(views[0], views[1]);
  }
  if (has_mesh) {
    Scene scene = scene_of_deviations(content);
    draw("deviation_along.png",
         on_axis ? "The rock surface from inside, looking up-chainage, coloured by its deviation."
                 : "The surface from inside.",
         scene, inside, along_height);
    add_axis(scene, content, true);
    draw("deviation_above.png",
         on_axis ? "The rock surface from outside, seen from above and the right, coloured by its deviation."
                 : "The surface from outside.",
         scene, oblique(some_points(content, true), path.heading, aspect), above_height);
    std::swap(views[views.size() - 2], views[views.size() - 1]);
  }
  return views;
}

}  // namespace adit::render
