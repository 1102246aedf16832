#include "core/profiling/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "core/profiling/outline.h"

namespace adit {
namespace {

constexpr double correlated_area_m2 = 0.5;

/// Of the cells at one place along the profile, all rows together.
struct Column {
  double unseen_m2 = 0.0;
  double measured_m2 = 0.0;
  double deviation_sum = 0.0;  ///< of measured area times counted distance
};

struct Sums {
  double biased_m2 = 0.0;  ///< sum of a times the cosine of incidence
  double across_m2 = 0.0;  ///< sum of a n_x
  double up_m2 = 0.0;      ///< sum of a n_z
  double noise_m6 = 0.0;
  double interpolated_m2 = 0.0;
  double deviation_sum = 0.0;
  double deviation_square = 0.0;
  double measured_m2 = 0.0;
  std::vector<Column> columns;
};

bool belongs(VolumePart part, double over_m) {
  return part == VolumePart::excavated || (part == VolumePart::over ? over_m > 0.0 : over_m < 0.0);
}

void add_cell(Sums& sums, Column& column, const MapCell& cell, const ProfilePoint& at, double area_m2, double offset_m,
              VolumePart part) {
  if (cell.kind == CellKind::opening) return;  // ends at the line by definition
  if (cell.kind == CellKind::unseen) {
    column.unseen_m2 += area_m2;
    return;
  }
  const double over = static_cast<double>(cell.deviation_m) - offset_m;
  if (cell.kind == CellKind::measured) {
    sums.measured_m2 += area_m2;
    column.measured_m2 += area_m2;
    const double counted = belongs(part, over) ? (part == VolumePart::under ? -over : over) : 0.0;
    sums.deviation_sum += area_m2 * counted;
    column.deviation_sum += area_m2 * counted;
    sums.deviation_square += area_m2 * counted * counted;
  }
  if (!belongs(part, over)) return;
  sums.biased_m2 += area_m2 * static_cast<double>(cell.incidence);
  sums.across_m2 += area_m2 * at.normal.x();
  sums.up_m2 += area_m2 * at.normal.y();
  if (cell.kind == CellKind::interpolated)
    sums.interpolated_m2 += area_m2;
  else
    sums.noise_m6 += std::pow(area_m2 * static_cast<double>(cell.spread_m), 2) / std::max(1U, cell.count);
}

/// Of the unseen pieces, which count as lying on the line. What is usual about them at the same place along the profile
/// they are all taken to be off by: floors are unseen more often than walls, and lie otherwise. all_mean_m: where too
/// little was measured there.
double unseen_variance(const std::vector<Column>& columns, double step_q_m, double all_mean_m, double rock_variance) {
  constexpr double about_m = 1.0, least_measured_m2 = 2.0 * correlated_area_m2;
  const auto reach = static_cast<std::size_t>(about_m / step_q_m);
  double off_m3 = 0.0, unseen_m2 = 0.0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].unseen_m2 <= 0.0) continue;
    double measured_m2 = 0.0, deviation_sum = 0.0;
    for (std::size_t k = c - std::min(c, reach); k < std::min(columns.size(), c + reach + 1); ++k) {
      measured_m2 += columns[k].measured_m2;
      deviation_sum += columns[k].deviation_sum;
    }
    const double mean_m = measured_m2 < least_measured_m2 ? all_mean_m : deviation_sum / measured_m2;
    off_m3 += columns[c].unseen_m2 * std::abs(mean_m);
    unseen_m2 += columns[c].unseen_m2;
  }
  const double pieces_m2 = std::max(unseen_m2, correlated_area_m2);
  return off_m3 * off_m3 + unseen_m2 * unseen_m2 * rock_variance * correlated_area_m2 / pieces_m2;
}

/// Area by which the volume grows when the window moves along: difference of the ends' counted areas.
double end_difference_m2(const std::vector<double>& row_amount_m2) {
  if (row_amount_m2.empty()) return 0.0;
  return row_amount_m2.back() - row_amount_m2.front();
}

}  // namespace

