#include "core/georeference/target_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/foundation/angle.h"
#include "core/georeference/coded_pattern.h"
#include "core/georeference/target_adjustment.h"

namespace adit {
namespace {

using coded_pattern::disc_radius;

constexpr double sharp_blur_px = 0.7, soft_blur_px = 1.3;  // to begin with

/// The black three quarters of a disc of radius 1: their centroid, and one over the square root of their covariance.
/// `filled`: how far blur has filled the white quarter, 0 to 1.
struct DiscMoments {
  Eigen::Vector2d centroid;
  Eigen::Matrix2d whitening;
  explicit DiscMoments(double filled) {
    // Of the white quarter: area pi/4, first moment 1/3 along either axis, second moments pi/16 and 1/8; of the disc
    // pi/4.
    const double white = 1.0 - filled, area = pi - white * pi / 4.0, first = -white / 3.0 / area;
    const double same = (pi / 4.0 - white * pi / 16.0) / area - first * first,
                 mixed = -white / 8.0 / area - first * first;
    centroid = {first, first};
    Eigen::Matrix2d covariance;
    covariance << same, mixed, mixed, same;
    whitening = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).operatorInverseSqrt();
  }
};

/// How far the white quarter of a disc is filled, by how far the patch fills its moments: 0.86 where it is not, and as
/// good as that up to 0.90, for pixels are coarse; 1 as a disc.
double filled_quarter(const DarkBlob& blob) {
  constexpr double open = 0.90, full = 1.0;
  return std::clamp((blob.fill() - open) / (full - open), 0.0, 1.0);
}

/// Disc and white ring as they look in every rotation, but for the blur.
class DiscLooks {
 public:
  /// On a grid of so many places across, with the blur that is `usual_blur_px` where `upright` are the pixels for one
  /// outer radius.
  DiscLooks(double across, const Eigen::Matrix2d& upright) {
    const TargetBlur blur(usual_blur_px, 0.0, upright);
    double sum = 0.0;
    for (const PatternPlace& at : pattern_grid(0.0, core_radius, 1e9, across)) {
      places_.push_back({at.at, disc_shade_at(at, blur).value});
      sum += places_.back().darkness;
    }
    for (Place& place : places_) {
      place.darkness -= sum / static_cast<double>(places_.size());
      squares_ += place.darkness * place.darkness;
    }
  }

  /// Correlation with the picture, without perspective; -1 where it leaves the picture.
  double likeness(const GreyPicture& picture, const Eigen::Vector2d& center, const Eigen::Matrix2d& shape) const {
    const double reach_u = core_radius * shape.row(0).norm(), reach_v = core_radius * shape.row(1).norm();
    if (!picture.holds(center.x() - reach_u, center.y() - reach_v) ||
        !picture.holds(center.x() + reach_u, center.y() + reach_v))
      return -1.0;
    double sum = 0.0, squares = 0.0, mixed = 0.0;
    for (const Place& place : places_) {
      const double grey = picture.between(center.x() + shape(0, 0) * place.at.x() + shape(0, 1) * place.at.y(),
                                          center.y() + shape(1, 0) * place.at.x() + shape(1, 1) * place.at.y());
      sum += grey;
      squares += grey * grey;
      mixed += grey * place.darkness;
    }
    const double variance = squares - sum * sum / static_cast<double>(places_.size());
    return variance > 0.0 && squares_ > 0.0 ? -mixed / std::sqrt(variance * squares_) : 0.0;
  }

 private:
  struct Place {
    Eigen::Vector2d at;
    double darkness;  ///< less the mean
  };
  std::vector<Place> places_;
  double squares_ = 0.0;
};

/// Disc and white ring adjusted, without perspective, from a blur to begin with. Nothing where they do not fit.
TargetStart fit_core(const GreyPicture& picture, const TargetPlace& place, double blur_px) {
  constexpr int more_steps = 2;
  constexpr double least_at_start = 0.86, least_after_a_step = 0.90,
                   least_core_likeness = 0.935;  // right ones: 0.895, 0.916, 0.945
  const FitProblem problem = disc_problem(picture, place);
  Appearance look;
  look.place = place;
  look.blur_px = blur_px;
  set_levels(problem, look);
  FitSums last;
  if (look.black < least_amplitude || quality_of(problem, look).likeness < least_at_start ||
      !refine(problem, look, 1e9, 1, last) || quality_of(problem, look).likeness < least_after_a_step ||
      !refine_on(problem, look, 1e9, more_steps, last))
    return {};
  const FitQuality quality = quality_of(problem, look);
  if (look.black < least_amplitude || quality.likeness <= least_core_likeness || quality.near < least_core_near)
    return {};
  return {look.place, look.blur_px, quality.likeness};
}

/// A turn of the disc, and how well it looks.
struct Turn {
  double likeness = -1.0;
  double turn_rad = 0.0;
};

bool likelier(const Turn& a, const Turn& b) {
  return a.likeness != b.likeness ? a.likeness > b.likeness : a.turn_rad < b.turn_rad;
}

constexpr int rotations = 12, likeliest = 6;
constexpr double apart_rad = 2.0 * pi / rotations;

/// A disc of which a patch shows the moments, turned.
class TurnedDisc {
 public:
  explicit TurnedDisc(const DarkBlob& blob)
      : center_(blob.center),
        upright_(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(blob.covariance_px2).operatorSqrt() / disc_radius),
        disc_(filled_quarter(blob)) {}

