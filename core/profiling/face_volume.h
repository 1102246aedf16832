#pragma once
// What a round has taken out between two faces.

#include "core/foundation/progress.h"
#include "core/profiling/face.h"
#include "core/profiling/profiling.h"

namespace adit {

/// Rock between an earlier face and a later one, within the later as-built outline.
struct FaceVolume {
  double excavated_m3 = 0.0;
  double sigma_m3 = 0.0;
  double design_m3 = 0.0;  ///< within the reference line instead of the outline
  double from_m = 0.0;     ///< mean chainage of the faces, lesser first
  double to_m = 0.0;
  double advance_m = 0.0;  ///< between the means, in the direction of drive
  double sigma_advance_m = 0.0;
  double guessed_m2 = 0.0;     ///< of both faces, inside the outline: not seen, taken from the nearest place that was
  double contour_share = 0.0;  ///< of the length between the faces whose outline is known
  bool whole = false;          ///< false: the map does not hold both faces, or no outline near them; no volume then
};

/// dV = ds * double integral of (1 - k x) dx dz (SliceShape) over what lies inside a slice's outline and between the
/// faces, on the faces' grid refined to 5 cm. Slices less than 40 % of whose outline is known (the walls end at the
/// face) take the outline of the nearest that is better known, and count as wrong by as much as outlines differ in
/// area: give the map some metres of known walls before the faces. along_sigma_m: of each epoch's scans along the axis.
FaceVolume volume_between(const FaceMap& before, const FaceMap& after, const DeviationMap& map,
                          const DesignTunnel& design, const DesignLine& line, double before_along_sigma_m,
                          double after_along_sigma_m, const RegistrationResult& registration,
                          const ProfilingOptions& options, Progress& progress);

/// Rock left at a face against the drilled depth: where the earlier face stood on the mean, plus the drilled length.
struct RockLeft {
  double mean_m = 0.0;  ///< of seen cells; what was pulled farther than drilled counts as nothing
  double most_m = 0.0;
  double over_03_share = 0.0;  ///< of the seen face where more than 0.3 m was left
};
RockLeft rock_left(const FaceMap& after, double before_mean_m, double drilled_m, bool up_chainage);

}  // namespace adit
