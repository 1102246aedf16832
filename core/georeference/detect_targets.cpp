#include "core/georeference/detect_targets.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr int least_side_px = 32;
constexpr double least_area_px2 = 28.0,
                 most_area_px2 = 180.0;  // of a disc; a picture of half the size begins where this ends

/// A disc without a quarter fills its moments to 0.86 (DarkBlob::fill). Lines, letters
/// and crosses fill theirs less.
bool may_be_disc(const DarkBlob& blob) {
  constexpr double least_fill = 0.62, most_fill = 1.12,
                   least_ratio = 0.06;  // of variances: 75 degrees, and the quarter
  if (blob.covariance_px2.determinant() <= 0.0) return false;
  const double fill = blob.fill();
  const Eigen::Vector2d variances = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(blob.covariance_px2).eigenvalues();
  return fill > least_fill && fill < most_fill && variances(0) > least_ratio * variances(1);
}

/// A place of a picture whose pixels are `scale` wide, in the picture itself.
Eigen::Vector2d enlarged(const Eigen::Vector2d& pixel, double scale) {
  return scale * pixel + Eigen::Vector2d::Constant(0.5 * (scale - 1.0));
}

bool lies_in(const std::vector<DetectedTarget>& targets, const Eigen::Vector2d& pixel) {
  return std::any_of(targets.begin(), targets.end(), [&](const DetectedTarget& target) {
    return (target.center - pixel).norm() < 0.5 * target.diameter_px;
  });
}

/// Adds those of a second look that the first did not show alike.
void add_others(std::vector<DarkBlob>& blobs, const std::vector<DarkBlob>& second) {
  constexpr double near_px = 0.7, alike = 1.3;
  std::vector<DarkBlob> by_row = blobs;
  const auto higher = [](const DarkBlob& a, double v) { return a.center.y() < v; };
  std::stable_sort(by_row.begin(), by_row.end(),
                   [](const DarkBlob& a, const DarkBlob& b) { return a.center.y() < b.center.y(); });
  for (const DarkBlob& other : second) {
    const auto first = std::lower_bound(by_row.begin(), by_row.end(), other.center.y() - near_px, higher),
               last = std::lower_bound(first, by_row.end(), other.center.y() + near_px, higher);
    if (std::none_of(first, last, [&](const DarkBlob& blob) {
          return (blob.center - other.center).norm() < near_px && blob.area_px2 < alike * other.area_px2 &&
                 other.area_px2 < alike * blob.area_px2;
        }))
      blobs.push_back(other);
  }
}

/// What may be discs of a picture whose pixels are `scale` wide, but for what lies in targets that are found already.
std::vector<DarkBlob> candidates(const GreyPicture& level, double scale, const std::vector<DetectedTarget>& found) {
  constexpr double least_contrast = 3.0, sigmas = 2.0;
  const double contrast = std::max(least_contrast, sigmas * noise_of(level));
  std::vector<DarkBlob> blobs = dark_blobs(level, {.least_contrast = contrast,
                                                   .least_area_px2 = scale == 1.0 ? 7.0 : least_area_px2,
                                                   .most_area_px2 = most_area_px2});
  if (scale == 1.0) {
    // Blur fills the white ring of the smallest ones: it shows against a mean of what is nearer.
    add_others(blobs, dark_blobs(level, {.window_px = 11, .least_contrast = contrast, .most_area_px2 = 60.0}));
  }
  std::erase_if(
      blobs, [&](const DarkBlob& blob) { return !may_be_disc(blob) || lies_in(found, enlarged(blob.center, scale)); });
  return blobs;
}

/// Where targets may be, the likeliest first.
std::vector<TargetStart> best_first(const GreyPicture& level, const std::vector<DarkBlob>& blobs) {
  std::vector<TargetStart> starts(blobs.size());
  parallel_for_each_index(
      blobs.size(), [&](std::size_t i) { starts[i] = target_start(level, blobs[i]); }, 16);
  std::erase_if(starts, [](const TargetStart& start) { return start.likeness < 0.0; });
  std::stable_sort(starts.begin(), starts.end(),
                   [](const TargetStart& a, const TargetStart& b) { return a.likeness > b.likeness; });
  return starts;
}

