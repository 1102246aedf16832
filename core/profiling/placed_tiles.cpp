#include "core/profiling/placed_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr double margin_m = 0.05;
constexpr double least_squeeze = 0.2;
constexpr double unseen_kink_rad = 1e-3;  // 1 cm at a wall 10 m off
constexpr double unseen_gap_m = 0.01;

/// Chainages that a scan's box may reach, from its centre's foot. Beside an axis that turns by no more than k reach, a
/// step of (a along, n across) moves the foot by at most (a + n sin(k reach)) / (1 - k |x|). Nothing where the axis
/// bends too much for that, or has a kink.
std::optional<TileRef> reach_from_centre(const BoundingBox& in_scan, const Pose& local_from_scan,
                                         const Alignment& axis) {
  const auto at = axis.to_tunnel(local_from_scan * Eigen::Vector3d(in_scan.center()));
  if (!at) return std::nullopt;
  const double radius_m = 0.5 * in_scan.diagonal().norm();
  const double farthest_m = radius_m / least_squeeze;
  const AxisBend bend = axis.horizontal().bend_between(at->s_m - farthest_m, at->s_m + farthest_m);
  const double squeeze = 1.0 - bend.strongest_per_m * (std::abs(at->x_m) + radius_m);
  if (squeeze < least_squeeze || bend.kinks_rad > unseen_kink_rad || bend.gaps_m > unseen_gap_m) return std::nullopt;
  const Eigen::Vector2d tangent = axis.horizontal().at(at->s_m).tangent();
  const Eigen::Vector3d along = local_from_scan.linear().transpose() * Eigen::Vector3d(tangent.x(), tangent.y(), 0.0);
  const double half_length_m = 0.5 * along.cwiseAbs().dot(in_scan.sizes());
  const double turned_m = radius_m * std::min(1.0, bend.strongest_per_m * radius_m / squeeze);
  const double reach_m = std::min(radius_m, half_length_m + turned_m) / squeeze + margin_m;
  return TileRef{0, 0, at->s_m - reach_m, at->s_m + reach_m};
}

/// The same from centre and corners; nothing when the box lies beside the axis altogether.
std::optional<TileRef> reach_of_box(const BoundingBox& box, const Alignment& axis) {
  const double radius_m = 0.55 * box.diagonal().norm() + margin_m;
  TileRef ref{0, 0, 1e300, -1e300};
  for (int corner = -1; corner < 8; ++corner) {
    const Eigen::Vector3d at = corner < 0 ? Eigen::Vector3d(box.center())
                                          : Eigen::Vector3d(box.corner(static_cast<BoundingBox::CornerType>(corner)));
    if (const auto point = axis.to_tunnel(at)) {
      ref.from_m = std::min(ref.from_m, point->s_m - radius_m);
      ref.to_m = std::max(ref.to_m, point->s_m + radius_m);
    }
  }
  if (ref.from_m > ref.to_m) return std::nullopt;
  return ref;
}

std::optional<TileRef> tile_reach(const PlacedTiles& scan, std::size_t tile, const Alignment& axis) {
  const BoundingBox in_scan = scan.points->box(tile);
  if (in_scan.isEmpty()) return std::nullopt;
  if (const auto reach = reach_from_centre(in_scan, scan.local_from_scan, axis)) return reach;
  return reach_of_box(moved(in_scan, scan.local_from_scan), axis);
}

/// parts[i] = part(i) for all i in parallel, then one behind the other.
template <typename Value, typename Part>
std::vector<Value> joined_parts(std::size_t n, const Part& part) {
  std::vector<std::vector<Value>> parts(n);
  parallel_for_each_index(
      n, [&](std::size_t i) { parts[i] = part(i); }, 1);
  std::vector<Value> all;
  for (const std::vector<Value>& one : parts) all.insert(all.end(), one.begin(), one.end());
  return all;
}

}  // namespace

ChainageIndex::ChainageIndex(const std::vector<PlacedTiles>& scans, const Alignment& axis) {
  for (std::size_t s = 0; s < scans.size(); ++s) {
    std::vector<std::optional<TileRef>> reaches(scans[s].points->tile_count());
    parallel_for_each_index(
        reaches.size(), [&](std::size_t t) { reaches[t] = tile_reach(scans[s], t, axis); }, 64);
    for (std::size_t t = 0; t < reaches.size(); ++t)
      if (reaches[t]) tiles_.push_back({s, t, reaches[t]->from_m, reaches[t]->to_m});
  }
  count_scans();
}

/// By whole metres. The tiles stand scan by scan.
void ChainageIndex::count_scans() {
  struct Metre {
    std::size_t scans = 0;
    std::size_t last = 0;  ///< scan that was counted, from 1
  };
  std::map<std::int64_t, Metre> metres;
  const auto metre_of = [](double s_m) { return static_cast<std::int64_t>(std::floor(s_m)); };
  for (const TileRef& tile : tiles_)
    for (std::int64_t m = metre_of(tile.from_m); m <= metre_of(tile.to_m); ++m)
      if (Metre& metre = metres[m]; metre.last != tile.scan + 1) metre = {metre.scans + 1, tile.scan + 1};
  for (TileRef& tile : tiles_) tile.scans_beside = metres.at(metre_of(0.5 * (tile.from_m + tile.to_m))).scans;
}

std::vector<TileRef> ChainageIndex::between(double from_m, double to_m) const {
  std::vector<TileRef> here;
  for (const TileRef& tile : tiles_)
    if (tile.to_m >= from_m && tile.from_m <= to_m) here.push_back(tile);
  return here;
}

std::vector<SlabPoint> points_of_slab(const std::vector<PlacedTiles>& scans, const ChainageIndex& index,
                                      const Alignment& axis, double from_m, double to_m, const Progress& progress) {
  const std::vector<TileRef> tiles = index.between(from_m, to_m);
  const TunnelFrames frames(axis, from_m, to_m);
  return joined_parts<SlabPoint>(tiles.size(), [&](std::size_t i) {
    progress.check();
    std::vector<SlabPoint> points;
    visit_slab_of_tile(scans, tiles[i], all_points, frames, [&](const SlabPoint& point) { points.push_back(point); });
    return points;
  });
}

std::vector<Eigen::Vector3d> points_in_box(const std::vector<PlacedTiles>& scans, const BoundingBox& box,
                                           const Progress& progress) {
  std::vector<Eigen::Vector3d> all;
  for (const PlacedTiles& scan : scans) {
    const auto points = joined_parts<Eigen::Vector3d>(scan.points->tile_count(), [&](std::size_t tile) {
      progress.check();
      std::vector<Eigen::Vector3d> inside;
      if (!moved(scan.points->box(tile), scan.local_from_scan).intersects(box)) return inside;
      for (const auto& p : scan.points->positions(tile)) {
        const Eigen::Vector3d local = scan.local_from_scan * p.cast<double>();
        if (box.contains(local)) inside.push_back(local);
      }
      return inside;
    });
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

}  // namespace adit
