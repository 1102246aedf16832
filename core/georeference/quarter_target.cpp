#include "core/georeference/quarter_target.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr int ring_px = 5, ring_places = 16;
constexpr double least_contrast = 20.0, least_likeness = 0.93, least_radius_px = 6.0;

using Ring = std::array<double, ring_places>;
constexpr std::array<std::array<int, 2>, ring_places> ring_offsets{{{5, 0},
                                                                    {5, 2},
                                                                    {4, 4},
                                                                    {2, 5},
                                                                    {0, 5},
                                                                    {-2, 5},
                                                                    {-4, 4},
                                                                    {-5, 2},
                                                                    {-5, 0},
                                                                    {-5, -2},
                                                                    {-4, -4},
                                                                    {-2, -5},
                                                                    {0, -5},
                                                                    {2, -5},
                                                                    {4, -4},
                                                                    {5, -2}}};

Ring ring_at(const GreyPicture& picture, int u, int v) {
  Ring ring;
  for (std::size_t n = 0; n < ring.size(); ++n) ring[n] = picture.at(u + ring_offsets[n][0], v + ring_offsets[n][1]);
  return ring;
}

/// Opposite places alike, those a quarter of a turn on unlike, and the middle as grey as the ring: grey levels.
double response_at(const GreyPicture& picture, int u, int v) {
  const Ring ring = ring_at(picture, u, v);
  double sums = 0.0, differences = 0.0, mean = 0.0;
  for (std::size_t n = 0; n < 4; ++n) sums += std::abs(ring[n] + ring[n + 8] - ring[n + 4] - ring[n + 12]);
  for (std::size_t n = 0; n < 8; ++n) differences += std::abs(ring[n] - ring[n + 8]);
  for (const double value : ring) mean += value / ring_places;
  const double middle =
      (picture.at(u, v) + picture.at(u + 1, v) + picture.at(u - 1, v) + picture.at(u, v + 1) + picture.at(u, v - 1)) /
      5.0;
  return (sums - differences) / 8.0 - std::abs(middle - mean);
}

struct Corner {
  double response;
  int u, v;
};

std::vector<Corner> corners_of(const GreyPicture& picture, Progress& progress) {
  constexpr int room = ring_px + 2;
  constexpr double least_response = 8.0;
  const auto rows = static_cast<std::size_t>(std::max(0, picture.height - 2 * room));
  std::vector<float> response(picture.pixels.size(), 0.0F);
  parallel_blocks(rows, 16, [&](std::size_t begin, std::size_t end) {
    progress.check();
    for (std::size_t row = begin; row < end; ++row)
      for (int u = room; u < picture.width - room; ++u) {
        const int v = static_cast<int>(row) + room;
        response[picture.index(u, v)] = static_cast<float>(response_at(picture, u, v));
      }
  });
  std::vector<Corner> corners;
  for (int v = room; v < picture.height - room; ++v)
    for (int u = room; u < picture.width - room; ++u) {
      const float here = response[picture.index(u, v)];
      if (static_cast<double>(here) < least_response) continue;
      bool greatest = true;
      for (int b = -2; b <= 2 && greatest; ++b)
        for (int a = -2; a <= 2; ++a) {
          const float other = response[picture.index(u + a, v + b)];
          const bool before = b < 0 || (b == 0 && a < 0);
          greatest = greatest && (before ? other < here : other <= here);
        }
      if (greatest) corners.push_back({static_cast<double>(here), u, v});
    }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.response > b.response; });
  return corners;
}

/// grey = white - black (1 + e1 e2) / 2, e = erf(distance from an edge over sqrt(2) blur).
struct Cross {
  Eigen::Vector2d center;
  double angle[2];  ///< of the edges
  double blur_px = 0.8;
  double white = 0.0;
  double black = 0.0;  ///< grey levels below white; may be negative: then the other quarters are dark
};

constexpr int unknowns = 7;  // centre, angles, blur, white, black
using CrossRow = Eigen::Matrix<double, unknowns, 1>;
using CrossNormal = Eigen::Matrix<double, unknowns, unknowns>;

