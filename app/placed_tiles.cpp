#include "app/placed_tiles.h"

#include "core/geometry/bounding_box.h"

namespace adit::app {

std::vector<PlacedTiles> placed_tiles(const JobState& state) {
  std::vector<PlacedTiles> tiles;
  for (std::size_t i = 0; i < state.stores.size(); ++i) {
    const PlacedScan& scan = state.results.registration.scans[i];
    if (scan.placed)
      tiles.push_back({scan.name, state.stores[i], scan.local_from_scan, scanner_at_origin(*state.stores[i])});
  }
  return tiles;
}

bool scanner_at_origin(const io::PointStore& store) {
  constexpr double farthest_m = 5.0;  // a narrow sector begins where its first wall stands
  if (!store.offset().isZero()) return false;
  BoundingBox box;
  for (std::size_t tile = 0; tile < store.tile_count(); ++tile) box.extend(store.box(tile));
  return box.isEmpty() || box.exteriorDistance(Eigen::Vector3d(Eigen::Vector3d::Zero())) <= farthest_m;
}

}  // namespace adit::app
