#include "core/profiling/face_volume.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/profiling/outline.h"
#include "core/profiling/overbreak.h"
#include "core/profiling/uncertainty.h"

namespace adit {
namespace {

constexpr double raster_m = 0.05;
constexpr double correlated_m2 = 4.0;  // of a face
constexpr double least_known = 0.4;    // of an outline

/// A face that can be asked anywhere near its grid.
struct FilledFace {
  const FaceMap& map;
  std::vector<double> chainages = filled_face(map);

  std::size_t cell(double x_m, double z_m) const {
    const auto index = [&](double place, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(std::floor(place / map.step_m), 0.0, static_cast<double>(count - 1)));
    };
    return index(z_m - map.z_from_m, map.rows) * map.columns + index(x_m - map.x_from_m, map.columns);
  }
  double at(double x_m, double z_m) const { return chainages[cell(x_m, z_m)]; }
  FaceKind kind(double x_m, double z_m) const { return map.cells[cell(x_m, z_m)].kind; }
};

/// visit(x, z) for every raster point inside a ring.
template <typename Visit>
void for_each_inside(const Polygon& ring, const Visit& visit) {
  double low = 1e300, high = -1e300;
  for (const Eigen::Vector2d& p : ring) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  std::vector<double> crossings;
  for (double z = (std::floor(low / raster_m) + 0.5) * raster_m; z < high; z += raster_m) {
    crossings.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() <= z) == (b.y() <= z)) continue;
      crossings.push_back(a.x() + (z - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      for (double x = (std::floor(crossings[k] / raster_m) + 0.5) * raster_m; x < crossings[k + 1]; x += raster_m)
        if (x >= crossings[k]) visit(x, z);
  }
}

struct Slice {
  double from_m, to_m;
  SliceShape shape;
};

/// Volume of a slice inside a ring and between the faces. The raster's area is scaled to the ring's own.
double between_in(const Polygon& ring, const Slice& slice, const FilledFace& first, const FilledFace& second) {
  double sum = 0.0;
  std::size_t points = 0;
  for_each_inside(ring, [&](double x, double z) {
    ++points;
    const double a = first.at(x, z), b = second.at(x, z);
    const double length = std::min(slice.to_m, std::max(a, b)) - std::max(slice.from_m, std::min(a, b));
    if (length > 0.0) sum += length * slice.shape.at({x, z});
  });
  return points == 0 ? 0.0 : sum / static_cast<double>(points) * std::abs(area_moment(ring).area_m2);
}

struct Rows {
  const DeviationMap& map;
  const DesignTunnel& design;
  double gap_m;

  Outline outline(std::size_t r) const {
    const auto begin = map.cells.begin() + static_cast<std::ptrdiff_t>(r * map.columns);
    return outline_of({begin, begin + static_cast<std::ptrdiff_t>(map.columns)},
                      ProfileStretch(design.profile_at(map.row_chainage(r))), map.step_q_m, gap_m);
  }
};

/// For each row its own outline, or that of the nearest row that is known well enough.
struct Contours {
  std::vector<Polygon> rings;
  std::vector<char> known;
  std::vector<double> known_share;  ///< of each row's own outline
  /// First of so many rows that are known best.
  std::size_t best_known(std::size_t count) const {
    std::size_t best = 0;
    double sum = 0.0, most = -1.0;
    for (std::size_t i = 0; i < known_share.size(); ++i) {
      sum += known_share[i];
      if (i >= count) sum -= known_share[i - count];
      if (i + 1 < count || sum <= most + 1e-9) continue;
      most = sum;
      best = i + 1 - count;
    }
    return best;
  }
  bool any() const { return std::find(known.begin(), known.end(), 1) != known.end(); }
  /// By how much the areas of known outlines differ (one sigma), and no less than a third of their mean overbreak: a
  /// look-out's saw-tooth may not show in few of them.
  double area_spread_m2(double design_m2) const {
    constexpr double well_known = 0.7;  // what is unseen lies on the line, and would spread areas by itself
    const double best = *std::max_element(known_share.begin(), known_share.end());
    double n = 0.0, sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (known_share[i] < std::min(well_known, best)) continue;
      const double over_m2 = std::abs(area_moment(rings[i]).area_m2) - design_m2;
      n += 1.0;
      sum += over_m2;
      squares += over_m2 * over_m2;
    }
    if (n == 0.0) return 0.0;
    const double mean = sum / n;
    return std::max(std::sqrt(std::max(0.0, squares / n - mean * mean)), std::abs(mean) / 3.0);
  }
};

Contours outlines(const Rows& rows, std::size_t first, std::size_t last) {
  std::vector<Polygon> rings(last - first);
  std::vector<char> known(last - first, 0);
  std::vector<double> share(last - first, 0.0);
  parallel_for_each_index(
      rings.size(),
      [&](std::size_t i) {
        const Outline outline = rows.outline(first + i);
        const double line_m = outline.measured_m + outline.interpolated_m + outline.unseen_m;
        share[i] = (outline.measured_m + outline.interpolated_m) / line_m;
        known[i] = share[i] >= least_known ? 1 : 0;
        rings[i] = polygon_of(outline.points, 0.0);
      },
      4);
  std::vector<Polygon> chosen = rings;
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (std::size_t away = 0; away < rings.size() && known[i] == 0; ++away) {
      const bool below = i >= away && known[i - away] != 0;
      const bool above = i + away < rings.size() && known[i + away] != 0;
      if (!below && !above) continue;
      chosen[i] = rings[below ? i - away : i + away];
      break;
    }
  return {std::move(chosen), std::move(known), std::move(share)};
}

struct Sums {
  double excavated_m3 = 0.0, design_m3 = 0.0;
  Sums& operator+=(const Sums& other) {
    excavated_m3 += other.excavated_m3;
    design_m3 += other.design_m3;
    return *this;
  }
};

}  // namespace

