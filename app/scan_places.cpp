#include "app/scan_places.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "app/placed_tiles.h"
#include "core/geometry/bounding_box.h"

namespace adit::app {
namespace {

/// Where a placed scan was taken, site: its scanner, or the middle of points that came without one.
Eigen::Vector3d place_of(const JobState& state, std::size_t scan) {
  const io::PointStore& store = *state.stores[scan];
  const Pose& local_from_scan = state.results.registration.scans[scan].local_from_scan;
  Eigen::Vector3d in_scan = Eigen::Vector3d::Zero();
  if (!scanner_at_origin(store)) {
    BoundingBox box;
    for (std::size_t tile = 0; tile < store.tile_count(); ++tile) box.extend(store.box(tile));
    in_scan = box.center();
  }
  return state.results.import.origin.to_site(local_from_scan * in_scan);
}

std::string place_in_words(const Alignment& axis, const Eigen::Vector3d& place) {
  char words[120];
  const double distance = distance_to_axis_m(axis, place.head<2>());
  const auto at = axis.to_tunnel(place);
  if (at && std::abs(at->x_m) < 1000.0)
    std::snprintf(words, sizeof words, "at chainage %.1f, %.1f m %s of the axis", at->s_m, std::abs(at->x_m),
                  at->x_m < 0.0 ? "left" : "right");
  else
    std::snprintf(words, sizeof words, "%.0f m from the axis", distance);
  return words;
}

}  // namespace

double distance_to_axis_m(const Alignment& axis, const Eigen::Vector2d& place) {
  const double from = axis.horizontal().from_m();
  const double length = axis.horizontal().to_m() - from;
  const int steps = static_cast<int>(std::clamp(length / 20.0, 1.0, 10000.0));
  double nearest = std::numeric_limits<double>::max();
  for (int i = 0; i <= steps; ++i)
    nearest = std::min(nearest, (axis.horizontal().at(from + length * i / steps).position - place).norm());
  return nearest;
}

Findings scans_beside_axis(const JobState& state) {
  Findings findings;
  if (!state.alignment || !state.results.registration.in_site) return findings;
  const auto& scans = state.results.registration.scans;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!scans[i].placed) continue;
    const Eigen::Vector3d place = place_of(state, i);
    if (distance_to_axis_m(*state.alignment, place.head<2>()) <= farthest_scan_from_axis_m) continue;
    const bool swapped = distance_to_axis_m(*state.alignment, {place.y(), place.x()}) <= farthest_scan_from_axis_m;
    findings.push_back({Severity::decision, "scan " + scans[i].name,
                        "stands " + place_in_words(*state.alignment, place) + ", far from the tunnel",
                        swapped ? "east and north seem to be swapped: check the poses and the control"
                                : "check the poses, the control and the axis: do they use the same coordinates?"});
  }
  return findings;
}

std::string places_in_words(const JobState& state) {
  constexpr std::size_t most_scans = 3;
  std::string words;
  std::size_t named = 0;
  const auto& scans = state.results.registration.scans;
  for (std::size_t i = 0; i < scans.size() && state.alignment; ++i) {
    if (!scans[i].placed) continue;
    if (++named > most_scans) return words + ", ...";
    words += (words.empty() ? "scan " : ", scan ") + scans[i].name + " stands " +
             place_in_words(*state.alignment, place_of(state, i));
  }
  return words;
}

}  // namespace adit::app
