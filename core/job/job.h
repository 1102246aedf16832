#pragma once
// What is to be done: the content of job.json, checked. Plain values.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/design/tolerances.h"
#include "core/geometry/pose.h"
#include "core/job/import_options.h"
#include "core/profiling/map_change.h"
#include "core/profiling/profiling.h"
#include "core/profiling/reason_zones.h"
#include "core/profiling/rings.h"
#include "core/registration/registration.h"
#include "core/surface/surface_options.h"

namespace adit {

/// A picture that a camera on the scanner took during a scan.
struct JobPicture {
  std::string file;    ///< relative to the job's folder
  std::string camera;  ///< empty: the only one
};

/// A camera fixed to the scanner.
struct JobCamera {
  std::string name;
  std::string file;                                    ///< its calibration
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the scanner's frame: its centre of projection
  YawPitchRoll angles;                                 ///< of lever_arm
  double sigma_m = 0.002;
  double sigma_rad = 0.0005;
};

/// Coded targets in the tunnel.
struct JobLandmarks {
  std::string file;        ///< empty: none
  double sigma_m = 0.003;  ///< of each coordinate
  bool no_others = false;  ///< none but these hang there, so that partly hidden ones can be read, too
};

/// Targets to be looked for in the scans.
struct JobScanTargets {
  double sphere_diameter_m = 0.0;  ///< 0: no spheres
  bool quarters = false;
  bool coded = false;
  bool any() const { return sphere_diameter_m > 0.0 || quarters || coded; }
};

struct JobScan {
  std::string name;
  std::string file;                         ///< relative to the job's folder
  int number = 0;                           ///< which scan of the file, from 1; 0: the only one
  std::optional<Eigen::Vector3d> position;  ///< site, guess
  YawPitchRoll angles;
  std::vector<JobPicture> pictures{};
};

/// A file, or a profile of the library.
struct JobProfile {
  double from_m = 0.0;
  std::string file;
  std::string layer;                    ///< of a DXF; empty: the only closed line
  std::string library;                  ///< its name, when there is no file
  std::map<std::string, double> sizes;  ///< of the library's profile, or of a JSON file
  bool interpolated = false;            ///< up to the next profile, instead of stepped
};

struct JobRound {
  int number = 0;
  double from_m = 0.0;
  double to_m = 0.0;
  double drilled_m = 0.0;  ///< 0 when not stated
};

struct JobChainage {
  double from_m = 0.0;
  double to_m = 0.0;
  double interval_m = 1.0;
};

/// A set of tolerances, and which rock class holds where.
struct JobTolerances {
  std::string file;     ///< or ...
  std::string library;  ///< ... a set of the library by its name
  std::vector<RockClassFrom> rock_classes;
};

/// An earlier job of the same tunnel, run and placed in the site.
struct JobBefore {
  std::string job;  ///< its job.json or folder, relative to this job's folder
  std::string out;  ///< its folder of derived files, relative likewise; empty: beside its job.json
  LayerDesign layer;
};

/// A straightedge to be laid on the surface.
struct JobStraightedge {
  double length_m = 3.0;
  double limit_ratio = 0.0;  ///< depth over length of gap; 0: no limit
};

/// Rings measured by total station.
struct JobRings {
  std::string file;
  double target_offset_m = 0.0;  ///< of points whose file states none
  RingDesign design;
};

struct JobOptions {
  ImportOptions import;
  RegistrationOptions registration;
  ProfilingOptions profiling;
  SurfaceOptions surface;
};

/// Calls visit(group name, options struct) for every group: the one list of option groups.
template <typename Options, typename Visit>
void for_each_group(Options& options, const Visit& visit) {
  visit("import", options.import);
  visit("registration", options.registration);
  visit("icp", options.registration.icp);
  visit("profiling", options.profiling);
  visit("surface", options.surface);
}

/// Which planes sections lie in; "both": vertical ones for all numbers, and square ones beside them.
enum class JobSections { vertical, square, both };

struct Job {
  std::string name;
  std::string client;
  std::string surveyor;
  std::vector<JobScan> scans;
  std::string control;  ///< files; empty: none
  std::string targets;
  JobScanTargets scan_targets;
  std::vector<JobCamera> cameras;
  JobLandmarks landmarks;
  std::string alignment;
  std::string alignment_name;               ///< when the file holds several
  std::optional<double> alignment_start_m;  ///< chainage of its first point, for formats that state none
  std::vector<JobProfile> profiles;
  bool turned_by_cant = false;  ///< profiles turn with the axis's cant
  std::vector<DesignLine> lines{{"excavation", 0.0}};
  std::optional<JobChainage> chainage;
  JobSections sections = JobSections::vertical;
  std::vector<JobRound> rounds;
  bool driven_up_chainage = true;  ///< rounds, faces and look-out go up-chainage
  std::vector<ReasonZone> zones;
  std::optional<JobTolerances> tolerances;
  std::optional<JobBefore> before;
  bool face = false;  ///< the face is looked for, here and in the earlier job
  std::optional<JobStraightedge> straightedge;
  std::vector<Sector> sectors = standard_sectors();
  double swell = 0.0;  ///< loose over bank volume; 0: not stated
  std::optional<JobRings> rings;
  JobOptions options;
};

}  // namespace adit
