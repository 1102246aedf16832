#include "core/profiling/map_change.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/geometry/statistics.h"
#include "core/profiling/uncertainty.h"

namespace adit {
namespace {

constexpr double block_m = 1.0;
constexpr double least_block_share = 0.5;

/// How well both epochs stand to one another.
SurfaceSigma sigma_between(const RegistrationResult& before, const RegistrationResult& after,
                           const ProfilingOptions& options) {
  const SurfaceSigma a = surface_sigma(before, options), b = surface_sigma(after, options);
  return {std::hypot(a.across_m, b.across_m), std::hypot(a.up_m, b.up_m), std::hypot(a.distance_m, b.distance_m)};
}

/// A cell measured in both epochs.
struct Pair {
  double area_m2, thickness_m, noise2_m2;
  Eigen::Vector2d normal;
  double incidence;  ///< mean cosine
};

struct BlockSums {
  double line_m2 = 0.0, measured_line_m2 = 0.0, area_m2 = 0.0, volume_m3 = 0.0, noise_m6 = 0.0, across_m3 = 0.0,
         up_m3 = 0.0, distance_m3 = 0.0;
  void add(const Pair& pair, const SurfaceSigma& sigma) {
    area_m2 += pair.area_m2;
    volume_m3 += pair.area_m2 * pair.thickness_m;
    noise_m6 += pair.area_m2 * pair.area_m2 * pair.noise2_m2;
    across_m3 += pair.area_m2 * pair.normal.x() * sigma.across_m;
    up_m3 += pair.area_m2 * pair.normal.y() * sigma.up_m;
    distance_m3 += pair.area_m2 * pair.incidence * sigma.distance_m;
  }
  BlockSums& operator+=(const BlockSums& other) {
    line_m2 += other.line_m2;
    measured_line_m2 += other.measured_line_m2;
    area_m2 += other.area_m2;
    volume_m3 += other.volume_m3;
    noise_m6 += other.noise_m6;
    across_m3 += other.across_m3;
    up_m3 += other.up_m3;
    distance_m3 += other.distance_m3;
    return *this;
  }
  double sigma_m3() const {
    return std::sqrt(noise_m6 + across_m3 * across_m3 + up_m3 * up_m3 + distance_m3 * distance_m3);
  }
};

void expect_same_grid(const DeviationMap& a, const DeviationMap& b) {
  if (a.rows == b.rows && a.columns == b.columns && a.from_m == b.from_m && a.step_s_m == b.step_s_m &&
      a.step_q_m == b.step_q_m)
    return;
  throw Error("two maps of different grids cannot be compared");
}

/// Which sectors get the layer.
struct LayerSectors {
  const std::vector<Sector>& sectors;
  std::vector<char> has_layer;

  LayerSectors(const std::vector<Sector>& all, const std::vector<std::string>& names)
      : sectors(all), has_layer(all.size(), names.empty() ? 1 : 0) {
    for (const std::string& name : names) {
      const auto found =
          std::find_if(all.begin(), all.end(), [&](const Sector& sector) { return sector.name == name; });
      if (found == all.end()) throw Error("the layer names a sector that there is none of: " + name);
      has_layer[static_cast<std::size_t>(found - all.begin())] = 1;
    }
  }
  /// Of a cell: it may lie in two sectors.
  double share(const ProfileStretch& stretch, double q0, double q1) const {
    constexpr int pieces = 5;
    int inside = 0;
    for (int i = 0; i < pieces; ++i)
      inside += has_layer[sector_of(sectors, stretch.at(q0 + (q1 - q0) * (i + 0.5) / pieces).normal)] != 0 ? 1 : 0;
    return static_cast<double>(inside) / pieces;
  }
};

/// Sums over the map, in blocks of about a square metre.
struct Comparison {
  const DeviationMap& before;
  const DeviationMap& after;
  const DesignTunnel& design;
  LayerSectors sectors;
  SurfaceSigma sigma;
  MapChange result;
  BlockSums whole;
  std::vector<double> levels;

  void add_cell(std::size_t r, std::size_t c, const ProfileStretch& stretch, const SliceShape& shape,
                BlockSums& block) {
    const double q0 = static_cast<double>(c) * after.step_q_m;
    const double q1 = std::min(q0 + after.step_q_m, stretch.length_m());
    const double line_m2 = stretch.line_length_m(q0, q1) * after.step_s_m;
    const ProfilePoint at = stretch.at(0.5 * (q0 + q1));
    const double share = sectors.share(stretch, q0, q1);
    block.line_m2 += share * line_m2;
    const MapCell &old = before.cell(r, c), &present = after.cell(r, c);
    if (old.kind != CellKind::measured || present.kind != CellKind::measured) return;
    const double half_way_m = 0.5 * static_cast<double>(old.deviation_m + present.deviation_m);
    const Eigen::Vector2d place = at.position + half_way_m * at.normal;
    const Pair pair{line_m2 * std::max(0.0, 1.0 + at.curvature_per_m * half_way_m) * shape.at(place),
                    static_cast<double>(old.deviation_m - present.deviation_m),
                    noise_squared_m2(old) + noise_squared_m2(present), at.normal,
                    0.5 * static_cast<double>(old.incidence + present.incidence)};
    if (share > 0.0) {
      Pair part = pair;
      part.area_m2 *= share;
      block.measured_line_m2 += share * line_m2;
      block.add(part, sigma);
    }
    const double level_m = 1.96 * std::hypot(std::sqrt(pair.noise2_m2), sigma.along_normal(at.normal, pair.incidence));
    levels.push_back(level_m);
    result.thickness.cell(r, c) = {static_cast<float>(pair.thickness_m), static_cast<float>(level_m), present.count,
                                   present.incidence, CellKind::measured};
    add_change(pair, level_m);
  }

