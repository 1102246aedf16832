#include "core/simulation/scanner.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/foundation/random.h"

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

}  // namespace

PointCloud scan_tunnel(const RockTunnel& tunnel, const Pose& design_from_scan, const ScannerOptions& options,
                       const std::vector<Eigen::Vector2d>& people, Progress& progress) {
  const Raster raster = raster_of(options);
  const Random random(options.seed, 77);
  const double turn = 2.0 * pi / static_cast<double>(raster.columns);
  std::vector<PointCloud> columns(raster.columns);
  parallel_blocks(raster.columns, 16, [&](std::size_t begin, std::size_t end) {
    progress.step(begin, raster.columns);
    for (std::size_t c = begin; c < end; ++c) {
      for (std::size_t r = 0; r < raster.rows; ++r) {
        const std::uint64_t pulse = c * raster.rows + r;
        const double azimuth = turn * static_cast<double>(c);
        const double elevation = raster.lowest_rad + raster.step_rad * (static_cast<double>(r) + 0.5);
        const auto along = [](double a, double e) {
          return Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
        };
        const Eigen::Vector3d true_direction =
            along(azimuth + options.angle_sigma_rad * random.normal(4 * pulse),
                  elevation + options.angle_sigma_rad * random.normal(4 * pulse + 1));
        const auto hit = tunnel.cast(design_from_scan.translation(), design_from_scan.linear() * true_direction,
                                     options.most_range_m, people);
        if (!hit || hit->range_m < options.least_range_m) continue;
        const double brightness = std::min(
            1.0, albedo(hit->surface) * hit->incidence_cosine * std::min(1.0, std::pow(8.0 / hit->range_m, 1.5)) +
                     0.01 * random.normal(4 * pulse + 2));
        const double lost = options.dropout / std::clamp(brightness, 0.01, 1.0);
        if (random.uniform(8 * pulse + 5) < lost) continue;
        const double sigma = options.range_sigma_m * (1.0 + 0.5 * (1.0 / std::max(hit->incidence_cosine, 0.1) - 1.0));
        const double range = hit->range_m + sigma * random.normal(4 * pulse + 3);
        columns[c].points.push_back((range * along(azimuth, elevation)).cast<float>());
        columns[c].intensity.push_back(static_cast<float>(std::max(brightness, 0.0)));
      }
    }
  });
  PointCloud scan;
  for (const PointCloud& column : columns) append(scan, column);
  return scan;
}

}  // namespace adit
