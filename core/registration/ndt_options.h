#pragma once
// The normal distributions transform's choices.

#include <Eigen/Core>

namespace adit {

/// What of the source is laid on the target's distributions.
enum class NdtSources {
  distributions,  ///< those of half the target's cells: with cells alike, the two grids would lock onto each other
  points          ///< the means of its smallest cells, an even subsample, whatever the target's cells
};

/// How a step turns a point.
enum class RotationForm {
  full,        ///< exp([phi]x): the second derivatives are those of a rotation
  small_angle  ///< I + [phi]x (Magnusson et al., eq. 9 and 10): they are zero
};

struct NdtScoreOptions {
  RotationForm rotation = RotationForm::full;
  /// Share of points that lie on nothing the other scan knows. Makes d1 and d2 of the mixture (Magnusson's thesis 2009,
  /// eq. 6.9 and 6.10) in units of the cell, so that small cells behave as large ones do.
  double outlier_share = 0.55;
};

struct NdtOptions {
  double coarsest_cell_m = 4.0;  ///< the search begins with the target's cells of about this size
  /// And ends with these, or the second finest there are: in smaller ones a thin, noisy scan of a smooth place tilts by
  /// degrees at no cost to the score.
  double finest_cell_m = 0.4;
  /// Rounds of blasting repeat every few metres, and so does the rock they leave. Starts so far along the direction
  /// that the coarsest cells know least are tried too, both ways; 0: none.
  double search_m = 4.0;
  /// Unit direction (target's frame) along which the pose is not moved; zero: it is moved in all.
  Eigen::Vector3d held_direction = Eigen::Vector3d::Zero();
  NdtSources sources = NdtSources::distributions;
  NdtScoreOptions score;
  int most_iterations = 30;  ///< of each size of cells
};

}  // namespace adit
