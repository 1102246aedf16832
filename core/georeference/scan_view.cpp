#include "core/georeference/scan_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr double half_width = 0.6;  // tangent: 31 degrees to either side
constexpr float least_range_m = 0.3F;

/// Means of each pixel so far.
struct Means {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> intensity;
  std::vector<std::uint16_t> count;
  std::vector<float> shared, weight;  ///< intensity of the points about it, the nearer the more, and their weights
};

/// Whether anything of a box may lie in a view: none of its corners need, where it is large.
bool may_show(const BoundingBox& box, const Eigen::Matrix3d& scan_from_view) {
  const Eigen::Vector3d middle = scan_from_view.transpose() * Eigen::Vector3d(box.center().cast<double>());
  const double reach = 0.5 * static_cast<double>(box.diagonal().norm());
  if (middle.norm() <= reach) return true;
  const double off = std::acos(std::clamp(middle.z() / middle.norm(), -1.0, 1.0));
  const double corner = std::atan(std::sqrt(2.0) * half_width);
  return off - std::asin(std::min(1.0, reach / middle.norm())) <= corner;
}

/// Gives a point's intensity to the four pixels about it.
void share(float intensity, float u, float v, const GreyPicture& picture, Means& means) {
  const int left = static_cast<int>(std::floor(u)), above = static_cast<int>(std::floor(v));
  const float a = u - static_cast<float>(left), b = v - static_cast<float>(above);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      if (left + x < 0 || above + y < 0 || left + x >= picture.width || above + y >= picture.height) continue;
      const std::size_t at = picture.index(left + x, above + y);
      const float weight = (x == 0 ? 1.0F - a : a) * (y == 0 ? 1.0F - b : b);
      means.shared[at] += weight * intensity;
      means.weight[at] += weight;
    }
}

void take(const PointCloud& cloud, const ScanView& view, Means& means) {
  const Eigen::Matrix3f view_from_scan = view.scan_from_view.transpose().cast<float>();
  const auto focal = static_cast<float>(view.focal_px), middle = static_cast<float>(view.middle_px());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = view_from_scan * cloud.points[i];
    if (p.z() <= 0.0F || p.squaredNorm() < least_range_m * least_range_m) continue;
    const float u = middle + focal * p.x() / p.z() + 0.5F, v = middle + focal * p.y() / p.z() + 0.5F;
    if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(view.grey.width) &&
          v < static_cast<float>(view.grey.height)))
      continue;
    const std::size_t at = view.grey.index(static_cast<int>(u), static_cast<int>(v));
    if (means.count[at] == std::numeric_limits<std::uint16_t>::max()) continue;
    const auto n = static_cast<float>(++means.count[at]);
    means.points[at] += (cloud.points[i] - means.points[at]) / n;
    if (!cloud.has_intensity()) continue;
    means.intensity[at] += (cloud.intensity[i] - means.intensity[at]) / n;
    share(cloud.intensity[i], u - 0.5F, v - 0.5F, view.grey, means);
  }
}

Means means_of(const TileSource& scan, const ScanView& view, Progress& progress) {
  constexpr std::size_t tiles_at_once = 16;
  std::vector<std::size_t> tiles;
  for (std::size_t tile = 0; tile < scan.tile_count(); ++tile)
    if (may_show(scan.box(tile), view.scan_from_view)) tiles.push_back(tile);
  const std::size_t pixels = view.grey.pixels.size();
  Means means{std::vector<Eigen::Vector3f>(pixels, Eigen::Vector3f::Zero()), std::vector<float>(pixels, 0.0F),
              std::vector<std::uint16_t>(pixels, 0), std::vector<float>(pixels, 0.0F),
              std::vector<float>(pixels, 0.0F)};
  for (std::size_t first = 0; first < tiles.size(); first += tiles_at_once) {
    progress.step(first, tiles.size());
    std::vector<PointCloud> read(std::min(tiles_at_once, tiles.size() - first));
    parallel_for_each_index(
        read.size(), [&](std::size_t k) { read[k] = scan.read(tiles[first + k]); }, 1);
    for (const PointCloud& cloud : read) take(cloud, view, means);  // in order: means of floats depend on it
  }
  return means;
}

