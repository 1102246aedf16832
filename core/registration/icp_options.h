#pragma once
// The stages of iterative closest point as choices (Rusinkiewicz and Levoy 2001; Magnusson et al., section 4.1).

#include "core/foundation/options.h"

namespace adit {

/// Which points of the source are used.
enum class IcpSelection {
  all,
  uniform,      ///< every so manieth along the cloud's order
  random,       ///< others in each iteration
  normal_space  ///< at random, but as many from each direction that surfaces face: keeps what few features there are
};

/// The target's point that belongs to one of the source.
enum class IcpMatching {
  nearest,
  normal_shooting,  ///< where the line through the source's point along its normal meets the target (Chen, Medioni)
  projection        ///< what the target's scanner saw in the direction of the source's point
};

enum class IcpWeights {
  constant,
  distance,  ///< linear: 1 for points that coincide, 0 at the reach
  normals,   ///< the cosine of the angle between both normals
  range      ///< as the signal falls with the source's range r: 1 / (1 + (r / 10 m)^2)
};

enum class IcpMetric {
  point_to_point,  ///< the closed form
  point_to_plane,  ///< along the target's normal, a Gauss-Newton step
  plane_to_plane   ///< both sides as flat distributions (Segal et al. 2009), a Gauss-Newton step
};

struct IcpOptions {
  IcpSelection selection = IcpSelection::all;
  int samples = 3000;  ///< of the source, unless all
  int seed = 1;        ///< of random and normal-space selection
  IcpMatching matching = IcpMatching::nearest;
  IcpWeights weights = IcpWeights::constant;
  double reach_m = 0.3;            ///< pairs farther apart are rejected
  bool reach_falls = false;        ///< linearly, to nothing with the last iteration
  bool boundary_rejected = true;   ///< pairs on points at the target's rim
  double most_normals_deg = 45.0;  ///< pairs whose normals differ more are rejected; 90: none
  double best_share = 1.0;         ///< of the pairs, the nearest, that is kept
  IcpMetric metric = IcpMetric::plane_to_plane;
  int most_iterations = 50;
  double least_step_m = 2e-5;  ///< a smaller step ends it (turns at a lever of 5 m), unless the reach falls
};

template <typename Visitor>
void describe(Visitor& v, IcpOptions& o) {
  visit_choice(v, "selection", o.selection, {"all", "uniform", "random", "normal_space"},
               "which points of the source are used");
  v.count("samples", o.samples, "", 50, 10000000, "points of the source that are used, unless all are");
  v.count("seed", o.seed, "", 0, 2000000000, "of random and normal-space selection");
  visit_choice(v, "matching", o.matching, {"nearest", "normal_shooting", "projection"},
               "which point of the target belongs to one of the source");
  visit_choice(v, "weights", o.weights, {"constant", "distance", "normals", "range"},
               "how much a pair of points counts");
  v.number("reach_m", o.reach_m, "m", 0.01, 10.0, "pairs of points farther apart are rejected");
  v.flag("reach_falls", o.reach_falls, "the reach falls linearly, to nothing with the last iteration");
  v.flag("boundary_rejected", o.boundary_rejected, "pairs with points at the target's rim are rejected");
  v.number("most_normals_deg", o.most_normals_deg, "deg", 1.0, 90.0,
           "pairs whose normals differ more are rejected; 90: none");
  v.number("best_share", o.best_share, "", 0.05, 1.0, "of the pairs of points, the nearest, that is kept");
  visit_choice(v, "metric", o.metric, {"point_to_point", "point_to_plane", "plane_to_plane"},
               "what is made as small as can be");
  v.count("most_iterations", o.most_iterations, "", 1, 1000, "at most so many iterations");
  v.number("least_step_m", o.least_step_m, "m", 1e-9, 0.01, "a smaller step ends the iterations");
}

}  // namespace adit
