#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <tuple>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"
#include "core/profiling/object_cells.h"
#include "core/profiling/openings.h"
#include "core/profiling/outline.h"
#include "core/profiling/profiling.h"

namespace adit {
namespace {

constexpr double longest_slab_m = 4.0;
constexpr double bytes_a_point = 52.0;  // an entry, its copy, and the sort

struct Entry {
  std::uint32_t cell;
  float deviation_m;
  float place;      ///< within the thickness of the slice, 0 to 1
  float incidence;  ///< cosine between the ray and the normal of the design line
};

struct TileEntries {
  std::vector<Entry> entries;
  std::vector<std::uint32_t> beyond;  ///< cells of the points that were left out as outside
  std::uint64_t inside = 0;
  std::uint64_t outside = 0;
};

struct Mapper {
  const std::vector<PlacedTiles>& scans;
  const DesignTunnel& design;
  const ProfilingOptions& options;
  const DeviationMap& map;
  std::vector<ProfileStretch> stretches;    ///< one for each of the design's profiles
  std::vector<std::size_t> profile_of_row;  ///< that of the row's middle holds for all its points
  /// Where the scanners stand, offset and height; nothing where it is not known or not in the tunnel.
  std::vector<std::optional<Eigen::Vector2d>> scanners;

  /// Enough of a tile: a surface through its box touches about as many cells as the box's two longer sides say, and the
  /// scans beside it share what a cell needs.
  std::size_t enough_points(const TileRef& ref) const {
    Eigen::Vector3d sides = scans[ref.scan].points->box(ref.tile).sizes();
    std::sort(sides.data(), sides.data() + 3);
    const double cells = (sides[2] / map.step_s_m + 1.0) * (sides[1] / map.step_q_m + 1.0);
    const double each = std::max(options.most_points_a_cell / static_cast<double>(ref.scans_beside), 20.0);
    return static_cast<std::size_t>(std::min(cells * each, 1e9));
  }

  TileEntries entries_of(const TileRef& ref, const TunnelFrames& frames, std::size_t first_row,
                         std::size_t last_row) const {
    TileEntries result;
    const PlacedTiles& scan = scans[ref.scan];
    const double begin_m = map.from_m + static_cast<double>(first_row) * map.step_s_m;
    const double end_m = map.from_m + static_cast<double>(last_row) * map.step_s_m;
    const auto add = [&](const SlabPoint& point) {
      const double range = static_cast<double>(point.range_m);
      if (scan.scanner_at_origin && (range < options.least_range_m || range > options.most_range_m)) return;
      const TunnelPoint at = design.in_section(point.at);
      if (at.s_m < begin_m || at.s_m >= end_m) return;
      const auto row = std::min(static_cast<std::size_t>((at.s_m - map.from_m) / map.step_s_m), last_row - 1);
      const std::size_t profile = profile_of_row[row];
      const ProfileFoot foot = design.profiles()[profile].profile.nearest({at.x_m, at.z_m});
      if (foot.deviation_m < -options.reach_in_m) {
        ++result.inside;
        return;
      }
      const auto column = static_cast<std::size_t>(stretches[profile].q_of(foot) / map.step_q_m);
      const std::size_t cell = (row - first_row) * map.columns + std::min(column, map.columns - 1);
      if (foot.deviation_m > options.reach_out_m) {
        ++result.outside;
        result.beyond.push_back(static_cast<std::uint32_t>(cell));
      } else {
        const double place = (at.s_m - map.from_m) / map.step_s_m - static_cast<double>(row);
        result.entries.push_back({static_cast<std::uint32_t>(cell), static_cast<float>(foot.deviation_m),
                                  static_cast<float>(place), incidence(scanners[ref.scan], at, foot.direction, range)});
      }
    };
    visit_slab_of_tile(scans, ref, enough_points(ref), frames, add);
    return result;
  }