/// What is usual of the intensity at each range: walls grow dim with it.
class UsualIntensity {
 public:
  UsualIntensity(const ScanView& view, const std::vector<float>& intensity) {
    constexpr std::size_t every = 23, least = 50;
    std::array<std::vector<double>, bins> of_bin;
    std::vector<double> all;
    for (std::size_t i = 0; i < intensity.size(); i += every) {
      if (!(intensity[i] > 0.0F)) continue;
      of_bin[bin_of(view.points[i].norm())].push_back(static_cast<double>(intensity[i]));
      all.push_back(of_bin[bin_of(view.points[i].norm())].back());
    }
    const double usual = all.empty() ? 1.0 : median(std::move(all));
    for (std::size_t b = 0; b < bins; ++b) value_[b] = of_bin[b].size() < least ? usual : median(std::move(of_bin[b]));
  }
  /// Between the middles of the bins, so that no step runs through a target.
  double at(float range_m) const {
    const double place =
        std::clamp(per_octave * std::log2(static_cast<double>(range_m)) + before - 0.5, 0.0, bins - 1.001);
    const auto b = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(b);
    return (1.0 - share) * value_[b] + share * value_[b + 1];
  }

 private:
  static constexpr std::size_t bins = 32;
  static constexpr double per_octave = 4.0, before = 8.0;  // from 0.25 m
  static std::size_t bin_of(float range_m) {
    return static_cast<std::size_t>(
        std::clamp(per_octave * std::log2(static_cast<double>(range_m)) + before, 0.0, bins - 1.0));
  }
  std::array<double, bins> value_{};
};

/// Pixels without a point take the mean of their neighbours: between the lines of a scan, not across what it missed.
void fill_gaps(GreyPicture& grey, std::vector<std::uint8_t>& known) {
  constexpr int rounds = 3, least_neighbours = 3;
  for (int round = 0; round < rounds; ++round) {
    const GreyPicture before = grey;
    const std::vector<std::uint8_t> known_before = known;
    parallel_for_each_index(static_cast<std::size_t>(grey.height), [&](std::size_t row) {
      const int v = static_cast<int>(row);
      if (v == 0 || v == grey.height - 1) return;
      for (int u = 1; u < grey.width - 1; ++u) {
        if (known_before[grey.index(u, v)]) continue;
        int sum = 0, count = 0;
        for (int b = v - 1; b <= v + 1; ++b)
          for (int a = u - 1; a <= u + 1; ++a)
            if (known_before[grey.index(a, b)]) sum += before.at(a, b), ++count;
        if (count < least_neighbours) continue;
        grey.pixels[grey.index(u, v)] = static_cast<std::uint8_t>((sum + count / 2) / count);
        known[grey.index(u, v)] = 1;
      }
    });
  }
}

}  // namespace

Eigen::Vector3d ScanView::direction(const Eigen::Vector2d& pixel) const {
  return scan_from_view *
         Eigen::Vector3d((pixel.x() - middle_px()) / focal_px, (pixel.y() - middle_px()) / focal_px, 1.0).normalized();
}

std::optional<Eigen::Vector2d> ScanView::pixel_of(const Eigen::Vector3d& in_scan) const {
  const Eigen::Vector3d p = scan_from_view.transpose() * in_scan;
  if (p.z() <= 0.0) return std::nullopt;
  return Eigen::Vector2d(middle_px() + focal_px * p.x() / p.z(), middle_px() + focal_px * p.y() / p.z());
}

std::optional<GreySample> ScanView::sample(int u, int v) const {
  if (!has_point(u, v)) return std::nullopt;
  const auto pixel = pixel_of(point(u, v));
  if (!pixel) return std::nullopt;
  return GreySample{pixel->x(), pixel->y(), static_cast<double>(point_grey.at(u, v))};
}