FaceVolume volume_between(const FaceMap& before, const FaceMap& after, const DeviationMap& map,
                          const DesignTunnel& design, const DesignLine& line, double before_along_sigma_m,
                          double after_along_sigma_m, const RegistrationResult& registration,
                          const ProfilingOptions& options, Progress& progress) {
  FaceVolume volume;
  const FaceSummary first = summarise(before), second = summarise(after);
  volume.from_m = std::min(first.mean_m, second.mean_m);
  volume.to_m = std::max(first.mean_m, second.mean_m);
  volume.advance_m = (design.drive().up_chainage ? 1.0 : -1.0) * (second.mean_m - first.mean_m);
  const double least_m = std::min(first.least_m, second.least_m);
  const double greatest_m = std::max(first.greatest_m, second.greatest_m);
  volume.whole = least_m >= map.from_m && greatest_m <= map.to_m;
  if (!volume.whole) return volume;
  const auto row_of = [&](double s_m) {
    return static_cast<std::size_t>(
        std::clamp((s_m - map.from_m) / map.step_s_m, 0.0, static_cast<double>(map.rows - 1)));
  };
  const Rows rows{map, design, options.gap_m};
  const Contours contours = outlines(rows, 0, map.rows);
  volume.whole = contours.any();
  if (!volume.whole) return volume;
  const std::vector<Polygon>& rings = contours.rings;
  const FilledFace from{before}, to{after};
  const Sums sums = parallel_ordered_sum(rings.size(), 2, Sums{}, [&](std::size_t b, std::size_t e) {
    Sums part;
    for (std::size_t i = b; i < e; ++i) {
      progress.check();
      const double middle_m = map.row_chainage(i);
      const Slice slice{middle_m - 0.5 * map.step_s_m, middle_m + 0.5 * map.step_s_m, design.slice_shape(middle_m)};
      if (slice.to_m < least_m || slice.from_m > greatest_m) continue;
      const LinePolygon wanted = line_polygon(design.profile_at(middle_m), design.line_at(line, middle_m));
      part += Sums{between_in(rings[i], slice, from, to), between_in(wanted.ring, slice, from, to)};
    }
    return part;
  });
  volume.excavated_m3 = sums.excavated_m3;
  volume.design_m3 = sums.design_m3;
  double face_m2 = 0.0, hidden_m2 = 0.0;
  for_each_inside(rings[row_of(0.5 * (volume.from_m + volume.to_m))], [&](double x, double z) {
    face_m2 += raster_m * raster_m;
    for (const FilledFace* face : {&from, &to}) {
      const FaceKind kind = face->kind(x, z);
      if (kind != FaceKind::seen) volume.guessed_m2 += raster_m * raster_m;
      if (kind == FaceKind::hidden) hidden_m2 += raster_m * raster_m;
    }
  });
  // What was not seen may lie off by the face's own relief: behind muck all of it together, elsewhere piece by piece.
  const double relief_m = std::max(first.spread_m, second.spread_m);
  const double guessed_variance_m6 =
      std::pow(hidden_m2 * relief_m, 2) + (volume.guessed_m2 - hidden_m2) * correlated_m2 * relief_m * relief_m;
  const double along_m =
      std::hypot(before_along_sigma_m, after_along_sigma_m, std::sqrt(2.0) * options.range_bias_sigma_m);
  const double guessed_m = face_m2 > 0.0 ? std::sqrt(guessed_variance_m6) / face_m2 : 0.0;
  volume.sigma_advance_m = std::hypot(along_m, guessed_m);
  const std::size_t from_row = row_of(volume.from_m), count = row_of(volume.to_m) - from_row + 1;
  const auto known = std::count(contours.known.begin() + static_cast<std::ptrdiff_t>(from_row),
                                contours.known.begin() + static_cast<std::ptrdiff_t>(from_row + count), 1);
  volume.contour_share = static_cast<double>(known) / static_cast<double>(count);
  // As of the best known rows, as many as lie between the faces, and what was taken from others.
  const double best_from_m = map.row_chainage(contours.best_known(count)) - 0.5 * map.step_s_m;
  const double length_m = static_cast<double>(count) * map.step_s_m;
  const double seen_m3 = volume_sigma_m3(map, design, line, best_from_m, best_from_m + length_m, VolumePart::excavated,
                                         registration, options);
  const double design_m2 = volume.design_m3 / std::max(1e-6, volume.to_m - volume.from_m);
  const double taken_m3 = contours.area_spread_m2(design_m2) * (1.0 - volume.contour_share) * length_m;
  const double contour_m3 = std::hypot(seen_m3, taken_m3);
  volume.sigma_m3 = std::sqrt(std::pow(face_m2 * along_m, 2) + guessed_variance_m6 + contour_m3 * contour_m3);
  return volume;
}

RockLeft rock_left(const FaceMap& after, double before_mean_m, double drilled_m, bool up_chainage) {
  constexpr double much_m = 0.3;
  const double sign = up_chainage ? 1.0 : -1.0;
  RockLeft left;
  std::size_t seen = 0, much = 0;
  for (const FaceCell& cell : after.cells) {
    if (cell.kind != FaceKind::seen) continue;
    const double rock_m = std::max(0.0, drilled_m - sign * (cell.chainage_m - before_mean_m));
    ++seen;
    left.mean_m += rock_m;
    left.most_m = std::max(left.most_m, rock_m);
    much += rock_m > much_m ? 1 : 0;
  }
  if (seen == 0) return left;
  left.mean_m /= static_cast<double>(seen);
  left.over_03_share = static_cast<double>(much) / static_cast<double>(seen);
  return left;
}

}  // namespace adit