  static float incidence(const std::optional<Eigen::Vector2d>& scanner, const TunnelPoint& at,
                         const Eigen::Vector2d& normal, double range_m) {
    if (!scanner || range_m <= 0.0) return 1.0F;
    const double square_m = std::abs((Eigen::Vector2d(at.x_m, at.z_m) - *scanner).dot(normal));
    return static_cast<float>(std::min(1.0, square_m / range_m));
  }
};

std::vector<std::size_t> profiles_of_rows(const DeviationMap& map, const DesignTunnel& design) {
  std::vector<std::size_t> profiles;
  for (std::size_t r = 0, i = 0; r < map.rows; ++r) {
    while (i + 1 < design.profiles().size() && design.profiles()[i + 1].from_m <= map.row_chainage(r)) ++i;
    profiles.push_back(i);
  }
  return profiles;
}

std::vector<std::optional<Eigen::Vector2d>> scanners_in_tunnel(const std::vector<PlacedTiles>& scans,
                                                               const Alignment& axis) {
  std::vector<std::optional<Eigen::Vector2d>> places;
  for (const PlacedTiles& scan : scans) {
    const auto at = scan.scanner_at_origin ? axis.to_tunnel(scan.local_from_scan.translation()) : std::nullopt;
    places.push_back(at ? std::optional(Eigen::Vector2d(at->x_m, at->z_m)) : std::nullopt);
  }
  return places;
}

/// The part of a cell's points (sorted by deviation) that is rock. The outermost band that holds enough of them is rock
/// for certain: what lies behind it is stray. In front of it a step between two rounds is rock, too, but well inside
/// the design line only what lies close to that band: the rest is equipment.
std::vector<Entry> rock_points(const Entry* begin, const Entry* end, const ProfilingOptions& options) {
  constexpr float well_inside_m = -0.15F;
  const auto count = static_cast<std::size_t>(end - begin);
  const std::size_t need = std::max(static_cast<std::size_t>(options.least_points), count / 10);
  const auto band = static_cast<float>(options.surface_band_m);
  for (const Entry* top = end - 1; top >= begin; --top) {
    const float low = top->deviation_m - band;
    const Entry* first =
        std::lower_bound(begin, top + 1, low, [](const Entry& e, float d) { return e.deviation_m < d; });
    if (static_cast<std::size_t>(top + 1 - first) < need) continue;
    std::vector<Entry> rock;
    for (const Entry* e = begin; e <= top; ++e)
      if (e->deviation_m >= std::min(well_inside_m, low - band) || e >= first) rock.push_back(*e);
    return rock;
  }
  return {};
}

/// The deviation nearest to `wanted` among the points from `i` on (step 1) or back (step -1) that stand at one place
/// with it. The face of a step has points of every depth at one place; the surface that a gap hides goes on to the
/// nearest of them.
double continued(const std::vector<Entry>& rock, std::ptrdiff_t i, std::ptrdiff_t step, double wanted) {
  constexpr float one_place = 0.05F;
  double best = static_cast<double>(rock[static_cast<std::size_t>(i)].deviation_m);
  for (std::ptrdiff_t k = i; k >= 0 && k < static_cast<std::ptrdiff_t>(rock.size()); k += step) {
    const Entry& entry = rock[static_cast<std::size_t>(k)];
    if (std::abs(entry.place - rock[static_cast<std::size_t>(i)].place) > one_place) break;
    const double deviation = static_cast<double>(entry.deviation_m);
    if (std::abs(deviation - wanted) < std::abs(best - wanted)) best = deviation;
  }
  return best;
}

/// Mean over the thickness of the slice of rock sorted by place: every point stands for the stretch of chainage that is
/// nearest to it, so that the many points on a step's face weigh no more than the little chainage they cover.
double mean_over_slice(const std::vector<Entry>& rock) {
  constexpr float wide_gap = 0.05F;
  double sum = static_cast<double>(rock.front().place) * static_cast<double>(rock.front().deviation_m) +
               static_cast<double>(1.0F - rock.back().place) * static_cast<double>(rock.back().deviation_m);
  for (std::size_t i = 0; i + 1 < rock.size(); ++i) {
    const float gap = rock[i + 1].place - rock[i].place;
    double before = static_cast<double>(rock[i].deviation_m), behind = static_cast<double>(rock[i + 1].deviation_m);
    if (gap > wide_gap) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      behind = continued(rock, at + 1, 1, before);
      before = continued(rock, at, -1, behind);
    }
    sum += 0.5 * static_cast<double>(gap) * (before + behind);
  }
  return sum;
}

/// Points of many depths at one place of the thickness: the face of a step, seen where the rock beside it is not.
bool is_face_alone(const std::vector<Entry>& rock, double surface_band_m) {
  constexpr float thin = 0.3F;
  if (rock.back().place - rock.front().place > thin) return false;
  const auto [low, high] = std::minmax_element(
      rock.begin(), rock.end(), [](const Entry& a, const Entry& b) { return a.deviation_m < b.deviation_m; });
  return high->deviation_m - low->deviation_m > static_cast<float>(surface_band_m);
}

MapCell surface_cell(const Entry* begin, const Entry* end, const ProfilingOptions& options) {
  MapCell cell;
  std::vector<Entry> rock = rock_points(begin, end, options);
  if (rock.empty()) return cell;
  std::sort(rock.begin(), rock.end(), [](const Entry& a, const Entry& b) {
    return a.place != b.place ? a.place < b.place : a.deviation_m < b.deviation_m;
  });
  if (is_face_alone(rock, options.surface_band_m)) return cell;
  std::vector<double> values;
  values.reserve(rock.size());
  for (const Entry& entry : rock) values.push_back(static_cast<double>(entry.deviation_m));
  cell.deviation_m = static_cast<float>(mean_over_slice(rock));
  cell.spread_m = static_cast<float>(robust_sigma(values));
  cell.count = static_cast<std::uint32_t>(values.size());
  double incidences = 0.0;
  for (const Entry& entry : rock) incidences += static_cast<double>(entry.incidence);
  cell.incidence = static_cast<float>(incidences / static_cast<double>(rock.size()));
  cell.kind = CellKind::measured;
  return cell;
}

/// The number of cells whose points were too few.
std::uint64_t fill_slab(DeviationMap& map, std::vector<Entry>& entries, std::size_t first_row,
                        const ProfilingOptions& options) {
  tbb::parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.cell, a.deviation_m, a.place) < std::tie(b.cell, b.deviation_m, b.place);
  });
  std::uint64_t sparse = 0;
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].cell == entries[begin].cell) ++end;
    MapCell& cell = map.cells[first_row * map.columns + entries[begin].cell];
    cell = surface_cell(entries.data() + begin, entries.data() + end, options);
    if (cell.kind == CellKind::unseen) ++sparse;
    begin = end;
  }
  return sparse;
}

