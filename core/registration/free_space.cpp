#include "core/registration/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr std::size_t columns = 180;
constexpr std::size_t rows = 90;

struct Direction {
  std::size_t row;
  std::size_t column;
};

template <typename Vector>
Direction direction_of(const Vector& place) {
  const double azimuth = std::atan2(static_cast<double>(place.y()), static_cast<double>(place.x())) / (2.0 * pi) + 0.5;
  const double elevation =
      std::atan2(static_cast<double>(place.z()), static_cast<double>(place.template head<2>().norm())) / pi + 0.5;
  return {std::min(static_cast<std::size_t>(elevation * static_cast<double>(rows)), rows - 1),
          std::min(static_cast<std::size_t>(azimuth * static_cast<double>(columns)), columns - 1)};
}

}  // namespace

RangeImage::RangeImage(const std::vector<Eigen::Vector3f>& points) {
  const Pixel nothing{std::numeric_limits<float>::max(), -1.0F};
  std::vector<Pixel> alone(rows * columns, nothing);
  for (const auto& point : points) {
    const Direction at = direction_of(point);
    Pixel& pixel = alone[at.row * columns + at.column];
    const float range = point.norm();
    pixel.least_m = std::min(pixel.least_m, range);
    pixel.most_m = std::max(pixel.most_m, range);
  }
  pixels_.assign(rows * columns, nothing);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, rows - 1); ++r)
        for (std::size_t c = column + columns - 1; c <= column + columns + 1; ++c) {
          Pixel& pixel = pixels_[row * columns + column];
          pixel.least_m = std::min(pixel.least_m, alone[r * columns + c % columns].least_m);
          pixel.most_m = std::max(pixel.most_m, alone[r * columns + c % columns].most_m);
        }
}

Sight RangeImage::sight_of(const Eigen::Vector3d& place, double margin_m) const {
  if (pixels_.empty()) return Sight::unknown;
  const Direction at = direction_of(place);
  const Pixel& pixel = pixels_[at.row * columns + at.column];
  if (pixel.most_m < pixel.least_m) return Sight::unknown;
  const double range = place.norm();
  if (range < static_cast<double>(pixel.least_m) - margin_m) return Sight::seen_through;
  if (range > static_cast<double>(pixel.most_m) + margin_m) return Sight::hidden;
  return Sight::on_surface;
}

}  // namespace adit
