#include "ui/overview.h"
#include "app/placed_tiles.h"

#include <algorithm>
#include <cmath>

#include "render/deviation_map_drawing.h"
#include "render/report_views.h"

namespace adit::ui {
namespace {

constexpr double eye_height_m = 1.7;

render::SceneCloud cloud_of(const app::JobState& state, std::size_t scan, double share) {
  const io::PointStore& store = *state.stores[scan];
  const Pose& pose = state.results.registration.scans[scan].local_from_scan;
  const bool limited = app::scanner_at_origin(store);
  const double most_range_m = state.job.options.profiling.most_range_m;
  render::SceneCloud cloud;
  cloud.name = state.job.scans[scan].name;
  cloud.colour = render::scan_colour(scan);
  for (std::size_t tile = 0; tile < store.tile_count(); ++tile) {
    const auto prefix = static_cast<std::size_t>(std::ceil(share * static_cast<double>(store.point_count(tile))));
    for (const auto& p : store.positions(tile, prefix))
      if (!limited || static_cast<double>(p.norm()) <= most_range_m)
        cloud.points.push_back((pose * p.cast<double>()).cast<float>());
  }
  return cloud;
}

void add_clouds(Overview& overview, const app::JobState& state) {
  const auto& scans = state.results.registration.scans;
  const std::size_t count = std::min(state.stores.size(), scans.size());
  double total = 1.0;
  for (std::size_t i = 0; i < count; ++i) total += static_cast<double>(state.stores[i]->points());
  const double share = std::min(1.0, static_cast<double>(overview_points) / total);
  for (std::size_t i = 0; i < count; ++i) {
    if (!scans[i].placed) continue;
    overview.clouds.push_back(cloud_of(state, i, share));
    overview.scans.push_back(i);
    overview.stations.push_back({scans[i].local_from_scan.translation(), scans[i].name, true});
  }
}

void add_mesh(Overview& overview, const app::JobState& state) {
  if (!state.mesh || state.mesh->mesh.triangles.empty()) return;
  overview.mesh = render::SceneMesh{state.mesh->mesh, state.mesh->deviation_m};
  if (!state.mesh->deviation_m.empty())
    overview.scale = render::deviation_scale(state.map ? render::seen_deviations(*state.map) : state.mesh->deviation_m);
}

Eigen::Vector3d direction_at(const std::vector<Eigen::Vector3d>& axis, std::size_t i) {
  const std::size_t next = std::min(i + 1, axis.size() - 1), before = next > 0 ? next - 1 : 0;
  const Eigen::Vector3d step = axis[next] - axis[before];
  return step.norm() > 1e-6 ? Eigen::Vector3d(step.normalized()) : Eigen::Vector3d::UnitX();
}

}  // namespace

std::vector<Eigen::Vector3d> Overview::extent(SceneShows shows) const {
  std::vector<Eigen::Vector3d> some;
  if (shows == SceneShows::deviation && mesh) {
    const auto& points = mesh->surface.points;
    for (std::size_t i = 0; i < points.size(); i += points.size() / 5000 + 1) some.push_back(points[i]);
    return some;
  }
  for (const render::SceneCloud& cloud : clouds)
    for (std::size_t i = 0; i < cloud.points.size(); i += cloud.points.size() / 2000 + 1)
      some.push_back(cloud.points[i].cast<double>());
  return some;
}

Eigen::Vector3d Overview::heading() const {
  if (axis.size() > 1 && (axis.back() - axis.front()).head<2>().norm() > 0.5) return axis.back() - axis.front();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : extent(SceneShows::scans)) box.extend(p);
  if (box.isEmpty() || box.sizes().x() >= box.sizes().y()) return Eigen::Vector3d::UnitX();
  return Eigen::Vector3d::UnitY();
}

Overview overview_of(const app::JobState& state) {
  Overview overview;
  add_clouds(overview, state);
  add_mesh(overview, state);
  render::ReportContent content;
  content.results = &state.results;
  overview.axis = render::local_axis(content);
  if (overview.axis.empty())
    for (const render::SceneLabel& station : overview.stations)  // about the floor beneath the scanners
      overview.axis.push_back(station.position - Eigen::Vector3d(0.0, 0.0, eye_height_m));
  return overview;
}

render::Scene scene_of(const Overview& overview, SceneShows shows, std::optional<std::size_t> selected_scan) {
  render::Scene scene;
  if (shows == SceneShows::deviation && overview.mesh) {
    scene.meshes.push_back(*overview.mesh);
    scene.scale = overview.scale;
  } else {
    scene.clouds = overview.clouds;
    for (std::size_t i = 0; i < scene.clouds.size(); ++i)
      if (selected_scan && overview.scans[i] != *selected_scan)
        scene.clouds[i].colour = render::mixed(scene.clouds[i].colour, render::colours::pale_grey, 0.85);
  }
  if (overview.axis.size() > 1) scene.lines.push_back({overview.axis, render::colours::ink_blue, 2.0});
  return scene;
}

render::Camera inside_view(const Overview& overview, std::size_t section) {
  if (overview.axis.empty()) return render::along_tunnel(Eigen::Vector3d::Zero(), overview.heading());
  const std::size_t i = std::min(section, overview.axis.size() - 1);
  const Eigen::Vector3d eye = overview.axis[i] + Eigen::Vector3d(0.0, 0.0, eye_height_m);
  return render::along_tunnel(eye, direction_at(overview.axis, i));
}

std::vector<Eigen::Vector3d> ring_of(const app::JobState& state, const Section& section) {
  std::vector<Eigen::Vector3d> ring;
  if (!state.alignment || section.outline.empty()) return ring;
  const Eigen::Vector2d tangent = state.alignment->horizontal().at(section.chainage_m).tangent();
  const Eigen::Vector3d right(tangent.y(), -tangent.x(), 0.0);
  const Eigen::Vector3d axis = state.results.import.origin.to_local(section.axis_site);
  for (std::size_t i = 0; i < section.outline.size(); i += 4) {
    const Eigen::Vector2d& p = section.outline[i].position;
    ring.push_back(axis + p.x() * right + p.y() * Eigen::Vector3d::UnitZ());
  }
  return ring;
}

}  // namespace adit::ui
