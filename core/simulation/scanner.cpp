#include "core/simulation/scanner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/foundation/random.h"
#include "core/simulation/ray_cast.h"

namespace adit {
namespace {

struct Raster {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double step_rad = 0.0;
  double lowest_rad = 0.0;
  double first_rad = 0.0;
  double turn_rad = 0.0;  ///< from one column to the next
};

Raster raster_of(const ScannerOptions& options) {
  Raster raster;
  raster.lowest_rad = rad_from_deg(options.lowest_elevation_deg);
  const double height = rad_from_deg(options.highest_elevation_deg) - raster.lowest_rad;
  const double sector = rad_from_deg(options.to_azimuth_deg - options.from_azimuth_deg);
  raster.first_rad = rad_from_deg(options.from_azimuth_deg);
  raster.step_rad = std::sqrt(sector * height / static_cast<double>(std::max<std::uint64_t>(options.pulses, 100)));
  raster.rows = static_cast<std::size_t>(height / raster.step_rad);
  raster.columns = static_cast<std::size_t>(options.pulses) / std::max<std::size_t>(raster.rows, 1);
  raster.turn_rad = sector / static_cast<double>(raster.columns);
  return raster;
}

double albedo(Surface surface) {
  switch (surface) {
    case Surface::duct:
      return 0.9;
    case Surface::rig:
      return 0.75;
    case Surface::person:
      return 0.6;
    case Surface::muck:
      return 0.3;
    default:
      return 0.42;
  }
}

/// Direction of a pulse in the scanner's frame.
Eigen::Vector3d along(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

struct Echo {
  double range_m;
  float intensity;
};

/// What a whole beam meets.
struct BeamHit {
  double range_m = 0.0;
  double incidence_cosine = 0.0;
  double albedo = 0.0;
};

struct Shot {
  const RayCast& rays;
  const Pose& design_from_scan;
  const ScannerOptions& options;
  const std::vector<Eigen::Vector2d>& people;
  Random random;

  /// Targets among what the beam meets, in shares: seven rays stand for it. Behind a rim is `rock`.
  BeamHit beam_hit(const Eigen::Vector3d& direction, const BeamHit& rock) const {
    constexpr double exit_radius_m = 0.0025, spread_rad = 1.5e-4;
    const Eigen::Vector3d aside = direction.unitOrthogonal(), up = direction.cross(aside);
    BeamHit mean;
    for (int k = 0; k < 7; ++k) {
      const double share = k == 0 ? 0.0 : 0.7;
      const double beside = share * (exit_radius_m / rock.range_m + spread_rad);
      const Eigen::Vector3d ray =
          (direction + beside * (std::cos(pi / 3.0 * k) * aside + std::sin(pi / 3.0 * k) * up)).normalized();
      const auto hit = first_target_hit(options.targets, design_from_scan.translation(), ray);
      const BeamHit one =
          hit && hit->range_m < rock.range_m ? BeamHit{hit->range_m, hit->incidence_cosine, hit->albedo} : rock;
      mean.range_m += one.range_m / 7.0;
      mean.incidence_cosine += one.incidence_cosine / 7.0;
      mean.albedo += one.albedo / 7.0;
    }
    return mean;
  }

  /// What the scanner measures of a pulse; empty when nothing comes back.
  std::optional<Echo> echo(std::uint64_t pulse, double azimuth, double elevation) const {
    const Eigen::Vector3d true_direction = along(azimuth + options.angle_sigma_rad * random.normal(4 * pulse),
                                                 elevation + options.angle_sigma_rad * random.normal(4 * pulse + 1));
    const Eigen::Vector3d direction = design_from_scan.linear() * true_direction;
    const auto met = rays.first_hit(design_from_scan.translation(), direction, options.most_range_m, people);
    if (!met) return std::nullopt;
    BeamHit hit{met->range_m, met->incidence_cosine, albedo(met->surface)};
    if (!options.targets.empty()) hit = beam_hit(direction, hit);
    if (hit.range_m < options.least_range_m) return std::nullopt;
    const double brightness =
        std::min(1.0, hit.albedo * hit.incidence_cosine * std::min(1.0, std::pow(8.0 / hit.range_m, 1.5)) +
                          0.01 * random.normal(4 * pulse + 2));
    const double lost = options.dropout / std::clamp(brightness, 0.01, 1.0);
    if (random.uniform(8 * pulse + 5) < lost) return std::nullopt;
    const double sigma = options.range_sigma_m * (1.0 + 0.5 * (1.0 / std::max(hit.incidence_cosine, 0.1) - 1.0));
    return Echo{hit.range_m + sigma * random.normal(4 * pulse + 3), static_cast<float>(std::max(brightness, 0.0))};
  }
};

}  // namespace

void scan_tunnel(std::span<const RockTunnel> tunnels, const Pose& design_from_scan, const ScannerOptions& options,
                 const std::vector<Eigen::Vector2d>& people, const std::function<void(const PointCloud&)>& take,
                 Progress& progress) {
  constexpr std::size_t columns_at_once = 128;
  const Raster raster = raster_of(options);
  const RayCast rays(tunnels);
  const Shot shot{rays, design_from_scan, options, people, Random(options.seed, 77)};
  for (std::size_t first = 0; first < raster.columns; first += columns_at_once) {
    std::vector<PointCloud> columns(std::min(columns_at_once, raster.columns - first));
    parallel_for_each_index(
        columns.size(),
        [&](std::size_t k) {
          const std::size_t c = first + k;
          progress.step(c, raster.columns);
          for (std::size_t r = 0; r < raster.rows; ++r) {
            const double azimuth = raster.first_rad + raster.turn_rad * static_cast<double>(c);
            const double elevation = raster.lowest_rad + raster.step_rad * (static_cast<double>(r) + 0.5);
            const auto echo = shot.echo(c * raster.rows + r, azimuth, elevation);
            if (!echo) continue;
            columns[k].points.push_back((echo->range_m * along(azimuth, elevation)).cast<float>());
            columns[k].intensity.push_back(echo->intensity);
          }
        },
        4);
    PointCloud part;
    for (const PointCloud& column : columns) append(part, column);
    take(part);
  }
}

PointCloud scan_tunnel(std::span<const RockTunnel> tunnels, const Pose& design_from_scan, const ScannerOptions& options,
                       const std::vector<Eigen::Vector2d>& people, Progress& progress) {
  PointCloud scan;
  scan_tunnel(
      tunnels, design_from_scan, options, people, [&](const PointCloud& part) { append(scan, part); }, progress);
  return scan;
}

}  // namespace adit
