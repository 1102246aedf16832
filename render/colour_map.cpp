#include "render/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/statistics.h"

namespace adit::render {
namespace {

constexpr std::array round_steps{1.0, 2.0, 2.5, 5.0, 10.0};
constexpr double hair = 1e-9;  // relative: a value that is round but for rounding counts as round

struct Stop {
  double share;
  Colour colour;
};

// Of ColorBrewer's RdBu, the two halves from near white outwards.
constexpr std::array over_stops{Stop{0.0, {0.985, 0.955, 0.935}}, Stop{0.35, {0.957, 0.647, 0.510}},
                                Stop{0.70, {0.839, 0.376, 0.302}}, Stop{1.0, {0.500, 0.000, 0.122}}};
constexpr std::array under_stops{Stop{0.0, {0.935, 0.960, 0.985}}, Stop{0.35, {0.573, 0.773, 0.871}},
                                 Stop{0.70, {0.263, 0.576, 0.765}}, Stop{1.0, {0.020, 0.188, 0.480}}};

Colour along(const std::array<Stop, 4>& stops, double share) {
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const auto& [end, colour] = stops[i];
    const Stop& before = stops[i - 1];
    if (share <= end) return mixed(before.colour, colour, (share - before.share) / (end - before.share));
  }
  return stops.back().colour;
}

}  // namespace

double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : round_steps)
    if (step * power >= value * (1.0 - hair)) return step * power;
  return 10.0 * power;
}

double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + hair));
  double best = power;
  for (double step : round_steps)
    if (step * power <= value * (1.0 + hair)) best = step * power;
  return best;
}

std::vector<double> DeviationScale::boundaries_m() const {
  const auto count = std::lround((most_m - least_m) / step_m);
  const auto first = std::lround(least_m / step_m);
  std::vector<double> result;
  for (long i = 0; i <= count; ++i) result.push_back(static_cast<double>(first + i) * step_m);
  return result;
}

DeviationScale deviation_scale(const std::vector<float>& deviations_m) {
  std::vector<double> values;
  values.reserve(deviations_m.size());
  for (float d : deviations_m)
    if (std::isfinite(d)) values.push_back(static_cast<double>(d));
  if (values.empty()) return {};
  const double low = std::min(0.0, quantile(values, 0.0005));
  const double high = std::max(0.0, quantile(std::move(values), 0.9995));
  const double step = round_up(std::max((high - low) / 8.0, 0.005));
  const double below = std::ceil(-low / step - hair);
  const double above = std::ceil(high / step - hair);
  return {-std::max(below, 1.0) * step, std::max(above, 1.0) * step, step};
}

Colour deviation_colour(const DeviationScale& scale, double deviation_m) {
  if (!std::isfinite(deviation_m)) return {0.80, 0.80, 0.80};
  const double inside = std::clamp(deviation_m, scale.least_m, scale.most_m);
  const bool over = deviation_m >= 0.0;
  const double classes = std::max(1.0, std::round((over ? scale.most_m : -scale.least_m) / scale.step_m));
  const double place = std::min(std::floor(std::abs(inside) / scale.step_m + hair), classes - 1.0);
  return along(over ? over_stops : under_stops, classes > 1.0 ? 0.08 + 0.92 * place / (classes - 1.0) : 0.5);
}

Colour scan_colour(std::size_t i) {
  static constexpr std::array<Colour, scan_colour_count> list{
      Colour{0.122, 0.467, 0.706}, Colour{0.902, 0.380, 0.004}, Colour{0.105, 0.580, 0.290},
      Colour{0.698, 0.094, 0.169}, Colour{0.459, 0.318, 0.690}, Colour{0.550, 0.340, 0.294},
      Colour{0.850, 0.370, 0.680}, Colour{0.350, 0.350, 0.350}, Colour{0.690, 0.650, 0.050},
      Colour{0.050, 0.650, 0.720}, Colour{0.000, 0.270, 0.400}, Colour{0.450, 0.720, 0.200}};
  return list[i % list.size()];
}

}  // namespace adit::render