/// Marks cells without rock that a point beyond reach was seen through.
void mark_openings(DeviationMap& map, const TileEntries& part, std::size_t first_row) {
  for (const std::uint32_t i : part.beyond) {
    MapCell& cell = map.cells[first_row * map.columns + i];
    if (cell.kind == CellKind::unseen) cell.kind = CellKind::opening;
  }
}

DeviationMap empty_map(const std::vector<ProfileStretch>& stretches, double from_m, double to_m,
                       const ProfilingOptions& options) {
  DeviationMap map;
  map.from_m = from_m;
  map.to_m = to_m;
  map.rows = static_cast<std::size_t>(std::max(1.0, std::round((to_m - from_m) / options.slice_m)));
  map.step_s_m = (to_m - from_m) / static_cast<double>(map.rows);
  map.step_q_m = options.cell_m;
  for (const auto& stretch : stretches) map.columns = std::max(map.columns, stretch.columns(map.step_q_m));
  if (map.rows * map.columns > 200'000'000)
    throw Error("the deviation map would have over 200 million cells", "profiling.slice_m",
                "use larger slices or cells");
  map.cells.resize(map.rows * map.columns);
  return map;
}

/// Marks what the sections will interpolate, so that the map shows it.
void fill_map_gaps(DeviationMap& map, const Mapper& mapper, double gap_m) {
  parallel_for_each_index(
      map.rows,
      [&](std::size_t r) {
        const auto begin = map.cells.begin() + static_cast<std::ptrdiff_t>(r * map.columns);
        const std::vector<MapCell> row(begin, begin + static_cast<std::ptrdiff_t>(map.columns));
        const Outline outline = outline_of(row, mapper.stretches[mapper.profile_of_row[r]], map.step_q_m, gap_m);
        std::copy(outline.cells.begin(), outline.cells.end(), begin);
      },
      4);
}

