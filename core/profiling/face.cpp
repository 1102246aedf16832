#include "core/profiling/face.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr double margin_m = 1.5;        // of the grid around the profile: rock breaks out
constexpr double coarse_step_m = 0.5;   // of the look for the face
constexpr double band_m = 0.1;          // points this close behind one another are one surface
constexpr double cell_relief_m = 0.3;   // within a cell
constexpr double before_face_m = 0.5;   // what stands so far before it, from the floor on, hides it
constexpr double muck_slope = 0.5;      // above that heap the muck goes on as long as it leans so much
constexpr double points_a_cell = 8.0;   // of the grid: sparse scans get wider cells
constexpr std::size_t coarse_part = 8;  // of a tile's points

struct FacePoint {
  std::uint32_t cell;
  double ahead_m;  ///< chainage in the direction of drive
};

/// A search for the face on a grid of one step, in one stretch.
struct Search {
  const std::vector<PlacedTiles>& scans;
  const DesignTunnel& design;
  const FaceOptions& options;
  FaceMap grid;
  double sign = 1.0;  ///< chainage grows in the direction of drive, or falls

  std::optional<std::uint32_t> cell_of(const TunnelPoint& at) const {
    const double c = std::floor((at.x_m - grid.x_from_m) / grid.step_m);
    const double r = std::floor((at.z_m - grid.z_from_m) / grid.step_m);
    if (c < 0 || r < 0 || c >= static_cast<double>(grid.columns) || r >= static_cast<double>(grid.rows))
      return std::nullopt;
    if (design.profile_at(at.s_m).nearest({at.x_m, at.z_m}).deviation_m > -options.inset_m) return std::nullopt;
    return static_cast<std::uint32_t>(r * static_cast<double>(grid.columns) + c);
  }

  /// Points inside the profile with their cells, sorted by cell and then from far to near.
  std::vector<FacePoint> points(const ChainageIndex& index, double from_m, double to_m, std::size_t part,
                                Progress& progress) const {
    const double lean_m = design.lean_m(from_m, to_m);
    const TunnelFrames frames(design.alignment(), from_m - lean_m, to_m + lean_m);
    const std::vector<TileRef> tiles = index.between(from_m - lean_m, to_m + lean_m);
    std::vector<FacePoint> all = parallel_ordered_list(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
      std::vector<FacePoint> found;
      for (std::size_t i = begin; i < end; ++i) {
        progress.check();
        const PlacedTiles& scan = scans[tiles[i].scan];
        const std::size_t count = scan.points->point_count(tiles[i].tile);
        visit_slab_of_tile(scans, tiles[i], std::max<std::size_t>(1, count / part), frames, [&](const SlabPoint& p) {
          const auto range_m = static_cast<double>(p.range_m);
          if (scan.scanner_at_origin && (range_m < options.least_range_m || range_m > options.most_range_m)) return;
          const TunnelPoint at = design.in_section(p.at);
          if (at.s_m < from_m || at.s_m >= to_m) return;
          if (const auto cell = cell_of(at)) found.push_back({*cell, sign * at.s_m});
        });
      }
      return found;
    });
    std::sort(all.begin(), all.end(), [](const FacePoint& a, const FacePoint& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.ahead_m > b.ahead_m;
    });
    return all;
  }
};

FaceMap grid_over(const Profile& profile, double step_m) {
  FaceMap grid;
  grid.step_m = step_m;
  grid.x_from_m = profile.box().min().x() - margin_m;
  grid.z_from_m = profile.box().min().y() - margin_m;
  grid.columns = static_cast<std::size_t>(std::ceil((profile.box().sizes().x() + 2.0 * margin_m) / step_m));
  grid.rows = static_cast<std::size_t>(std::ceil((profile.box().sizes().y() + 2.0 * margin_m) / step_m));
  return grid;
}

