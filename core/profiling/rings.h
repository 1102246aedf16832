#pragma once
// Rings of a lined tunnel, measured by total station, against the axis.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "core/design/alignment.h"
#include "core/design/tolerances.h"
#include "core/foundation/finding.h"
#include "core/foundation/progress.h"
#include "core/profiling/ring_fit.h"

namespace adit {

/// A measured point as the file gives it: site coordinates [m].
struct RingPoint {
  std::string ring;
  std::string point;
  RingPlace place;
};

/// What the design says of rings: where their centre belongs beside the axis, their radius, and how far the centre may
/// lie off to the side or in height (0: not said).
struct RingDesign {
  double center_offset_m = 0.0;
  double center_height_m = 0.0;
  double radius_m = 0.0;
  double tolerance_m = 0.0;
};

struct RingResidual {
  std::string point;
  double clock_deg = 0.0;   ///< from the crown, clockwise looking up-chainage
  double residual_m = 0.0;  ///< outward positive
};

/// One ring in site coordinates. Deviations are those of its centre from where it belongs: right and up positive.
struct RingResult {
  std::string ring;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double chainage_m = 0.0;
  double station_m = 0.0;  ///< displayed
  double horizontal_deviation_m = 0.0;
  double vertical_deviation_m = 0.0;
  double radius_m = 0.0;
  double ovality_m = 0.0;        ///< not a number for fewer than six points or less than 210 degrees
  double major_clock_deg = 0.0;  ///< where the largest diameter points, 0 to 180; not a number likewise
  double rms_m = 0.0;
  double sigma_center_m = 0.0;  ///< not a number for three points
  double sigma_radius_m = 0.0;
  ToleranceVerdict verdict = ToleranceVerdict::not_shown;  ///< on its centre; not shown without a tolerance
  double tilt_deg = 0.0;                                   ///< of the ring's plane against the one square to the axis
  std::vector<RingResidual> residuals;
};

struct RingsResult {
  RingDesign design;
  std::vector<RingResult> rings;  ///< in order of chainage
  Findings findings;
};

/// Fits every ring. What makes no ring (too few points, on one line, no foot on the axis) is a decision and gives no
/// numbers; what makes its numbers doubtful is a decision or a warning beside them (docs/formats.md, rings).
RingsResult fit_rings(const std::vector<RingPoint>& points, const Alignment& axis, const RingDesign& design,
                      Progress& progress);

}  // namespace adit