/// Value and derivatives at a pixel.
double grey_of(const Cross& cross, const Eigen::Vector2d& pixel, CrossRow& row) {
  const Eigen::Vector2d off = pixel - cross.center;
  double e[2], slope[2], along[2];
  Eigen::Vector2d normal[2];
  const double width = std::sqrt(2.0) * cross.blur_px;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d edge(std::cos(cross.angle[k]), std::sin(cross.angle[k]));
    normal[k] = {-edge.y(), edge.x()};
    const double distance = normal[k].dot(off);
    along[k] = edge.dot(off);
    e[k] = std::erf(distance / width);
    slope[k] = 2.0 / std::sqrt(pi) * std::exp(-distance * distance / (width * width)) / width;
  }
  const double half = -0.5 * cross.black;
  const Eigen::Vector2d by_place = half * (slope[0] * e[1] * normal[0] + e[0] * slope[1] * normal[1]);
  double by_blur = 0.0;
  for (int k = 0; k < 2; ++k) by_blur -= half * slope[k] * e[1 - k] * normal[k].dot(off) / cross.blur_px;
  row << -by_place, -half * slope[0] * along[0] * e[1], -half * slope[1] * along[1] * e[0], by_blur, 1.0,
      -0.5 * (1.0 + e[0] * e[1]);
  return cross.white - 0.5 * cross.black * (1.0 + e[0] * e[1]);
}