/// The farthest place with enough points within a band: the mean of the points there. Sorted from far to near.
std::optional<double> farthest_surface(const FacePoint* begin, const FacePoint* end, int least_points) {
  const auto need = static_cast<std::ptrdiff_t>(least_points);
  for (const FacePoint* first = begin; end - first >= need; ++first) {
    if (first->ahead_m - (first + need - 1)->ahead_m > band_m) continue;
    double sum = 0.0;
    std::size_t count = 0;
    for (const FacePoint* p = first; p != end && first->ahead_m - p->ahead_m <= cell_relief_m; ++p, ++count)
      sum += p->ahead_m;
    return sum / static_cast<double>(count);
  }
  return std::nullopt;
}

/// visit(cell, begin, end) for the points of each cell.
template <typename Visit>
void for_each_cell(const std::vector<FacePoint>& points, const Visit& visit) {
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin;
    while (end < points.size() && points[end].cell == points[begin].cell) ++end;
    visit(points[begin].cell, points.data() + begin, points.data() + end);
    begin = end;
  }
}

/// Where the face stands about, in the direction of drive, and how densely it was seen.
struct Middle {
  double ahead_m, points_a_m2;
};

/// The farthest place with a fifth of the profile's cells within a metre. Machines hide more of a face than may be seen
/// of it, but stand before it.
std::optional<Middle> middle_of_face(const Search& coarse, const ChainageIndex& index, double from_m, double to_m,
                                     double profile_m2, Progress& progress) {
  constexpr double least_part = 0.2, window_m = 1.0;
  const std::vector<FacePoint> points = coarse.points(index, from_m, to_m, coarse_part, progress);
  std::vector<double> farthest;
  for_each_cell(points,
                [&](std::uint32_t, const FacePoint* begin, const FacePoint*) { farthest.push_back(begin->ahead_m); });
  std::sort(farthest.begin(), farthest.end(), std::greater<>());
  const double cell_m2 = coarse.grid.step_m * coarse.grid.step_m;
  for (std::size_t first = 0; first < farthest.size(); ++first) {
    std::size_t last = first;
    while (last < farthest.size() && farthest[first] - farthest[last] <= window_m) ++last;
    const double seen_m2 = static_cast<double>(last - first) * cell_m2;
    if (seen_m2 < least_part * profile_m2) continue;
    const double ahead_m = farthest[first + (last - first) / 2];
    const auto near = std::count_if(points.begin(), points.end(), [&](const FacePoint& p) {
      return std::abs(p.ahead_m - ahead_m) <= 0.5 * window_m;
    });
    return Middle{ahead_m, static_cast<double>(near) * coarse_part / seen_m2};
  }
  return std::nullopt;
}

/// Marks, column by column from the floor up, what stands well before the face, and the slope above it.
void mark_hidden(FaceMap& face, double sign, double middle_ahead_m) {
  const auto ahead = [&](const FaceCell& cell) { return sign * cell.chainage_m; };
  const auto lean = static_cast<std::size_t>(std::ceil(0.3 / face.step_m));
  for (std::size_t c = 0; c < face.columns; ++c) {
    bool heap = true, slope = false;
    for (std::size_t r = 0; r < face.rows && (heap || slope); ++r) {
      FaceCell& cell = face.cells[r * face.columns + c];
      if (cell.kind != FaceKind::seen) continue;
      if (heap && ahead(cell) < middle_ahead_m - before_face_m) {
        slope = true;
        cell.kind = FaceKind::hidden;
        continue;
      }
      heap = false;
      if (!slope || r + lean >= face.rows) break;
      const FaceCell& above = face.cells[(r + lean) * face.columns + c];
      slope = above.kind == FaceKind::seen &&
              ahead(above) - ahead(cell) > muck_slope * static_cast<double>(lean) * face.step_m;
      if (slope) cell.kind = FaceKind::hidden;
    }
  }
}

}  // namespace

