#pragma once
// The paper's way to a coarse position, beside ours: SIFT against the picture of a centre disc.

#include <opencv2/features2d.hpp>

#include "tests/bench/target_pictures.h"

namespace adit::bench {

/// Counts where OpenCV's SIFT has a keypoint on a target, and where its description is like one of the drawn disc's.
class SiftLook {
 public:
  SiftLook();
  void add(const PictureOfTargets& taken);
  void print() const;

 private:
  cv::Ptr<cv::SIFT> sift_ = cv::SIFT::create();
  cv::Mat of_disc_;  ///< descriptors, a row each
  int pictures_ = 0, shown_ = 0, with_keypoint_ = 0, matched_ = 0;
  std::size_t keypoints_ = 0, matches_ = 0;
  double seconds_ = 0.0, our_seconds_ = 0.0;
};

}  // namespace adit::bench