double view_focal_px(const TileSource& scan) {
  constexpr double most_px = 2400.0, least_px = 100.0, points_a_pixel = 1.2;
  constexpr int rows = 90, columns = 180;  // of equal solid angle
  constexpr std::size_t one_of = 16;
  constexpr double usual_share = 0.3;
  std::vector<double> points(rows * columns, 0.0);
  for (std::size_t tile = 0; tile < scan.tile_count(); ++tile) {
    const std::size_t whole = scan.point_count(tile), prefix = whole / one_of + 1;
    const std::vector<Eigen::Vector3f> some = scan.positions(tile, prefix);
    for (const Eigen::Vector3f& p : some) {
      const double range = static_cast<double>(p.norm());
      if (range < static_cast<double>(least_range_m)) continue;
      const double azimuth = std::atan2(static_cast<double>(p.y()), static_cast<double>(p.x())) + pi;
      const double height = 0.5 * (static_cast<double>(p.z()) / range + 1.0);
      const int row = std::min(rows - 1, static_cast<int>(height * rows));
      const int column = std::min(columns - 1, static_cast<int>(azimuth / (2.0 * pi) * columns));
      points[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] +=
          static_cast<double>(whole) / static_cast<double>(some.size());
    }
  }
  std::erase(points, 0.0);
  if (points.empty()) return least_px;
  const double density = quantile(points, usual_share) * (rows * columns) / (4.0 * pi);
  return std::clamp(std::sqrt(density / points_a_pixel), least_px, most_px);
}

std::vector<Eigen::Matrix3d> views_about() {
  // Neighbours overlap by 14 degrees and more. Wider ones would be fewer, but points lie too far apart in their
  // corners.
  constexpr int level = 8, inclined = 6;
  std::vector<Eigen::Matrix3d> views;
  const auto add = [&](const Eigen::Vector3d& ahead, const Eigen::Vector3d& down) {
    Eigen::Matrix3d view;
    view << down.cross(ahead), down, ahead;
    views.push_back(view);
  };
  const auto add_row = [&](double elevation_rad, int count) {
    for (int k = 0; k < count; ++k) {
      const double azimuth_rad = 2.0 * pi * k / count, a = std::cos(azimuth_rad), b = std::sin(azimuth_rad);
      const double out = std::cos(elevation_rad), up = std::sin(elevation_rad);
      add({a * out, b * out, up}, {a * up, b * up, -out});
    }
  };
  add_row(0.0, level);
  add_row(0.25 * pi, inclined);
  add_row(-0.25 * pi, inclined);
  add({0, 0, 1}, {1, 0, 0});
  add({0, 0, -1}, {1, 0, 0});
  return views;
}

ScanView scan_view(const TileSource& scan, const Eigen::Matrix3d& scan_from_view, double focal_px, Progress& progress) {
  constexpr double usual_grey = 40.0;  // paper sends back up to six times what rock does: nothing of it may be cut off
  ScanView view;
  view.scan_from_view = scan_from_view;
  view.focal_px = focal_px;
  const int side = 2 * static_cast<int>(half_width * focal_px) + 1;
  view.grey = view.point_grey = GreyPicture(side, side);
  Means means = means_of(scan, view, progress);
  std::vector<std::uint8_t> known(means.count.size());
  for (std::size_t i = 0; i < means.count.size(); ++i) {
    known[i] = means.count[i] > 0 ? 1 : 0;
    if (!known[i]) means.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  view.points = std::move(means.points);
  const UsualIntensity usual(view, means.intensity);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!known[i] || !(means.weight[i] > 0.0F)) continue;
    const double scale = usual_grey / usual.at(view.points[i].norm());
    const auto grey = [scale](float intensity) {
      return static_cast<std::uint8_t>(std::clamp(scale * static_cast<double>(intensity) + 0.5, 0.0, 255.0));
    };
    view.point_grey.pixels[i] = grey(means.intensity[i]);
    view.grey.pixels[i] = grey(means.shared[i] / means.weight[i]);
  }
  fill_gaps(view.grey, known);
  return view;
}

}  // namespace adit
