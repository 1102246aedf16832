#include "core/georeference/target_decode.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace adit {
namespace {

using coded_pattern::segments;

constexpr int unknowns = segments + 3;                  // and the paper's brightness: a plane
constexpr double from_radius = 0.46, to_radius = 1.12;  // white ring, paper around
using Solution = Eigen::Matrix<double, unknowns, 1>;
using NormalMatrix = Eigen::Matrix<double, unknowns, unknowns>;

/// d grey / d unknowns at a place, of which most are none, and the grey value.
struct Place {
  std::array<int, unknowns> at;
  std::array<double, unknowns> value;
  int count = 0;
  double grey = 0.0;

  void set(int k, double slope) {
    at[static_cast<std::size_t>(count)] = k;
    value[static_cast<std::size_t>(count++)] = slope;
  }
  double dot(const Solution& solution) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += value[i] * solution(at[i]);
    return sum;
  }
};

std::optional<std::vector<Place>> places_of(const GreyPicture& picture, const TargetPlace& place,
                                            const std::vector<PatternPlace>& grid, const TargetTone& tone) {
  const TargetBlur blur(tone.blur_px, tone.bleed, place.shape);
  std::vector<Place> places;
  places.reserve(grid.size());
  for (const PatternPlace& pattern : grid) {
    if (pattern.radius < from_radius || pattern.radius > to_radius) continue;
    const Eigen::Vector2d pixel = place.pixel(pattern.at);
    if (!picture.holds(pixel.x(), pixel.y())) return std::nullopt;
    const TargetDarkness darkness = darkness_at(pattern, blur);
    Place one;
    for (int k = 0; k < segments; ++k)
      if (const double dark = darkness.segments[static_cast<std::size_t>(k)]; dark != 0.0)
        one.set(k, -tone.black * dark);
    one.set(segments, 1.0);
    one.set(segments + 1, pattern.at.x());
    one.set(segments + 2, pattern.at.y());
    one.grey = picture.between(pixel.x(), pixel.y()) + tone.black * darkness.disc;
    places.push_back(one);
  }
  return places;
}

/// Lower half of the normal matrix, and the right side.
void add_weighed(NormalMatrix& normal, Solution& right, const Place& one, double weight) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(one.count); ++c) {
    const double weighed = weight * one.value[c];
    right(one.at[c]) += weighed * one.grey;
    for (std::size_t r = c; r < static_cast<std::size_t>(one.count); ++r)
      normal(one.at[r], one.at[c]) += weighed * one.value[r];
  }
}

}  // namespace

std::optional<SegmentDarkness> segment_darkness(const GreyPicture& picture, const TargetPlace& place,
                                                const std::vector<PatternPlace>& grid, const TargetTone& tone) {
  const auto places = places_of(picture, place, grid, tone);
  if (!places || places->size() < 2 * unknowns) return std::nullopt;
  constexpr int rounds = 2;
  double limit = std::numeric_limits<double>::infinity();
  Solution solution = Solution::Zero();
  NormalMatrix covariance;
  for (int round = 0; round < rounds; ++round) {
    NormalMatrix normal = NormalMatrix::Identity() * 1e-6;
    Solution right = Solution::Zero();
    double squares = 0.0, weights = 0.0;
    for (const Place& one : *places) {
      const double off = one.grey - one.dot(solution);
      const double weight = std::abs(off) > limit ? limit / std::abs(off) : 1.0;
      add_weighed(normal, right, one, weight);
      squares += weight * off * off;
      weights += weight;
    }
    const NormalMatrix whole = normal.selfadjointView<Eigen::Lower>();
    const Eigen::LDLT<NormalMatrix> factors = whole.ldlt();
    solution = factors.solve(right);
    limit = std::max(3.0, 0.15 * tone.black);
    if (round + 1 == rounds)
      covariance = factors.solve(NormalMatrix::Identity()) * (squares / std::max(1.0, weights - unknowns));
  }
  SegmentDarkness darkness;
  for (int k = 0; k < segments; ++k) {
    darkness.value[static_cast<std::size_t>(k)] = solution(k);
    darkness.sigma[static_cast<std::size_t>(k)] = std::sqrt(std::max(0.0, covariance(k, k)));
  }
  return darkness;
}

namespace {

constexpr double most_off = 1.9;  // segments, in sum

double off_of(const SegmentDarkness& darkness, int k, bool black) {
  return std::min(1.0, std::abs(darkness.value[static_cast<std::size_t>(k)] - (black ? 1.0 : 0.0)));
}

/// What the segments show where each of them is clear by itself.
std::optional<DecodedTarget> clear_code(const SegmentDarkness& darkness) {
  constexpr double least_clear = 0.22;  // of a segment, from one half
  constexpr double clear_sigmas = 3.0;
  TargetCode code = 0;
  double sum = 0.0, clearest = 1.0;
  for (int k = 0; k < segments; ++k) {
    const double value = darkness.value[static_cast<std::size_t>(k)];
    const double clear = std::abs(value - 0.5);
    if (clear < std::max(least_clear, clear_sigmas * darkness.sigma[static_cast<std::size_t>(k)])) return std::nullopt;
    code = static_cast<TargetCode>(2 * code + (value > 0.5 ? 1 : 0));
    sum += off_of(darkness, k, value > 0.5);
    clearest = std::min(clearest, 2.0 * clear);
  }
  if (sum > most_off || id_of_code(code) == 0) return std::nullopt;
  return DecodedTarget{code, clearest, true};
}

/// True where no segment is off white and black by more than ink and light make them: nothing covers any.
bool is_whole(const SegmentDarkness& darkness) {
  constexpr double most_off_each = 0.12;
  return std::all_of(darkness.value.begin(), darkness.value.end(),
                     [](double value) { return std::min(std::abs(value), std::abs(value - 1.0)) < most_off_each; });
}

}  // namespace

std::optional<DecodedTarget> nearest_code(const SegmentDarkness& darkness, const std::vector<TargetCode>& codes) {
  constexpr double least_margin = 1.2;  // segments, to the next code of a list
  const auto clear = clear_code(darkness);
  if (codes.empty()) return clear;
  double best = std::numeric_limits<double>::infinity(), next = best;
  TargetCode code = 0;
  for (const TargetCode candidate : codes) {
    double sum = 0.0;
    for (int k = 0; k < segments; ++k) sum += off_of(darkness, k, is_black(candidate, k));
    if (sum < best) {
      next = best;
      best = sum;
      code = candidate;
    } else {
      next = std::min(next, sum);
    }
  }
  // Whole, it is what it shows: one of the list, or none however near.
  if (clear && clear->code != code && is_whole(darkness)) return std::nullopt;
  if (best > most_off) return std::nullopt;
  if (next - best < least_margin) return clear && clear->code == code ? clear : std::nullopt;
  return DecodedTarget{code, next - best, false};
}

std::optional<DecodedTarget> decode_segments(const GreyPicture& picture, const TargetPlace& place,
                                             const std::vector<PatternPlace>& grid, const TargetTone& tone,
                                             const std::vector<TargetCode>& codes) {
  const auto darkness = segment_darkness(picture, place, grid, tone);
  return darkness ? nearest_code(*darkness, codes) : std::nullopt;
}

}  // namespace adit
