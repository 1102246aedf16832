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
};

Raster raster_of(const ScannerOptions& options) {
  Raster raster;
  raster.lowest_rad = rad_from_deg(options.lowest_elevation_deg);
  const double height = 0.5 * pi - raster.lowest_rad;
  raster.step_rad = std::sqrt(2.0 * pi * height / static_cast<double>(std::max<std::uint64_t>(options.pulses, 100)));
  raster.rows = static_cast<std::size_t>(height / raster.step_rad);
  raster.columns = static_cast<std::size_t>(options.pulses) / std::max<std::size_t>(raster.rows, 1);
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

struct Shot {
  const RayCast& rays;
  const Pose& design_from_scan;
  const ScannerOptions& options;
  const std::vector<Eigen::Vector2d>& people;
  Random random;

  /// What the scanner measures of a pulse; empty when nothing comes back.
  std::optional<Echo> echo(std::uint64_t pulse, double azimuth, double elevation) const {
    const Eigen::Vector3d true_direction = along(azimuth + options.angle_sigma_rad * random.normal(4 * pulse),
                                                 elevation + options.angle_sigma_rad * random.normal(4 * pulse + 1));
    const auto hit = rays.first_hit(design_from_scan.translation(), design_from_scan.linear() * true_direction,
                                    options.most_range_m, people);
    if (!hit || hit->range_m < options.least_range_m) return std::nullopt;
    const double brightness =
        std::min(1.0, albedo(hit->surface) * hit->incidence_cosine * std::min(1.0, std::pow(8.0 / hit->range_m, 1.5)) +
                          0.01 * random.normal(4 * pulse + 2));
    const double lost = options.dropout / std::clamp(brightness, 0.01, 1.0);
    if (random.uniform(8 * pulse + 5) < lost) return std::nullopt;
    const double sigma = options.range_sigma_m * (1.0 + 0.5 * (1.0 / std::max(hit->incidence_cosine, 0.1) - 1.0));
    return Echo{hit->range_m + sigma * random.normal(4 * pulse + 3), static_cast<float>(std::max(brightness, 0.0))};
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
  const double turn = 2.0 * pi / static_cast<double>(raster.columns);
  for (std::size_t first = 0; first < raster.columns; first += columns_at_once) {
    std::vector<PointCloud> columns(std::min(columns_at_once, raster.columns - first));
    parallel_for_each_index(
        columns.size(),
        [&](std::size_t k) {
          const std::size_t c = first + k;
          progress.step(c, raster.columns);
          for (std::size_t r = 0; r < raster.rows; ++r) {
            const double azimuth = turn * static_cast<double>(c);
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
