#pragma once
// The scene of a job, thinned so that it stays fluid, local frame [m].

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "app/job_state.h"
#include "render/scene.h"

namespace adit::ui {

/// Points of all scans together in a scene.
inline constexpr std::size_t overview_points = 500000;

enum class SceneShows { scans, deviation };

struct Overview {
  std::vector<render::SceneCloud> clouds;  ///< the placed scans
  std::vector<std::size_t> scans;          ///< of each cloud
  std::optional<render::SceneMesh> mesh;
  std::optional<render::DeviationScale> scale;  ///< of deviations, as on the map
  std::vector<Eigen::Vector3d> axis;            ///< one point for each section; else the stations in order
  std::vector<render::SceneLabel> stations;

  bool empty() const { return clouds.empty() && !mesh; }
  /// A few thousand of the points that are shown, to fit a camera to.
  std::vector<Eigen::Vector3d> extent(SceneShows shows) const;
  /// Horizontal direction from the beginning to the end.
  Eigen::Vector3d heading() const;
};

/// Reads the overview of every store. Throws Error when a store is damaged.
Overview overview_of(const app::JobState& state);

/// The selected scan in its colour and the others pale; without a selection all in their colours.
render::Scene scene_of(const Overview& overview, SceneShows shows, std::optional<std::size_t> selected_scan);

/// From the axis at a section (1.7 m above it), or at the first station, looking up-chainage.
render::Camera inside_view(const Overview& overview, std::size_t section);

/// The outline of a section as a ring.
std::vector<Eigen::Vector3d> ring_of(const app::JobState& state, const Section& section);

}  // namespace adit::ui