/// A reading of a picture of half the size, in the picture itself.
void enlarge(TargetReading& reading, double scale) {
  reading.place.center = enlarged(reading.place.center, scale);
  reading.place.shape *= scale;
  reading.blur_px *= scale;
  reading.covariance_px2 *= scale * scale;
  reading.covered_px *= scale;
}

DetectedTarget target_of(const TargetReading& reading) {
  DetectedTarget target;
  target.id = id_of_code(reading.code);
  target.center = reading.place.center;
  target.diameter_px = 2.0 * Eigen::JacobiSVD<Eigen::Matrix2d>(reading.place.shape).singularValues()(0);
  target.covariance_px2 = reading.covariance_px2;
  target.sigma_px =
      std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(reading.covariance_px2).eigenvalues()(1)));
  target.reading = reading;
  return target;
}

/// Blur and noise take less from the likeness of larger targets: right ones show 0.975 and more, letters that make a
/// ring up to 0.966.
bool resembles_too_little(const TargetReading& reading) {
  constexpr double large_px = 30.0, least_likeness = 0.972;
  const double diameter_px = 2.0 * Eigen::JacobiSVD<Eigen::Matrix2d>(reading.place.shape).singularValues()(0);
  return diameter_px > large_px && reading.likeness < least_likeness;
}

/// Of readings of one place, which sizes of the picture give twice, the better one.
std::vector<DetectedTarget> without_doubles(std::vector<DetectedTarget> targets) {
  std::sort(targets.begin(), targets.end(),
            [](const DetectedTarget& a, const DetectedTarget& b) { return a.sigma_px < b.sigma_px; });
  std::vector<DetectedTarget> kept;
  for (const DetectedTarget& target : targets)
    if (std::none_of(kept.begin(), kept.end(), [&](const DetectedTarget& other) {
          return (other.center - target.center).norm() < 0.5 * std::min(other.diameter_px, target.diameter_px);
        }))
      kept.push_back(target);
  std::sort(kept.begin(), kept.end(), [](const DetectedTarget& a, const DetectedTarget& b) {
    return a.id != b.id ? a.id < b.id : a.center.x() < b.center.x();
  });
  return kept;
}

}  // namespace

std::vector<DetectedTarget> detect_targets(const GreyPicture& picture, const DetectOptions& options,
                                           Progress& progress) {
  if (picture.width < least_side_px || picture.height < least_side_px)
    throw Error("the picture has fewer than " + std::to_string(least_side_px) + " pixels a side", {},
                "use the camera's own pictures");
  std::vector<DetectedTarget> found;
  TargetFitOptions fit = options.fit;
  if (fit.focal_length_px <= 0.0) fit.focal_length_px = std::max(picture.width, picture.height);
  const double focal_px = fit.focal_length_px;
  GreyPicture level = picture;
  for (double scale = 1.0; level.width >= least_side_px && level.height >= least_side_px; scale *= 2.0) {
    progress.check();
    const std::vector<DarkBlob> blobs = candidates(level, scale, found);
    for (const TargetStart& start : best_first(level, blobs)) {
      progress.check();
      if (lies_in(found, enlarged(start.place.center, scale))) continue;  // a segment of one that was read
      auto reading = read_target(level, start, fit);
      if (!reading) continue;
      enlarge(*reading, scale);
      if (scale > 1.0) *reading = finer_reading(picture, *reading, focal_px);
      if (reading->alone && reflection_on_disc(picture, *reading)) continue;
      if (resembles_too_little(*reading)) continue;
      found.push_back(target_of(*reading));
      if (found.back().diameter_px < options.least_diameter_px) found.pop_back();
    }
    level = half_size(level);
    fit.focal_length_px *= 0.5;
  }
  return without_doubles(std::move(found));
}

}  // namespace adit