/// About how many points each row will get.
std::vector<double> points_of_rows(const Mapper& mapper, const ChainageIndex& index) {
  const DeviationMap& map = mapper.map;
  std::vector<double> points(map.rows, 0.0);
  for (const TileRef& ref : index.between(map.from_m, map.to_m)) {
    const std::size_t count = std::min(mapper.enough_points(ref), mapper.scans[ref.scan].points->point_count(ref.tile));
    const auto row_of = [&](double s_m) {
      return static_cast<std::size_t>(
          std::clamp((s_m - map.from_m) / map.step_s_m, 0.0, static_cast<double>(map.rows - 1)));
    };
    const std::size_t first = row_of(ref.from_m), last = row_of(ref.to_m);
    // Its reach is wider than its points: half of it on either side may be empty.
    const double each = 2.0 * static_cast<double>(count) / ((ref.to_m - ref.from_m) / map.step_s_m + 1.0);
    for (std::size_t row = first; row <= last; ++row) points[row] += each;
  }
  return points;
}

/// First row of each slab, and one past the last: slabs whose points fit the memory, one row at the least.
std::vector<std::size_t> slabs(const Mapper& mapper, const ChainageIndex& index, std::uint64_t memory_bytes) {
  const std::vector<double> points = points_of_rows(mapper, index);
  const double most_points = static_cast<double>(memory_bytes) / bytes_a_point;
  std::vector<std::size_t> begins{0};
  double sum = 0.0;
  for (std::size_t row = 0; row < points.size(); ++row) {
    const bool too_long = static_cast<double>(row + 1 - begins.back()) * mapper.map.step_s_m > longest_slab_m + 1e-9;
    if (row > begins.back() && (too_long || sum + points[row] > most_points)) {
      begins.push_back(row);
      sum = 0.0;
    }
    sum += points[row];
  }
  begins.push_back(points.size());
  return begins;
}

/// Fills the rows [first, last) of the map from the tiles that may reach them.
void map_slab(MapResult& result, const Mapper& mapper, const ChainageIndex& index, std::size_t first, std::size_t last,
              const Progress& progress) {
  const double begin_m = result.map.from_m + static_cast<double>(first) * result.map.step_s_m;
  const double end_m = result.map.from_m + static_cast<double>(last) * result.map.step_s_m;
  const double lean_m = mapper.design.lean_m(begin_m, end_m);
  const double half_step_m = 0.5 * result.map.step_s_m;
  const std::vector<TileRef> here = index.between(begin_m - half_step_m - lean_m, end_m + half_step_m + lean_m);
  const TunnelFrames frames(mapper.design.alignment(), begin_m - lean_m, end_m + lean_m);
  std::vector<TileEntries> parts(here.size());
  parallel_for_each_index(
      here.size(),
      [&](std::size_t k) {
        progress.check();
        parts[k] = mapper.entries_of(here[k], frames, first, last);
      },
      1);
  std::vector<Entry> entries;
  for (TileEntries& part : parts) {
    entries.insert(entries.end(), part.entries.begin(), part.entries.end());
    std::vector<Entry>().swap(part.entries);
    result.points_inside += part.inside;
    result.points_outside += part.outside;
  }
  result.points_used += entries.size();
  result.sparse_cells += fill_slab(result.map, entries, first, mapper.options);
  for (const TileEntries& part : parts) mark_openings(result.map, part, first);
}

