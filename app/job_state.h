#pragma once
// All that a run holds in memory: the job, what its files say, and what the steps have made so far.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/landmarks.h"
#include "core/design/design_tunnel.h"
#include "core/georeference/camera_lens.h"
#include "core/georeference/control.h"
#include "core/job/job.h"
#include "core/job/results.h"
#include "core/profiling/deviation_map.h"
#include "core/simulation/truth.h"
#include "io/file_stamp.h"
#include "io/mesh_ply.h"
#include "io/point_store.h"

namespace adit::app {

struct JobState {
  Job job;
  std::filesystem::path file;    ///< job.json itself
  std::filesystem::path folder;  ///< of job.json
  std::filesystem::path out;     ///< of everything derived

  std::uint64_t memory_bytes = std::uint64_t{4} << 30;  ///< budget for points on their way

  // What the input files say (site coordinates).
  std::map<std::string, std::string> input_sha256;   ///< by the name in job.json
  std::map<std::string, io::FileStamp> input_stamp;  ///< of the same files when they were hashed
  std::optional<Alignment> alignment;
  std::vector<ProfileFrom> profiles;
  std::vector<ControlPoint> control;
  std::vector<TargetObservation> targets;
  std::vector<CameraLens> lenses;  ///< of the job's cameras
  Landmarks landmarks;
  std::vector<RingPoint> ring_points;
  std::optional<ToleranceSet> tolerances;
  std::string before_key;      ///< of the earlier job's poses, as its last run left them
  std::optional<Truth> truth;  ///< of a simulated job
  Findings input_findings;

  // What the steps made.
  Results results;
  std::vector<std::shared_ptr<io::PointStore>> stores;  ///< in the order of the job's scans
  std::optional<DesignTunnel> design;                   ///< local frame
  std::optional<DeviationMap> map;
  std::optional<DeviationMap> square_map;  ///< where the job asks for both planes
  std::optional<io::MeshFile> mesh;        ///< local frame
  std::optional<DeviationMap> change;      ///< thickness between the earlier job and this one

  /// Where the steps' keys stand: by name of the step.
  std::map<std::string, std::string> keys;

  bool has_scans() const { return !job.scans.empty(); }
  bool has_design() const { return alignment.has_value() && !profiles.empty(); }
  /// All that the design's profiles depend on, for the keys of steps.
  std::string profiles_text() const;
  /// Stretch to profile: the job's, or the whole axis.
  JobChainage stretch() const;
};

/// The job.json of the earlier job, and its folder of derived files. Only for a job that names one.
std::filesystem::path before_file(const JobState& state);
std::filesystem::path before_out(const JobState& state);

/// Reads job.json and the small files it names, and hashes all of them. Throws Error for anything broken, before any
/// long work begins: a chainage outside the axis, a profile that crosses itself, a target without a scan.
/// earlier: whether the earlier job is opened, too, to see what this one's comparison rests on.
enum class Earlier { looked_at, left_alone };
JobState open_job(const std::filesystem::path& job_file, const std::filesystem::path& out, Progress& progress,
                  Earlier earlier = Earlier::looked_at);

}  // namespace adit::app
