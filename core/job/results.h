#pragma once
// What came out of a job, per step, with its findings: the content of results.json. Plain values.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/foundation/finding.h"
#include "core/georeference/project_origin.h"
#include "core/georeference/scan_targets.h"
#include "core/profiling/clearance.h"
#include "core/profiling/face_volume.h"
#include "core/profiling/map_change.h"
#include "core/profiling/profiling.h"
#include "core/profiling/reason_zones.h"
#include "core/profiling/rings.h"
#include "core/profiling/tolerance_check.h"
#include "core/profiling/undulation.h"
#include "core/registration/registration.h"
#include "core/surface/mesh_summary.h"

namespace adit {

/// A file the job read, named as in job.json.
struct InputRecord {
  std::string file;
  std::string sha256;
  std::uint64_t points = 0;  ///< 0 for files that are not scans
};

/// A scan after import, in the order of the job.
struct ImportedScan {
  std::string name;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< file coordinates = stored point + offset
  std::uint64_t points = 0;
  std::uint64_t no_returns = 0;  ///< pulses without an echo, left out
};

struct ImportResult {
  std::vector<InputRecord> inputs;
  std::vector<ImportedScan> scans;
  ProjectOrigin origin;
  Findings findings;
};

/// A target that was found in a scan, and the control point it is.
struct FoundTarget {
  std::string scan;
  TargetKind kind = TargetKind::sphere;
  std::string id;                                      ///< of its control point; empty: none
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the coordinates of the scan's file
  double sigma_m = 0.0;
  double size_m = 0.0;
  int pixels = 0;
};

/// What one picture says, before the adjustment. Local frame.
struct LocatedPicture {
  PictureResult result;
  CameraSight sight;               ///< where result.located
  double by_focal_length_m = 0.0;  ///< what one sigma of the focal length moves the camera; not in the sight
};

struct TargetsResult {
  bool looked_in_scans = false;
  std::vector<FoundTarget> found;
  std::vector<LocatedPicture> pictures;  ///< in the job's order
  Findings findings;
};

struct SurfaceResult {
  MeshSummary mesh;
  Findings findings;
};

struct ProfileResult {
  std::uint64_t points_used = 0;
  std::uint64_t points_inside = 0;
  std::uint64_t points_outside = 0;
  std::vector<Section> sections;
  std::vector<Section> square_sections;     ///< at the same chainages, where the job asks for both
  std::vector<ClearanceResult> clearances;  ///< one for each clearance line; without their lists of points
  Findings findings;
};

/// The map against a set of tolerances.
struct ToleranceResult {
  std::string set;
  std::string source;
  std::string verified_by;  ///< empty: nobody
  std::vector<ToleranceCheck> checks;
};

struct VolumeResult {
  std::vector<Volume> lines;  ///< one for each design line, the first is the reference
  std::vector<RoundVolume> rounds;
  std::vector<ZoneVolume> zones;  ///< against the reference line
  ToleranceResult tolerances;     ///< set is empty where the job asks for none
  Findings findings;
};

/// The job's surface against an earlier one, its face, and how even it is: what the job asks for of that.
struct CompareResult {
  std::string before;   ///< name of the earlier job; empty: none
  FaceMap face_before;  ///< without cells: not asked for, or not seen
  FaceMap face;
  FaceVolume between;      ///< whole only where both faces were seen
  int round = 0;           ///< the round between the faces ...
  double drilled_m = 0.0;  ///< ... and its drilled length; 0: not stated
  RockLeft left;
  LayerResult layer;  ///< measured_m2 is 0 without an earlier job
  ChangeResult change;
  UndulationResult undulation;  ///< straightedge_m is 0 where none is asked for
  Findings findings;
};

/// Errors of a simulated job against its exact truth. What could not be compared (another stretch, a step that has not
/// run) is not a number.
struct TruthComparison {
  static constexpr double not_compared = std::numeric_limits<double>::quiet_NaN();
  double worst_position_error_m = 0.0;
  double worst_rotation_error_rad = 0.0;
  VolumeAmounts true_volume;
  double excavated_error = not_compared;  ///< relative
  double overbreak_error = not_compared;  ///< relative
  double underbreak_error_m3 = not_compared;
  double section_area_rms = not_compared;  ///< relative, over all sections
};

struct StepTime {
  std::string step;
  double seconds = 0.0;
  bool fresh = false;  ///< true when nothing had changed and the step did not run
};

struct Results {
  std::string version;
  ImportResult import;
  TargetsResult targets;
  RegistrationResult registration;
  std::optional<SurfaceResult> surface;
  std::optional<ProfileResult> profile;
  std::optional<VolumeResult> volume;
  std::optional<CompareResult> compare;
  std::optional<RingsResult> rings;
  std::optional<TruthComparison> truth;
  Findings earlier;  ///< files of earlier runs that do not show these numbers
  std::vector<StepTime> timing;
  std::uint64_t peak_memory_bytes = 0;
};

/// site-from-scan of a placed scan, for the coordinates of its file.
Pose site_from_scan(const Results& results, std::size_t scan);

/// Every finding of every step, in order of the steps.
Findings all_findings(const Results& results);

/// True when a person must look: exit code 1.
bool needs_a_person(const Results& results);

}  // namespace adit