Finding objects_finding(const ObjectCells& objects, double cell_area_m2) {
  const double area_m2 = static_cast<double>(objects.cells) * cell_area_m2;
  char words[200];
  std::snprintf(words, sizeof words,
                "%.1f m2 between chainage %.1f and %.1f stand out from the rock around and were taken as equipment, "
                "not as underbreak",
                area_m2, objects.from_m, objects.to_m);
  return {area_m2 < 1.0 ? Severity::note : Severity::warning, "deviation map", words, "look at the sections there"};
}

Finding opening_finding(const Opening& opening, double reach_out_m) {
  char words[260];
  std::snprintf(words, sizeof words,
                "an opening of %.1f m2 between chainage %.2f and %.2f, at %.0f degrees clockwise from the crown, goes "
                "deeper than %.1f m: areas and volumes end at the line there",
                opening.area_m2, opening.from_m, opening.to_m, opening.clock_deg, reach_out_m);
  return {Severity::warning, "deviation map", words, "measure a cross-cut as a job of its own"};
}

}  // namespace

MapResult map_deviations(const std::vector<PlacedTiles>& scans, const DesignTunnel& design, double from_m, double to_m,
                         const ProfilingOptions& options, Progress& progress, std::uint64_t memory_bytes) {
  const ChainageIndex index(scans, design.alignment());
  return map_deviations(scans, index, design, from_m, to_m, options, progress, memory_bytes);
}

MapResult map_deviations(const std::vector<PlacedTiles>& scans, const ChainageIndex& index, const DesignTunnel& design,
                         double from_m, double to_m, const ProfilingOptions& options, Progress& progress,
                         std::uint64_t memory_bytes) {
  std::vector<ProfileStretch> stretches;
  for (const auto& stepped : design.profiles()) stretches.emplace_back(stepped.profile);
  MapResult result;
  result.map = empty_map(stretches, from_m, to_m, options);
  const Mapper mapper{scans,
                      design,
                      options,
                      result.map,
                      stretches,
                      profiles_of_rows(result.map, design),
                      scanners_in_tunnel(scans, design.alignment())};
  const std::vector<std::size_t> begins = slabs(mapper, index, memory_bytes);
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    progress.step(begins[i], result.map.rows);
    map_slab(result, mapper, index, begins[i], begins[i + 1], progress);
  }
  if (result.points_used == 0)
    throw Error("no scan point lies near the design between chainage " + std::to_string(from_m) + " and " +
                    std::to_string(to_m),
                "", "check the alignment, the profile and the poses: do they use the same coordinates?");
  const ObjectCells objects = remove_object_cells(result.map);
  for (const Opening& opening : find_openings(result.map, mapper.stretches, mapper.profile_of_row))
    result.findings.push_back(opening_finding(opening, options.reach_out_m));
  fill_map_gaps(result.map, mapper, options.gap_m);
  constexpr double least_named_m2 = 0.05;
  if (static_cast<double>(objects.cells) * result.map.step_s_m * result.map.step_q_m >= least_named_m2)
    result.findings.push_back(objects_finding(objects, result.map.step_s_m * result.map.step_q_m));
  return result;
}

Section cut_section(const std::vector<PlacedTiles>& scans, const ChainageIndex& index, const DesignTunnel& design,
                    double chainage_m, const ProfilingOptions& options, Progress& progress) {
  const MapResult mapped = map_deviations(scans, index, design, chainage_m - options.slice_m,
                                          chainage_m + options.slice_m, options, progress);
  return cut_section(mapped.map, design, chainage_m, options);
}

}  // namespace adit