  void add_change(const Pair& pair, double level_m) {
    ChangeResult& change = result.change;
    change.compared_m2 += pair.area_m2;
    if (pair.thickness_m > level_m) {
      change.inwards_m2 += pair.area_m2;
      change.inwards_m3 += pair.area_m2 * pair.thickness_m;
    } else if (pair.thickness_m < -level_m) {
      change.outwards_m2 += pair.area_m2;
      change.outwards_m3 -= pair.area_m2 * pair.thickness_m;
    }
  }

  /// The rows [first, last), one block long.
  void add_rows(std::size_t first, std::size_t last) {
    const auto columns = static_cast<std::size_t>(std::max(1.0, std::round(block_m / after.step_q_m)));
    std::vector<BlockSums> blocks((after.columns + columns - 1) / columns);
    for (std::size_t r = first; r < last; ++r) {
      const double chainage_m = after.row_chainage(r);
      const ProfileStretch stretch(design.profile_at(chainage_m));
      const SliceShape shape = design.slice_shape(chainage_m);
      for (std::size_t c = 0; c < std::min(after.columns, stretch.columns(after.step_q_m)); ++c)
        add_cell(r, c, stretch, shape, blocks[c / columns]);
    }
    const double middle_m = after.from_m + 0.5 * static_cast<double>(first + last) * after.step_s_m;
    const ProfileStretch stretch(design.profile_at(middle_m));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const BlockSums& block = blocks[b];
      whole += block;
      if (block.area_m2 < least_block_share * block.line_m2 || block.area_m2 <= 0.0) continue;
      const double middle_q = (static_cast<double>(b) + 0.5) * static_cast<double>(columns) * after.step_q_m;
      result.layer.blocks.push_back({middle_m, stretch.at(std::min(middle_q, stretch.length_m())).p_m, block.area_m2,
                                     block.volume_m3 / block.area_m2, block.sigma_m3() / block.area_m2});
    }
  }
};

/// What was not measured, with the mean of what was.
void add_missing(const BlockSums& whole, LayerResult& layer) {
  layer.missing_m2 = whole.line_m2 - whole.measured_line_m2;
  layer.whole_volume_m3 = layer.volume_m3 + layer.mean_m * layer.missing_m2;
  double squares_m2 = 0.0;
  for (const LayerBlock& block : layer.blocks) squares_m2 += std::pow(block.mean_m - layer.mean_m, 2);
  const double spread_m = layer.blocks.empty() ? 0.0 : std::sqrt(squares_m2 / static_cast<double>(layer.blocks.size()));
  // The systematic part goes on where nothing was measured.
  const double grown = layer.measured_m2 > 0.0 ? (layer.measured_m2 + layer.missing_m2) / layer.measured_m2 : 1.0;
  layer.sigma_whole_m3 = std::hypot(layer.sigma_volume_m3 * grown, spread_m * layer.missing_m2);
}

void add_classes(LayerResult& layer) {
  if (layer.blocks.empty()) return;
  const auto share_below = [&](double thickness_m) {
    const auto below = std::count_if(layer.blocks.begin(), layer.blocks.end(),
                                     [&](const LayerBlock& block) { return block.mean_m < thickness_m; });
    return static_cast<double>(below) / static_cast<double>(layer.blocks.size());
  };
  layer.below_minimum = share_below(layer.design.minimum_m);
  layer.below_nominal = share_below(layer.design.nominal_m) - layer.below_minimum;
  layer.from_nominal = 1.0 - layer.below_minimum - layer.below_nominal;
}

}  // namespace

MapChange compare_maps(const DeviationMap& before, const DeviationMap& after, const DesignTunnel& design,
                       const LayerDesign& layer, const std::vector<Sector>& sectors,
                       const RegistrationResult& registration_before, const RegistrationResult& registration_after,
                       const ProfilingOptions& options) {
  expect_same_grid(before, after);
  Comparison comparison{before,
                        after,
                        design,
                        LayerSectors(sectors, layer.sectors),
                        sigma_between(registration_before, registration_after, options),
                        {},
                        {},
                        {}};
  MapChange& result = comparison.result;
  result.thickness = after;
  std::fill(result.thickness.cells.begin(), result.thickness.cells.end(), MapCell{});
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(block_m / after.step_s_m)));
  for (std::size_t first = 0; first < after.rows; first += rows)
    comparison.add_rows(first, std::min(after.rows, first + rows));
  const BlockSums& whole = comparison.whole;
  result.layer.design = layer;
  result.layer.surface_m2 = whole.line_m2;
  result.layer.measured_m2 = whole.area_m2;
  result.layer.volume_m3 = whole.volume_m3;
  result.layer.sigma_volume_m3 = whole.sigma_m3();
  result.layer.mean_m = whole.area_m2 > 0.0 ? whole.volume_m3 / whole.area_m2 : 0.0;
  add_missing(whole, result.layer);
  result.change.level_m = comparison.levels.empty() ? 0.0 : median(comparison.levels);
  add_classes(result.layer);
  return std::move(comparison.result);
}

}  // namespace adit
