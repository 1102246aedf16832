#include "core/profiling/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr double cell_m = 0.2;
constexpr std::size_t tiles_at_a_time = 64;

using Cell = std::array<int, 3>;

Cell cell_of(const TunnelPoint& at) {
  const auto index = [](double value) { return static_cast<int>(std::floor(value / cell_m)); };
  return {index(at.s_m), index(at.x_m), index(at.z_m)};
}

void add(const Intrusion& more, Intrusion& sum) {
  const bool first = sum.points == 0;
  if (first || more.deepest.inside_m > sum.deepest.inside_m) sum.deepest = more.deepest;
  sum.from_m = first ? more.from_m : std::min(sum.from_m, more.from_m);
  sum.to_m = first ? more.to_m : std::max(sum.to_m, more.to_m);
  sum.points += more.points;
}

/// Cells that touch one another become one intrusion.
std::vector<Intrusion> joined(std::map<Cell, Intrusion> cells) {
  std::vector<Intrusion> intrusions;
  while (!cells.empty()) {
    Intrusion sum;
    std::vector<Cell> next{cells.begin()->first};
    while (!next.empty()) {
      const Cell cell = next.back();
      next.pop_back();
      const auto found = cells.find(cell);
      if (found == cells.end()) continue;
      add(found->second, sum);
      cells.erase(found);
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b)
          for (int c = -1; c <= 1; ++c)
            if (cells.count({cell[0] + a, cell[1] + b, cell[2] + c}) != 0)
              next.push_back({cell[0] + a, cell[1] + b, cell[2] + c});
    }
    intrusions.push_back(sum);
  }
  std::sort(intrusions.begin(), intrusions.end(), [](const Intrusion& a, const Intrusion& b) {
    return a.from_m != b.from_m ? a.from_m < b.from_m : a.deepest.inside_m > b.deepest.inside_m;
  });
  return intrusions;
}

}  // namespace

ClearanceResult find_intrusions(const std::vector<PlacedTiles>& scans, const ChainageIndex& index,
                                const DesignTunnel& design, const DesignLine& line, double from_m, double to_m,
                                double least_range_m, double most_range_m, Progress& progress) {
  const double lean_m = design.lean_m(from_m, to_m);
  const TunnelFrames frames(design.alignment(), from_m - lean_m, to_m + lean_m);
  const std::vector<TileRef> tiles = index.between(from_m - lean_m, to_m + lean_m);
  ClearanceResult result;
  result.line = line.name;
  result.line_offset_m = line.offset_m;
  std::map<Cell, Intrusion> cells;
  for (std::size_t begin = 0; begin < tiles.size(); begin += tiles_at_a_time) {
    progress.step(begin, tiles.size());
    const std::size_t count = std::min(tiles_at_a_time, tiles.size() - begin);
    std::vector<std::vector<ClearancePoint>> found(count);
    parallel_for_each_index(
        count,
        [&](std::size_t k) {
          progress.check();
          const TileRef& ref = tiles[begin + k];
          const PlacedTiles& scan = scans[ref.scan];
          visit_slab_of_tile(scans, ref, scan.points->point_count(ref.tile), frames, [&](const SlabPoint& point) {
            const auto range_m = static_cast<double>(point.range_m);
            if (scan.scanner_at_origin && (range_m < least_range_m || range_m > most_range_m)) return;
            const TunnelPoint at = design.in_section(point.at);
            if (at.s_m < from_m || at.s_m >= to_m) return;
            const double deviation_m = design.profile_at(at.s_m).nearest({at.x_m, at.z_m}).deviation_m;
            const double inside_m = design.line_at(line, at.s_m).offset_m - deviation_m;
            if (inside_m > 0.0) found[k].push_back({ref.scan, at, inside_m});
          });
        },
        1);
    for (const auto& of_tile : found)
      for (const ClearancePoint& point : of_tile) {
        add({1, point.at.s_m, point.at.s_m, false, point, {}}, cells[cell_of(point.at)]);
        ++result.points;
        if (result.list.size() < ClearanceResult::most_listed) result.list.push_back(point);
      }
  }
  result.intrusions = joined(std::move(cells));
  for (Intrusion& intrusion : result.intrusions) {
    intrusion.deepest_site = design.to_site(intrusion.deepest.at);
    intrusion.cut = intrusion.from_m < from_m + cell_m || intrusion.to_m > to_m - cell_m;
  }
  return result;
}

}  // namespace adit