  TargetPlace at(double turn_rad) const {
    Eigen::Matrix2d mirror;  // v runs down, y up
    mirror << std::cos(turn_rad), std::sin(turn_rad), std::sin(turn_rad), -std::cos(turn_rad);
    TargetPlace place;
    place.shape = upright_ * mirror * disc_.whitening;
    place.center = center_ - place.shape * disc_.centroid * disc_radius;
    return place;
  }
  /// Pixels for one outer radius, about.
  Eigen::Matrix2d upright() const { return 2.0 * upright_; }  // a disc has twice its standard deviation as radius

 private:
  Eigen::Vector2d center_;
  Eigen::Matrix2d upright_;
  DiscMoments disc_;
};

Turn looked_at(const GreyPicture& picture, const TurnedDisc& disc, const DiscLooks& looks, double turn_rad) {
  const TargetPlace place = disc.at(turn_rad);
  return {looks.likeness(picture, place.center, place.shape), turn_rad};
}

/// Those that look best on few places; none where none looks like a disc.
std::vector<Turn> likely_turns(const GreyPicture& picture, const TurnedDisc& disc) {
  constexpr double few_across = 5.0, usual_radius_px = 8.0;
  constexpr double hopeless = 0.80;  // of few places; right ones: 0.82 and more
  static const DiscLooks coarse(few_across, usual_radius_px * Eigen::Matrix2d::Identity());
  std::vector<Turn> turns(rotations);
  for (int k = 0; k < rotations; ++k)
    turns[static_cast<std::size_t>(k)] = looked_at(picture, disc, coarse, apart_rad * k);
  std::sort(turns.begin(), turns.end(), likelier);
  if (turns.front().likeness < hopeless) return {};
  turns.resize(likeliest);
  return turns;
}

}  // namespace

TargetStart target_start(const GreyPicture& picture, const DarkBlob& blob) {
  constexpr double many_across = 10.0, least_turn_likeness = 0.75, as_good = 0.06, sure_likeness = 0.98;
  const TurnedDisc disc(blob);
  std::vector<Turn> likely = likely_turns(picture, disc);
  if (likely.empty()) return {};
  const DiscLooks fine(many_across, disc.upright());
  for (Turn& turn : likely) turn = looked_at(picture, disc, fine, turn.turn_rad);
  std::sort(likely.begin(), likely.end(), likelier);
  // Black that runs into the white quarter lets other rotations look as good.
  std::vector<double> tried_rad;
  TargetStart best;
  for (const Turn& middle : likely) {
    if (middle.likeness < likely.front().likeness - as_good || best.likeness > sure_likeness) break;
    if (std::any_of(tried_rad.begin(), tried_rad.end(), [&](double other_rad) {
          return std::cos(middle.turn_rad - other_rad) > std::cos(1.5 * apart_rad);
        }))
      continue;
    tried_rad.push_back(middle.turn_rad);
    const Turn turn = std::min({middle, looked_at(picture, disc, fine, middle.turn_rad - 0.5 * apart_rad),
                                looked_at(picture, disc, fine, middle.turn_rad + 0.5 * apart_rad)},
                               likelier);
    if (turn.likeness < least_turn_likeness) break;
    const TargetStart start = fit_core(picture, disc.at(turn.turn_rad), sharp_blur_px);
    if (start.likeness > best.likeness) best = start;
  }
  return best;
}

TargetStart softer_start(const GreyPicture& picture, const TargetStart& start) {
  return fit_core(picture, start.place, soft_blur_px);
}

}  // namespace adit
