#pragma once
// Which control point each target without a name is, by their distances.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/georeference/control.h"

namespace adit {

/// A target of one scan, in its frame; of a coded one the control point is known.
struct UnnamedTarget {
  Eigen::Vector3d in_scan = Eigen::Vector3d::Zero();
  double sigma_m = 0.001;
  std::string id;  ///< of its control point; empty: any
};

struct MatchOptions {
  double control_sigma_m = 0.002;
  double guess_sigma_m = 0.5;  ///< of the guess, where there is one
  double guess_sigma_rad = 0.035;
};

struct TargetMatch {
  /// Of each target its control point, by index; nothing for those that lie on none.
  std::vector<std::optional<std::size_t>> control;
  std::optional<Pose> local_from_scan;  ///< the rigid fit; nothing where there is none
  std::size_t matched = 0;
  bool ambiguous = false;  ///< another way fits as many: nothing is matched
};

/// Triples of targets whose distances are those of three control points give poses; the one on which most targets lie
/// on control (within four sigmas) is it, unless another does as well. Three are needed. A guess rules out poses more
/// than four of its sigmas away. Deterministic.
TargetMatch match_targets(const std::vector<UnnamedTarget>& seen, const std::vector<ControlPoint>& control,
                          const std::optional<Pose>& local_from_scan_guess, const MatchOptions& options,
                          Progress& progress);

}  // namespace adit
