#include "tests/bench/sift_look.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "core/georeference/target_adjustment.h"
#include "tests/bench/bench.h"

namespace adit::bench {
namespace {

constexpr float alike = 250.0F;  // distance of descriptors; those of the same corner in two photographs: up to some 250

/// Disc and white ring from the front, on the grey of rock.
cv::Mat drawn_disc() {
  constexpr int half = 96;
  constexpr double radius_px = 48.0;
  Eigen::Matrix2d shape;
  shape << radius_px, 0.0, 0.0, -radius_px;
  const TargetBlur blur(usual_blur_px, 0.0, shape);
  cv::Mat picture(2 * half + 1, 2 * half + 1, CV_8U, cv::Scalar(90));
  for (int v = -half; v <= half; ++v)
    for (int u = -half; u <= half; ++u) {
      const Eigen::Vector2d at(u / radius_px, -v / radius_px);
      if (at.norm() > core_radius) continue;
      const double darkness = disc_shade_at(PatternPlace(at), blur).value;
      picture.at<std::uint8_t>(v + half, u + half) = static_cast<std::uint8_t>(220.0 - 190.0 * darkness);
    }
  return picture;
}

}  // namespace

SiftLook::SiftLook() {
  const cv::Mat disc = drawn_disc();
  std::vector<cv::KeyPoint> found, on_disc;
  sift_->detect(disc, found);
  const float middle = 0.5F * static_cast<float>(disc.cols - 1), reach = 0.2F * 48.0F;
  for (const cv::KeyPoint& point : found)
    if (std::hypot(point.pt.x - middle, point.pt.y - middle) < reach) on_disc.push_back(point);
  sift_->compute(disc, on_disc, of_disc_);
}

void SiftLook::add(const PictureOfTargets& taken) {
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  cv::setNumThreads(1);
  const GreyPicture& grey = taken.picture;
  const cv::Mat picture(grey.height, grey.width, CV_8U, const_cast<std::uint8_t*>(grey.pixels.data()));
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  seconds_ += seconds_of(1, [&] { sift_->detectAndCompute(picture, cv::noArray(), points, descriptors); });
  Progress progress;
  const DetectOptions options = options_of(picture_lens(), target_code_count);
  our_seconds_ += seconds_of(1, [&] { static_cast<void>(detect_targets(grey, options, progress)); });
  std::vector<bool> like(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    float nearest = std::numeric_limits<float>::infinity();
    for (int k = 0; k < of_disc_.rows; ++k)
      nearest = std::min(nearest, static_cast<float>(cv::norm(descriptors.row(static_cast<int>(i)), of_disc_.row(k))));
    like[i] = nearest < alike;
    matches_ += like[i] ? 1 : 0;
  }
  ++pictures_;
  keypoints_ += points.size();
  for (const PictureOfTargets::Truth& target : taken.targets) {
    bool any = false, matched = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = std::hypot(points[i].pt.x - target.pixel.x(), points[i].pt.y - target.pixel.y());
      if (off > 0.12 * target.diameter_px) continue;
      any = true;
      matched = matched || like[i];
    }
    ++shown_;
    with_keypoint_ += any ? 1 : 0;
    matched_ += matched ? 1 : 0;
  }
}

void SiftLook::print() const {
  const double n = std::max(1, pictures_);
  std::printf(
      "\nThe paper's coarse position on the same pictures, by OpenCV's SIFT on one core: %.0f ms a picture (ours with reading and all: %.0f), %.0f keypoints, one of them on %d of %d discs; like a drawn disc (descriptors nearer than %.0f) are %.0f keypoints a picture, on %d of %d discs.\n",
      1e3 * seconds_ / n, 1e3 * our_seconds_ / n, static_cast<double>(keypoints_) / n, with_keypoint_, shown_,
      static_cast<double>(alike), static_cast<double>(matches_) / n, matched_, shown_);
}

}  // namespace adit::bench