FaceMap find_face(const std::vector<PlacedTiles>& scans, const ChainageIndex& index, const DesignTunnel& design,
                  const FaceOptions& options, Progress& progress) {
  const Alignment& axis = design.alignment();
  double from_m = axis.to_m(), to_m = axis.from_m();
  for (const TileRef& ref : index.all()) {
    from_m = std::max(axis.from_m(), std::min(from_m, ref.from_m));
    to_m = std::min(axis.to_m(), std::max(to_m, ref.to_m));
  }
  if (to_m <= from_m) return {};
  const double sign = design.drive().up_chainage ? 1.0 : -1.0;
  const Profile& about = design.profile_at(sign > 0.0 ? to_m : from_m);
  const Search coarse{scans, design, options, grid_over(about, coarse_step_m), sign};
  const auto middle = middle_of_face(coarse, index, from_m, to_m, about.area_m2(), progress);
  if (!middle) return {};
  const double middle_m = std::clamp(sign * middle->ahead_m, from_m, to_m);
  const double begin_m = std::max(from_m, middle_m - options.relief_m);
  const double end_m = std::min(to_m, middle_m + options.relief_m);
  const Profile& profile = design.profile_at(middle_m);
  const double step_m = std::clamp(std::sqrt(points_a_cell / middle->points_a_m2), options.least_step_m, coarse_step_m);
  Search fine{scans, design, options, grid_over(profile, step_m), sign};
  FaceMap& face = fine.grid;
  face.cells.resize(face.columns * face.rows);
  for (std::size_t i = 0; i < face.cells.size(); ++i)
    if (profile.nearest(face.middle(i % face.columns, i / face.columns)).deviation_m < -options.inset_m)
      face.cells[i].kind = FaceKind::unseen;
  for_each_cell(fine.points(index, begin_m, end_m, 1, progress),
                [&](std::uint32_t i, const FacePoint* begin, const FacePoint* end) {
                  const auto surface = farthest_surface(begin, end, options.least_points);
                  if (surface && face.cells[i].kind == FaceKind::unseen)
                    face.cells[i] = {sign * *surface, FaceKind::seen};
                });
  mark_hidden(face, sign, middle->ahead_m);
  return summarise(face).share() >= options.least_share ? face : FaceMap{};
}

FaceSummary summarise(const FaceMap& face) {
  FaceSummary summary;
  const double cell_m2 = face.step_m * face.step_m;
  std::vector<double> seen;
  for (const FaceCell& cell : face.cells) {
    if (cell.kind == FaceKind::beside) continue;
    summary.design_m2 += cell_m2;
    if (cell.kind == FaceKind::hidden) summary.hidden_m2 += cell_m2;
    if (cell.kind == FaceKind::seen) seen.push_back(cell.chainage_m);
  }
  summary.seen_m2 = static_cast<double>(seen.size()) * cell_m2;
  if (seen.empty()) return summary;
  const auto [least, greatest] = std::minmax_element(seen.begin(), seen.end());
  summary.least_m = *least;
  summary.greatest_m = *greatest;
  for (const double s : seen) summary.mean_m += s / static_cast<double>(seen.size());
  for (const double s : seen) summary.spread_m += (s - summary.mean_m) * (s - summary.mean_m);
  summary.spread_m = std::sqrt(summary.spread_m / static_cast<double>(seen.size()));
  return summary;
}

std::vector<double> filled_face(const FaceMap& face) {
  std::vector<double> filled(face.cells.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::size_t> queue;
  for (std::size_t i = 0; i < face.cells.size(); ++i) {
    if (face.cells[i].kind != FaceKind::seen) continue;
    filled[i] = face.cells[i].chainage_m;
    queue.push_back(i);
  }
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const std::size_t row = queue[k] / face.columns, column = queue[k] % face.columns;
    const auto reach = [&](std::size_t other) {
      if (std::isfinite(filled[other])) return;
      filled[other] = filled[queue[k]];
      queue.push_back(other);
    };
    if (column > 0) reach(queue[k] - 1);
    if (column + 1 < face.columns) reach(queue[k] + 1);
    if (row > 0) reach(queue[k] - face.columns);
    if (row + 1 < face.rows) reach(queue[k] + face.columns);
  }
  return filled;
}

}  // namespace adit