struct CrossFit {
  Cross cross;
  double likeness = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// Gauss-Newton within a radius; nothing where it leaves the picture or what it began at.
std::optional<CrossFit> adjusted_cross(const GreyPicture& picture, const SampleOf& sample_of, Cross cross,
                                       double radius_px) {
  constexpr int rounds = 8;
  constexpr double farthest_px = 3.0, least_blur_px = 0.3, most_blur_px = 3.0;
  const Eigen::Vector2d began = cross.center;
  CrossFit fit;
  for (int round = 0; round <= rounds; ++round) {
    CrossNormal normal = 1e-9 * CrossNormal::Identity();
    CrossRow right = CrossRow::Zero(), row;
    double n = 0.0, squares = 0.0, sum = 0.0, sum2 = 0.0;
    normal(4, 4) += 1.0;  // blur, held loosely: a clean edge tells it
    right(4) += 0.8 - cross.blur_px;
    for (int v = static_cast<int>(cross.center.y() - radius_px); v <= static_cast<int>(cross.center.y() + radius_px);
         ++v)
      for (int u = static_cast<int>(cross.center.x() - radius_px); u <= static_cast<int>(cross.center.x() + radius_px);
           ++u) {
        if (u < 0 || v < 0 || u >= picture.width || v >= picture.height) return std::nullopt;
        const auto sample = sample_of ? sample_of(u, v) : GreySample{1.0 * u, 1.0 * v, 1.0 * picture.at(u, v)};
        if (!sample) continue;
        const Eigen::Vector2d pixel(sample->u, sample->v);
        if ((pixel - cross.center).squaredNorm() > radius_px * radius_px) continue;
        const double grey = sample->grey, off = grey - grey_of(cross, pixel, row);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
        right += off * row;
        squares += off * off;
        sum += grey;
        sum2 += grey * grey;
        n += 1.0;
      }
    const double spread = sum2 - sum * sum / std::max(n, 1.0);
    if (n < 3 * unknowns || spread <= 0.0) return std::nullopt;
    const Eigen::LDLT<CrossNormal> solver(normal.selfadjointView<Eigen::Lower>());
    fit.cross = cross;
    fit.likeness = std::sqrt(std::max(0.0, 1.0 - squares / spread));
    fit.covariance =
        squares / (n - unknowns) * CrossNormal(solver.solve(CrossNormal::Identity())).topLeftCorner<2, 2>();
    const CrossRow step = solver.solve(right);
    if (!step.allFinite()) return std::nullopt;
    cross.center += step.head<2>();
    for (int k = 0; k < 2; ++k) cross.angle[k] += std::clamp(step(2 + k), -0.2, 0.2);
    cross.blur_px = std::clamp(cross.blur_px + step(4), least_blur_px, most_blur_px);
    cross.white += step(5);
    cross.black += step(6);
    if ((cross.center - began).norm() > farthest_px) return std::nullopt;
  }
  return fit;
}

/// Edges where the ring's second harmonic passes through zero.
Cross first_cross(const GreyPicture& picture, const Corner& corner) {
  const Ring ring = ring_at(picture, corner.u, corner.v);
  double c = 0.0, s = 0.0, mean = 0.0;
  for (std::size_t n = 0; n < ring.size(); ++n) {
    const double angle = std::atan2(ring_offsets[n][1], ring_offsets[n][0]);
    c += ring[n] * std::cos(2.0 * angle);
    s += ring[n] * std::sin(2.0 * angle);
    mean += ring[n] / ring_places;
  }
  Cross cross;
  cross.center = Eigen::Vector2d(corner.u, corner.v);
  const double bright = 0.5 * std::atan2(s, c);
  cross.angle[0] = bright - 0.25 * pi;
  cross.angle[1] = bright + 0.25 * pi;
  const double amplitude = pi / 2.0 * std::hypot(c, s) * 2.0 / ring_places;
  // Along `bright` it lies left of one edge and right of the other: e1 e2 is negative there.
  cross.white = mean + 0.5 * amplitude;
  cross.black = amplitude;
  return cross;
}

std::optional<FoundQuarters> quarters_at(const GreyPicture& picture, const SampleOf& sample_of, const Corner& corner) {
  constexpr double most_radius_px = 400.0, growth = 1.35, least_crossing_rad = 0.35, most_loss = 0.015;
  std::optional<CrossFit> best;
  double radius_px = 5.0, held_px = 0.0;
  Cross cross = first_cross(picture, corner);
  for (; radius_px < most_radius_px; radius_px *= growth) {
    const auto fit = adjusted_cross(picture, sample_of, cross, radius_px);
    if (!fit || fit->likeness < least_likeness || std::abs(fit->cross.black) < least_contrast) break;
    if (best && fit->likeness < best->likeness - most_loss) break;  // the rim: rock that happens to suit lies beyond
    // What moves with the radius (rock before a rim) is known no better than that.
    const Eigen::Vector2d moved =
        best ? Eigen::Vector2d(fit->cross.center - best->cross.center) : Eigen::Vector2d(0, 0);
    best = fit;
    best->covariance += moved * moved.transpose();
    cross = fit->cross;
    held_px = radius_px;
  }
  if (!best || held_px < least_radius_px) return std::nullopt;
  const double crossing = std::abs(std::remainder(best->cross.angle[1] - best->cross.angle[0], pi));
  if (crossing < least_crossing_rad) return std::nullopt;
  FoundQuarters found;
  found.center = best->cross.center;
  found.covariance_px2 = best->covariance;
  for (int k = 0; k < 2; ++k) found.edge[k] = {std::cos(best->cross.angle[k]), std::sin(best->cross.angle[k])};
  // An edge along the pixels' rows lies anywhere between two of them; one that crosses many is known by as much better.
  for (int k = 0; k < 2; ++k) {
    const double rows = std::max(1.0, 2.0 * held_px * found.edge[k].cwiseAbs().minCoeff());
    const Eigen::Vector2d off = found.edge[1 - k] / (std::sqrt(12.0) * rows * std::abs(std::sin(crossing)));
    found.covariance_px2 += off * off.transpose();
  }
  found.radius_px = held_px;
  found.likeness = best->likeness;
  found.contrast = std::abs(best->cross.black);
  return found;
}

}  // namespace

std::vector<FoundQuarters> find_quarters(const GreyPicture& picture, const SampleOf& sample_of, Progress& progress) {
  const std::vector<Corner> corners = corners_of(picture, progress);
  std::vector<std::optional<FoundQuarters>> fitted(corners.size());
  parallel_for_each_index(
      corners.size(),
      [&](std::size_t i) {
        progress.check();
        fitted[i] = quarters_at(picture, sample_of, corners[i]);
      },
      16);
  std::vector<FoundQuarters> found;
  for (const auto& one : fitted) {
    if (!one) continue;
    if (std::none_of(found.begin(), found.end(), [&](const FoundQuarters& other) {
          return (other.center - one->center).norm() < std::max(3.0, 0.5 * std::min(other.radius_px, one->radius_px));
        }))
      found.push_back(*one);
  }
  return found;
}

}  // namespace adit
