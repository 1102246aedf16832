#pragma once
// Scans in, poses out: pairs, their quality, one adjustment. The engine behind it may change; this interface stays.

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/foundation/finding.h"
#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/geometry/tile_source.h"
#include "core/georeference/camera_rig.h"
#include "core/georeference/control.h"
#include "core/registration/icp_options.h"
#include "core/registration/ndt_options.h"

namespace adit {

/// What refines a pair after the normal distributions transform.
enum class Refinement {
  surfaces,  ///< both scans' surfaces by moving least squares (surface_match.h)
  points     ///< iterative closest point by the stages of IcpOptions
};

struct RegistrationOptions {
  double spacing_m = 0.10;        ///< even subsample used for matching
  double cell_m = 4.0;            ///< coarsest cells of the normal distributions transform; finer ones follow
  double pair_distance_m = 35.0;  ///< stations farther apart are not paired
  double least_overlap = 0.15;    ///< pairs with less overlap are not used
  double guess_sigma_m = 0.5;     ///< how far guesses may be off (one sigma)
  double guess_sigma_deg = 2.0;
  double control_sigma_m = 0.002;      ///< of a target against its control point, per axis
  double pair_sigma_m = 0.0001;        ///< least sigma of a pair: what its measured scatter leaves out
  double undetermined_sigma_m = 0.02;  ///< a direction weaker than this is named and held at its prior
  NdtSources ndt_sources = NdtSources::distributions;
  Refinement refinement = Refinement::surfaces;
  IcpOptions icp;  ///< where points refine; a group of options of its own
};

template <typename Visitor>
void describe(Visitor& v, RegistrationOptions& o) {
  v.number("spacing_m", o.spacing_m, "m", 0.01, 1.0, "even subsample used for matching");
  v.number("cell_m", o.cell_m, "m", 0.2, 10.0, "coarsest cells of the normal distributions transform");
  v.number("pair_distance_m", o.pair_distance_m, "m", 1.0, 200.0, "stations farther apart are not paired");
  v.number("least_overlap", o.least_overlap, "", 0.01, 0.95, "pairs with less overlap are not used");
  v.number("guess_sigma_m", o.guess_sigma_m, "m", 0.001, 10.0, "how far guessed positions may be off (one sigma)");
  v.number("guess_sigma_deg", o.guess_sigma_deg, "deg", 0.01, 20.0,
           "how far guessed directions may be off (one sigma)");
  v.number("control_sigma_m", o.control_sigma_m, "m", 0.0001, 0.1, "noise of a target against its control point");
  v.number("pair_sigma_m", o.pair_sigma_m, "m", 0.0, 0.1,
           "least sigma of a pair: what its measured scatter leaves out");
  v.number("undetermined_sigma_m", o.undetermined_sigma_m, "m", 0.002, 0.1,
           "a direction weaker than this is named and held at its prior");
  visit_choice(v, "ndt_sources", o.ndt_sources, {"distributions", "points"},
               "what of one scan is laid on the distributions of the other by the normal distributions transform");
  visit_choice(v, "refinement", o.refinement, {"surfaces", "points"},
               "what refines a pair: the surfaces of both scans, or iterative closest point by the options of icp");
}

/// Turns count where walls stand, about so far from a scanner.
inline constexpr double wall_lever_m = 5.0;

/// One scan to be placed. Frames: scan frame, and the local frame (site minus project origin).
struct ScanToPlace {
  std::string name;
  std::shared_ptr<const TileSource> points;
  std::optional<Pose> local_from_scan_guess;
  bool scanner_at_origin = true;  ///< false: the file does not say where the scanner stood; ranges are not limited
};

/// Standard deviations in tunnel axes.
struct PoseSigma {
  double along_m = 0.0;
  double across_m = 0.0;
  double up_m = 0.0;
  double roll_rad = 0.0;   ///< about the tunnel axis
  double pitch_rad = 0.0;  ///< about the axis across
  double yaw_rad = 0.0;    ///< about the vertical
};

/// A stretch of the tunnel, along its axis.
struct Stretch {
  double from_m = 0.0;
  double to_m = 0.0;
  bool is_empty() const { return to_m <= from_m; }
};

/// Whether a place stands in one of them.
inline bool is_in(double along_m, std::span<const Stretch> stretches) {
  return std::any_of(stretches.begin(), stretches.end(),
                     [&](const Stretch& s) { return along_m >= s.from_m && along_m < s.to_m; });
}

/// How two scans fit. Transform and sigma are those of the pair alone, before the adjustment.
struct PairResult {
  std::string source;
  std::string target;
  Pose target_from_source = Pose::Identity();
  double overlap = 0.0;            ///< share of the source's subsample that lies within reach of the target
  double rms_m = 0.0;              ///< point-to-plane residuals in the overlap
  double median_m = 0.0;           ///< median absolute point-to-plane residual
  double median_distance_m = 0.0;  ///< median distance of nearest points in the overlap
  double within_6mm = 0.0;         ///< share of residuals under 6 mm
  Eigen::Vector3d balance = Eigen::Vector3d::Zero();  ///< how much of the overlap faces along, across and up: sums to 1
  double agreeing = 0.0;  ///< share of either scan's points on the other's surface, where that shows one or saw through
  double seen_through = 0.0;  ///< share of them where the other scanner saw through
  double noise_m = 0.0;       ///< of the noisier scan; 0: not known
  double scale = 1.0;         ///< how many times the source is too small against the target, were it free to grow
  double scale_sigma = 0.0;
  int iterations = 0;    ///< of the normal distributions transform
  double seconds = 0.0;  ///< it took to match, by the context's clock; 0 without, and when an earlier run did
  PoseSigma sigma;
  /// Of "along", "across", "up", "roll", "pitch", "yaw" those that the clouds do not tell; held at the guess.
  std::vector<std::string> undetermined;
  /// How far along the tunnel from here it fits as well (ribs and rings repeat), so that "along" is undetermined; 0:
  /// nowhere near.
  double alike_m = 0.0;
  /// Where something has moved along the tunnel between the scans, from the target: it was left out. By how far, as the
  /// source saw it.
  std::vector<Stretch> moved;
  double moved_m = 0.0;
  /// Where the only place stands that tells "along", from the target along the tunnel: nothing bears it out, so that
  /// "along" is undetermined. Empty where more than one does.
  Stretch lone_witness;
  bool used = true;     ///< in the adjustment
  std::string why_not;  ///< in words, when it is not used
  Matrix6d information =
      Matrix6d::Zero();  ///< of (rotation [rad], translation [m]) in the target's frame at the source's origin
};

/// Where a scan stands after the adjustment.
struct PlacedScan {
  std::string name;
  bool placed = false;
  Pose local_from_scan = Pose::Identity();
  PoseSigma sigma;
  /// "clouds", "control", "pictures" or what of them there is, joined by "and"; "guess", "datum", "not placed"
  std::string placed_by;
  std::vector<std::string> undetermined;
};

/// Pairs around a loop of scans: what their transforms leave open, each pair alone and after all were refined together.
struct LoopClosure {
  std::vector<std::string> scans;
  double before_m = 0.0;
  double before_rad = 0.0;
  double after_m = 0.0;
  double after_rad = 0.0;
};

/// What is left of a picture after the adjustment, and what it said.
struct PictureResult {
  std::string scan;
  std::string picture;
  std::string camera;
  bool located = false;  ///< the targets in it say where the camera stood
  bool used = false;     ///< in the adjustment
  Pose local_from_camera = Pose::Identity();
  double sigma_m = 0.0;                                  ///< of that place, the greatest of its axes
  double sigma_rad = 0.0;                                ///< of its turns likewise
  Eigen::Vector3d residual_m = Eigen::Vector3d::Zero();  ///< picture less adjusted, site axes
  Eigen::Vector3d turned_rad = Eigen::Vector3d::Zero();  ///< likewise, as a rotation vector
  double normalised = 0.0;                               ///< root of a sixth of their squares in sigmas: 1 is expected
  std::vector<std::string> targets;                      ///< ids that were used to locate it
  std::vector<std::string> rejected;                     ///< ids whose places contradict these
  std::vector<std::string> unknown;                      ///< ids nobody surveyed
  double rms_px = 0.0;
};

/// Where a camera sits on the scanner, after the adjustment.
struct CameraResult {
  std::string camera;
  Pose scan_from_camera = Pose::Identity();
  double moved_m = 0.0;  ///< from where it was said to sit
  double moved_rad = 0.0;
  double normalised = 0.0;  ///< root of a sixth of the move's squares in sigmas
};

struct RegistrationResult {
  bool accepted =
      false;  ///< no finding needs a decision: every scan placed, every direction determined, nothing contradicts
  std::vector<PlacedScan> scans;
  std::vector<PairResult> pairs;
  std::vector<LoopClosure> loops;
  std::vector<ControlResidual> control;
  double control_rms_m = 0.0;
  std::vector<PictureResult> pictures;
  std::vector<CameraResult> cameras;
  /// By how much observations contradict one another beyond their sigmas: the root of the variance factor (sum of
  /// squares in sigmas over redundancy), 1 at least. The sigmas of the scans are already multiplied by it.
  double sigma_factor = 1.0;
  /// How well the whole survey stands in the site frame, beside the sigmas of the scans, which are relative to the
  /// datum: zero with control or pictures; without, what the guess of the datum scan is worth (position, and direction
  /// over half the span).
  double datum_sigma_m = 0.0;
  /// The scan whose pose the survey hangs on without control; empty with it.
  std::string datum_scan;
  /// False where nothing ties the survey to the site, neither control, pictures nor a guess: poses are in the datum
  /// scan's frame.
  bool in_site = true;
  Findings findings;
};

/// What is known beside the clouds.
struct RegistrationContext {
  std::vector<ControlPoint> control;       ///< local frame (site minus origin)
  std::vector<TargetObservation> targets;  ///< scan frames
  std::vector<RigCamera> cameras;
  std::vector<CameraSight> pictures;
  /// Unit direction of the tunnel axis in the local frame near a point; empty: taken from the clouds.
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> axis_direction;
  std::function<double()> clock_s;  ///< for how long pairs take; empty: not measured
};

/// Places all scans. Longest gap between two checks for cancel: summing up a few tiles (about 0.1 s).
/// Throws Error for contradictions in the input (a target without its control point, a picture of no scan, no scan).
RegistrationResult register_scans(const std::vector<ScanToPlace>& scans, const RegistrationContext& context,
                                  const RegistrationOptions& options, Progress& progress);

}  // namespace adit
