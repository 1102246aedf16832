#include "app/placed_tiles.h"

namespace adit::app {

std::vector<PlacedTiles> placed_tiles(const JobState& state) {
  std::vector<PlacedTiles> tiles;
  for (std::size_t i = 0; i < state.stores.size(); ++i) {
    const PlacedScan& scan = state.results.registration.scans[i];
    if (scan.placed)
      tiles.push_back({scan.name, state.stores[i], scan.local_from_scan, state.stores[i]->offset().isZero()});
  }
  return tiles;
}

}  // namespace adit::app
