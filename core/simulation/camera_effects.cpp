#include "core/simulation/camera_effects.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

using Light = std::vector<float>;

struct Sensor {
  int width, height;
  std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
};

/// Mean of the ideal picture over one pixel of the sensor: several rays, each to its own place.
double seen_by(const GreyPicture& ideal, double focal_px, const CameraLens& lens, int u, int v) {
  constexpr int rays = 3;
  const double middle_u = 0.5 * (ideal.width - 1), middle_v = 0.5 * (ideal.height - 1);
  double sum = 0.0;
  for (int j = 0; j < rays; ++j)
    for (int i = 0; i < rays; ++i) {
      const auto place = place_of(lens, {u + (i + 0.5) / rays - 0.5, v + (j + 0.5) / rays - 0.5});
      if (!place) continue;
      const double x = middle_u + focal_px * place->x(), y = middle_v + focal_px * place->y();
      if (ideal.holds(x, y)) sum += ideal.between(x, y);
    }
  return sum / (rays * rays);
}

void blur(Light& light, const Sensor& sensor, double sigma_px) {
  const int half = std::max(1, static_cast<int>(std::ceil(3.5 * sigma_px)));
  std::vector<float> kernel;  // from -half
  float total = 0.0F;
  for (int k = -half; k <= half; ++k) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma_px * sigma_px))));
    total += kernel.back();
  }
  for (const bool along : {true, false}) {
    const Light before = light;
    parallel_for_each_index(
        static_cast<std::size_t>(sensor.height),
        [&](std::size_t row) {
          const int v = static_cast<int>(row);
          for (int u = 0; u < sensor.width; ++u) {
            float sum = 0.0F;
            for (int k = -half; k <= half; ++k) {
              const int i = along ? std::clamp(u + k, 0, sensor.width - 1) : u;
              const int j = along ? v : std::clamp(v + k, 0, sensor.height - 1);
              sum += kernel[static_cast<std::size_t>(k) + static_cast<std::size_t>(half)] * before[sensor.at(i, j)];
            }
            light[sensor.at(u, v)] = sum / total;
          }
        },
        16);
  }
}

/// Something bright before the picture: an ellipse with a soft rim.
struct Spot {
  double u, v, long_px, short_px, turn_rad, light, soft;
};

void add_spot(Light& light, const Sensor& sensor, const Spot& spot) {
  const double reach = spot.long_px * (1.0 + 2.0 * spot.soft) + 1.0;
  for (int v = std::max(0, static_cast<int>(spot.v - reach)); v < std::min<double>(sensor.height, spot.v + reach); ++v)
    for (int u = std::max(0, static_cast<int>(spot.u - reach)); u < std::min<double>(sensor.width, spot.u + reach);
         ++u) {
      const double x = std::cos(spot.turn_rad) * (u - spot.u) + std::sin(spot.turn_rad) * (v - spot.v);
      const double y = -std::sin(spot.turn_rad) * (u - spot.u) + std::cos(spot.turn_rad) * (v - spot.v);
      const double out = std::hypot(x / spot.long_px, y / spot.short_px);
      const double share = std::clamp((1.0 + spot.soft - out) / (2.0 * spot.soft), 0.0, 1.0);
      light[sensor.at(u, v)] += static_cast<float>(spot.light * share);
    }
}

void add_spots(Light& light, const Sensor& sensor, const CameraEffects& effects) {
  const Random random(effects.seed, 17);
  std::uint64_t k = 0;
  const double size = sensor.width / 1000.0;
  const auto next = [&](double low, double high) { return random.uniform(k++, low, high); };
  for (int i = 0; i < effects.dust; ++i) {
    const double u = next(0.0, sensor.width), v = next(0.0, sensor.height), radius = size * next(1.5, 9.0);
    add_spot(light, sensor, {u, v, radius, radius, 0.0, next(5.0, 40.0), 0.2});
  }
  for (int i = 0; i < effects.glare; ++i) {
    const double u = next(0.0, sensor.width), v = next(0.0, sensor.height), radius = size * next(4.0, 14.0);
    const double thin = next(0.1, 1.0), turn = next(0.0, pi);
    add_spot(light, sensor, {u, v, radius / thin, radius, turn, next(100.0, 500.0), 0.5});
  }
}

}  // namespace

IdealSize ideal_size(const CameraLens& lens, double finer) {
  double most_x = 0.0, most_y = 0.0;
  for (const double u : {-0.5, 0.5 * lens.width, lens.width - 0.5})
    for (const double v : {-0.5, 0.5 * lens.height, lens.height - 0.5})
      if (const auto place = place_of(lens, {u, v})) {
        most_x = std::max(most_x, std::abs(place->x()));
        most_y = std::max(most_y, std::abs(place->y()));
      }
  IdealSize size;
  size.focal_px = finer * lens.focal_px();
  size.width = 2 * static_cast<int>(std::ceil(most_x * size.focal_px)) + 8;
  size.height = 2 * static_cast<int>(std::ceil(most_y * size.focal_px)) + 8;
  return size;
}

GreyPicture stored_picture(const GreyPicture& ideal, double ideal_focal_px, const CameraLens& lens,
                           const CameraEffects& effects) {
  const Sensor sensor{lens.width, lens.height};
  Light light(sensor.at(0, lens.height), 0.0F);
  const double half_diagonal = 0.5 * std::hypot(lens.width, lens.height);
  parallel_for_each_index(
      static_cast<std::size_t>(lens.height),
      [&](std::size_t row) {
        const int v = static_cast<int>(row);
        for (int u = 0; u < lens.width; ++u) {
          const double out = std::hypot(u - 0.5 * lens.width, v - 0.5 * lens.height) / half_diagonal;
          light[sensor.at(u, v)] = static_cast<float>(effects.exposure * (1.0 - effects.vignetting * out * out) *
                                                      seen_by(ideal, ideal_focal_px, lens, u, v));
        }
      },
      8);
  blur(light, sensor, effects.blur_px);
  add_spots(light, sensor, effects);
  const Random random(effects.seed, 18);
  GreyPicture picture(lens.width, lens.height);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double clean = static_cast<double>(light[i]);
    const double noisy =
        clean + random.normal(i) * std::hypot(effects.read_noise, effects.shot_noise * std::sqrt(std::max(0.0, clean)));
    const double stored = 255.0 * std::pow(std::clamp(noisy / 255.0, 0.0, 1.0), 1.0 / effects.gamma);
    picture.pixels[i] = static_cast<std::uint8_t>(std::lround(stored));
  }
  return picture;
}

}  // namespace adit
