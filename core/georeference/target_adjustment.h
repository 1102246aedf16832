#pragma once
// Place, blur and brightness of a coded target adjusted to the grey values of a picture (Gauss-Newton).

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "core/geometry/grey_picture.h"
#include "core/georeference/target_model.h"
#include "core/georeference/target_place.h"

namespace adit {

inline constexpr double core_radius = 0.60;   ///< disc and most of the white ring
inline constexpr double whole_radius = 1.14;  ///< and some of the paper around
inline constexpr double usual_blur_px = 0.8;  ///< of cameras in focus, where a target tells little of it

inline constexpr double least_amplitude = 5.0;   ///< grey levels between white and black: below, there is no target
inline constexpr double least_core_near = 0.80;  ///< share of disc and white ring that must lie near the fitted pattern

/// Correlation of two lists of numbers.
class Correlation {
 public:
  void add(double a, double b) {
    ++n_;
    a_ += a;
    b_ += b;
    aa_ += a * a;
    bb_ += b * b;
    ab_ += a * b;
  }
  double value() const {
    const double va = aa_ - a_ * a_ / n_, vb = bb_ - b_ * b_ / n_;
    return n_ > 1.0 && va > 0.0 && vb > 0.0 ? (ab_ - a_ * b_ / n_) / std::sqrt(va * vb) : 0.0;
  }

 private:
  double n_ = 0.0, a_ = 0.0, b_ = 0.0, aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

/// Everything that makes the grey values of a target: place, blur, brightness of the paper (a plane over the pattern)
/// and what black takes away.
struct Appearance {
  TargetPlace place;
  double blur_px = usual_blur_px;
  double bleed = 0.0;
  double white = 0.0;
  Eigen::Vector2d white_slope = Eigen::Vector2d::Zero();
  double black = 0.0;  ///< grey levels below white
};

/// The unknowns, in order: center 2, shape by rows 4, white, black; then tilt 2, blur, slope of the white 2, bleeding.
constexpr int few_unknowns = 8, unknowns = 14;
using Unknowns = Eigen::Matrix<double, unknowns, 1>;
using NormalMatrix = Eigen::Matrix<double, unknowns, unknowns>;

/// Normal equations of the weighted squares.
struct FitSums {
  NormalMatrix normal = NormalMatrix::Zero();  ///< lower half
  Unknowns right = Unknowns::Zero();
  double cost = 0.0;
  double weight = 0.0;
  bool whole = true;  ///< all places lie in the picture
};

/// What is fitted: the grid, the parts of the pattern that count, which unknowns are free.
struct FitProblem {
  const GreyPicture* picture;
  std::vector<PatternPlace> grid;
  bool with_segments;
  Blackness blackness;  ///< of the segments
  bool few;             ///< tilt, blur and slope stay as they are
  Eigen::Vector2d tilt_prior;
  double tilt_sigma;
};

/// Of disc and white ring alone, without perspective, on few places.
FitProblem disc_problem(const GreyPicture& picture, const TargetPlace& place);

/// How well a fitted pattern explains the picture.
struct FitQuality {
  double likeness = 0.0;   ///< correlation, of the places that lie near
  double near = 0.0;       ///< share of the places that lie near (outlier_limit): the rest is covered, or no target
  double core_near = 0.0;  ///< of disc and white ring
};

FitQuality quality_of(const FitProblem& problem, const Appearance& look);

/// What neither pattern nor noise explains, over the variance of the pattern, in the pixels that lie near. Noise is
/// told by neighbouring pixels: it lets them differ, while what is drawn otherwise is off in patches.
double unexplained_share(const FitProblem& problem, const Appearance& look);

/// Beyond so many grey levels a place counts less: a cover, dust, glare.
double outlier_limit(const Appearance& look);

/// Without the places that are off by more than twice that: they are covered, and rock before a target pulls even where
/// it weighs little.
FitProblem of_near_places(const FitProblem& problem, const Appearance& look);

/// Levels of white and black by least squares at a fixed place.
void set_levels(const FitProblem& problem, Appearance& look);

/// Gauss-Newton with damping, places off by more than `limit` grey levels weighed down (Huber). False where it leaves
/// the picture, or the pattern turns inside out or vanishes.
bool refine(const FitProblem& problem, Appearance& look, double limit, int most_steps, FitSums& last);

/// The same, going on from the sums `last` of the same problem and limit.
bool refine_on(const FitProblem& problem, Appearance& look, double limit, int most_steps, FitSums& last);

/// Covariance of the centre [pixels squared].
Eigen::Matrix2d center_covariance(const FitProblem& problem, const Appearance& look, const FitSums& sums);

/// Pixels for one outer radius, where it is seen longest.
double long_radius_px(const Eigen::Matrix2d& shape);

}  // namespace adit