PoseSigma common_sigma(const RegistrationResult& registration) {
  PoseSigma worst;
  for (const PlacedScan& scan : registration.scans) {
    if (!scan.placed) continue;
    worst.along_m = std::max(worst.along_m, scan.sigma.along_m);
    worst.across_m = std::max(worst.across_m, scan.sigma.across_m);
    worst.up_m = std::max(worst.up_m, scan.sigma.up_m);
  }
  for (double* sigma_m : {&worst.along_m, &worst.across_m, &worst.up_m})
    *sigma_m = std::hypot(*sigma_m, registration.datum_sigma_m);
  return worst;
}

double SurfaceSigma::along_normal(const Eigen::Vector2d& normal, double incidence) const {
  return std::hypot(normal.x() * across_m, normal.y() * up_m, incidence * distance_m);
}

SurfaceSigma surface_sigma(const RegistrationResult& registration, const ProfilingOptions& options) {
  const PoseSigma common = common_sigma(registration);
  return {common.across_m, common.up_m, options.range_bias_sigma_m};
}

double noise_squared_m2(const MapCell& cell) {
  const double spread_m = static_cast<double>(cell.spread_m);
  return spread_m * spread_m / std::max(1U, cell.count);
}

double volume_sigma_m3(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line, double from_m,
                       double to_m, VolumePart part, const RegistrationResult& registration,
                       const ProfilingOptions& options) {
  Sums sums;
  sums.columns.resize(map.columns);
  std::vector<double> row_amount_m2;
  for (std::size_t r = 0; r < map.rows; ++r) {
    const double chainage = map.row_chainage(r);
    if (chainage < from_m || chainage > to_m) continue;
    const ProfileStretch stretch(design.profile_at(chainage));
    const std::vector<MapCell> row(map.cells.begin() + static_cast<std::ptrdiff_t>(r * map.columns),
                                   map.cells.begin() + static_cast<std::ptrdiff_t>((r + 1) * map.columns));
    const Outline outline = outline_of(row, stretch, map.step_q_m, options.gap_m);
    const double offset_m = design.line_at(line, chainage).offset_m;
    double amount = 0.0;
    for (std::size_t c = 0; c < outline.cells.size(); ++c) {
      const double q0 = static_cast<double>(c) * map.step_q_m;
      const double q1 = std::min(q0 + map.step_q_m, stretch.length_m());
      const double length = stretch.line_length_m(q0, q1);
      const MapCell& cell = outline.cells[c];
      add_cell(sums, sums.columns[c], cell, stretch.at(0.5 * (q0 + q1)), length * map.step_s_m, offset_m, part);
      if (!has_rock(cell.kind)) continue;
      const double over = static_cast<double>(cell.deviation_m) - offset_m;
      if (belongs(part, over)) amount += length * std::abs(over);
    }
    row_amount_m2.push_back(amount);
  }
  const PoseSigma sigma = common_sigma(registration);
  // Where nothing was measured at all, the rock may be anywhere that it is looked for.
  const double mean = sums.measured_m2 > 0.0 ? sums.deviation_sum / sums.measured_m2 : 0.5 * options.reach_out_m;
  const double variance = sums.measured_m2 > 0.0 ? sums.deviation_square / sums.measured_m2 - mean * mean : 0.0;
  const double rock_variance = std::max(variance, 0.0);
  const double unseen_variance_m6 = unseen_variance(sums.columns, map.step_q_m, mean, rock_variance);
  const double total = std::pow(sums.across_m2 * sigma.across_m, 2) + std::pow(sums.up_m2 * sigma.up_m, 2) +
                       std::pow(end_difference_m2(row_amount_m2) * sigma.along_m, 2) +
                       std::pow(sums.biased_m2 * options.range_bias_sigma_m, 2) + sums.noise_m6 +
                       sums.interpolated_m2 * correlated_area_m2 * 0.25 * rock_variance + unseen_variance_m6;
  return std::sqrt(total);
}

}  // namespace adit
