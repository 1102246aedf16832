#include "app/demo.h"

#include <cmath>
#include <string>
#include <vector>

#include "app/demo_pictures.h"
#include "app/demo_targets.h"
#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/job/job.h"
#include "core/simulation/ray_cast.h"
#include "core/simulation/scanner.h"
#include "core/simulation/truth.h"
#include "io/atomic_file.h"
#include "io/control_csv.h"
#include "io/dxf.h"
#include "io/job_json.h"
#include "io/landxml.h"
#include "io/scan_formats.h"
#include "io/scan_writer.h"
#include "io/spool_file.h"
#include "io/targets_csv.h"
#include "io/truth_json.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;

constexpr double axis_start_m = 1000.0;
constexpr double first_station_m = 1050.0;
constexpr double station_spacing_m = 13.0;
constexpr double round_length_m = 4.0;
constexpr double first_round_m = 1000.4;  // rounds begin between the whole metres where sections stand
constexpr double curve_radius_m = 250.0;
constexpr double grade = 0.025;

HorizontalElement next_element(const HorizontalElement& before, HorizontalKind kind, double length_m, double from_k,
                               double to_k) {
  const PlanPoint end = element_point(before, before.length_m);
  HorizontalElement element;
  element.kind = kind;
  element.start = end.position;
  element.azimuth_rad = end.azimuth_rad;
  element.length_m = length_m;
  element.start_curvature_per_m = from_k;
  element.end_curvature_per_m = to_k;
  return element;
}

/// A straight, a clothoid and an arc to the right, rising.
Alignment demo_axis(const DemoOptions& options, double length_m) {
  HorizontalElement line;
  line.start = {options.east_m, options.north_m};
  line.azimuth_rad = rad_from_deg(38.0);
  line.length_m = 60.0;
  std::vector<HorizontalElement> elements{line};
  elements.push_back(next_element(elements.back(), HorizontalKind::clothoid, 40.0, 0.0, 1.0 / curve_radius_m));
  elements.push_back(
      next_element(elements.back(), HorizontalKind::arc, length_m - 100.0, 1.0 / curve_radius_m, 1.0 / curve_radius_m));
  VerticalPoint begin, end;
  begin.chainage_m = axis_start_m;
  begin.elevation_m = options.elevation_m;
  end.chainage_m = axis_start_m + length_m;
  end.elevation_m = options.elevation_m + grade * length_m;
  return {"demo tunnel", HorizontalAlignment(elements, axis_start_m), VerticalAlignment({begin, end})};
}

/// Walls of 2 m under a half circle of 4.5 m radius.
Profile demo_profile() {
  constexpr double half_m = 4.5, wall_m = 2.0;
  return {"demo profile",
          {{{-half_m, 0.0}, {-half_m, wall_m}, 0.0},
           {{-half_m, wall_m}, {half_m, wall_m}, -1.0},
           {{half_m, wall_m}, {half_m, 0.0}, 0.0},
           {{half_m, 0.0}, {-half_m, 0.0}, 0.0}}};
}

struct Demo {
  DemoOptions options;
  Alignment axis;     ///< site
  RockTunnel tunnel;  ///< local frame
  Eigen::Vector3d origin;
  double last_station_m;
  JobChainage stretch;
  std::vector<ScannedTarget> targets;  ///< that the scanners see; local frame
};

Demo plan_demo(const DemoOptions& options) {
  const double last_station = first_station_m + station_spacing_m * (options.stations - 1);
  const double face = last_station + 20.0 - round_length_m * options.rounds_back;
  Alignment axis = demo_axis(options, last_station + 100.0 - axis_start_m);
  const Eigen::Vector3d origin = Eigen::Vector3d(options.east_m, options.north_m, options.elevation_m).array().round();
  RockTunnelOptions rock;
  rock.seed = options.seed;
  rock.from_m = axis_start_m + 1.0;
  rock.face_m = face;
  rock.first_round_m = first_round_m;
  rock.round_length_m = round_length_m;
  DesignTunnel design = DesignTunnel(axis, {{axis_start_m, demo_profile()}}, {DesignLine{}}).relative_to(origin);
  Demo demo{options, axis,         RockTunnel(std::move(design), rock),
            origin,  last_station, {first_station_m - 2.0, last_station + 6.0, 1.0},
            {}};
  if (options.scan_targets) demo.targets = hung_scan_targets(demo.tunnel, demo.stretch.from_m, face - 1.0);
  return demo;
}

Pose true_pose(const Demo& demo, int station) {
  const Random random(demo.options.seed, 500 + static_cast<std::uint64_t>(station));
  const double s = first_station_m + station_spacing_m * station;
  const double x = (station % 2 == 0 ? -0.7 : 0.8) + 0.2 * random.uniform(0, -1, 1);
  const Eigen::Vector3d position = demo.tunnel.design().alignment().to_site({s, x, 1.65 + 0.1 * random.uniform(1)});
  double yaw_rad = random.uniform(2, -pi, pi);
  if (demo.options.pictures_in) {  // a camera is turned to where it sees most
    const Eigen::Vector2d ahead = demo.tunnel.design().alignment().horizontal().at(s).tangent();
    yaw_rad = std::atan2(ahead.y(), ahead.x()) + 0.04 * yaw_rad;
  }
  return make_pose(position,
                   {yaw_rad, rad_from_deg(random.uniform(3, -0.5, 0.5)), rad_from_deg(random.uniform(4, -0.5, 0.5))});
}

/// The true pose moved and turned by exactly the guess errors, in a random direction.
Pose guessed_pose(const Demo& demo, const Pose& pose, int station) {
  const Random random(demo.options.seed, 900 + static_cast<std::uint64_t>(station));
  const Eigen::Vector3d direction(random.normal(0), random.normal(1), 0.3 * random.normal(2));
  const Eigen::Vector3d axis(0.3 * random.normal(3), 0.3 * random.normal(4), random.normal(5));
  Pose guess = pose;
  guess.linear() = rotation_from_vector(axis.normalized() * rad_from_deg(demo.options.guess_error_deg)) * pose.linear();
  guess.translation() += demo.options.guess_error_m * direction.normalized();
  return guess;
}

/// Targets on the rock, 5 cm in front of it, left wall, right wall and crown in turn.
std::vector<ControlPoint> true_control(const Demo& demo) {
  std::vector<ControlPoint> points;
  const double places[] = {-9.2, 8.6, -4.1, 4.6, 9.4};
  int i = 0;
  for (double s = demo.stretch.from_m - 3.0; s < demo.stretch.to_m + 2.0; s += 4.7, ++i) {
    const ProfilePoint at = demo.tunnel.profile().at(places[i % 5]);
    const Eigen::Vector2d place = at.position + (demo.tunnel.deviation(s, at.p_m) - 0.05) * at.normal;
    points.push_back(
        {"T" + std::to_string(101 + i), demo.tunnel.design().alignment().to_site({s, place.x(), place.y()})});
  }
  return points;
}

bool sees(const Demo& demo, const Pose& pose, const Eigen::Vector3d& target) {
  const Eigen::Vector3d ray = target - pose.translation();
  if (ray.norm() > 18.0) return false;
  const auto hit = RayCast(demo.tunnel).first_hit(pose.translation(), ray.normalized(), 45.0, {});
  return hit && hit->range_m > ray.norm() - 0.02;
}

void write_control(const Demo& demo, const std::vector<Pose>& poses, const fs::path& folder) {
  const std::vector<ControlPoint> truth = true_control(demo);
  const Random random(demo.options.seed, 1500);
  std::vector<ControlPoint> surveyed;
  std::vector<TargetObservation> targets;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const Eigen::Vector3d noise(random.normal(3 * k), random.normal(3 * k + 1), random.normal(3 * k + 2));
    surveyed.push_back({truth[k].id, truth[k].position + demo.origin + 0.0007 * noise});
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!sees(demo, poses[i], truth[k].position)) continue;
      const std::uint64_t n = 10000 + 3 * (1000 * i + k);
      const Eigen::Vector3d seen_noise(random.normal(n), random.normal(n + 1), random.normal(n + 2));
      targets.push_back(
          {"S" + std::to_string(i + 1), truth[k].id, poses[i].inverse() * truth[k].position + 0.001 * seen_noise});
    }
  }
  io::write_file_atomically(folder / "control.csv", io::control_csv_text(surveyed));
  io::write_file_atomically(folder / "targets.csv", io::targets_csv_text(targets));
}

/// Streams a simulated scan into a sink, in blocks.
void simulate_scan(const Demo& demo, const Pose& pose, int station, io::ScanSink& sink, Progress& progress) {
  ScannerOptions scanner;
  scanner.seed = demo.options.seed * 1000 + static_cast<std::uint64_t>(station);
  scanner.pulses = demo.options.points;
  scanner.targets = demo.targets;
  const double s = first_station_m + station_spacing_m * station;
  // People walk between the scans.
  const std::vector<Eigen::Vector2d> people{{s + 4.5, 1.9}, {s - 6.0, -2.4}, {s + 9.0, -0.3 * station}};
  io::PointBlock block;
  const auto hand_out = [&] {
    if (!block.empty()) sink.take(block);
    block.clear();
  };
  const auto take = [&](const PointCloud& part) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      block.positions.push_back(part.points[i].cast<double>());
      block.intensity.push_back(part.intensity[i]);
      if (block.size() == io::PointBlock::most_points) hand_out();
    }
  };
  scan_tunnel(std::span(&demo.tunnel, 1), pose, scanner, people, take, progress);
  hand_out();
}

/// Keeps a scan's points on disk until they are counted: headers stand before the points.
class Spooling : public io::FactsSink {
 public:
  explicit Spooling(const fs::path& folder) : spool_(folder) {}
  void take(io::PointBlock& block) override {
    FactsSink::take(block);
    const std::size_t n = block.size();
    blocks_.push_back({n, spool_.append(block.positions.data(), n * sizeof(Eigen::Vector3d)),
                       spool_.append(block.intensity.data(), n * sizeof(float))});
  }
  void replay(io::ScanSink& to, const Progress& progress) const {
    io::PointBlock block;
    for (const Block& from : blocks_) {
      progress.check();
      block.positions.resize(from.points);
      block.intensity.resize(from.points);
      spool_.read(from.positions_at, block.positions.data(), from.points * sizeof(Eigen::Vector3d));
      spool_.read(from.intensity_at, block.intensity.data(), from.points * sizeof(float));
      to.take(block);
    }
  }

 private:
  struct Block {
    std::size_t points;
    std::uint64_t positions_at;
    std::uint64_t intensity_at;
  };
  io::SpoolFile spool_;
  std::vector<Block> blocks_;
};

void write_scan(const Demo& demo, const Pose& pose, int station, const fs::path& folder, Progress& progress) {
  io::ScanHeader header;
  header.name = "S" + std::to_string(station + 1);
  header.where = "station " + header.name;
  header.attributes.intensity = true;
  Spooling points(folder / "scans");
  Progress casting = progress.part(0.95, "scanning at station " + header.name);
  points.begin(header);
  simulate_scan(demo, pose, station, points, casting);
  points.end(0);
  Progress writing = progress.part(0.05, "writing " + header.name);
  const auto writer = io::make_scan_writer(folder / "scans" / (header.name + ".ply"), points.scans, {});
  writer->begin(header);
  points.replay(*writer, writing);
  writer->end(0);
  writer->commit();
}

Job demo_job(const Demo& demo, const std::vector<Pose>& poses) {
  Job job;
  job.name = "Synthetic tunnel, seed " + std::to_string(demo.options.seed);
  job.client = "nobody: this job is simulated";
  job.surveyor = "adit demo";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string name = "S" + std::to_string(i + 1);
    const Pose guess = guessed_pose(demo, poses[i], static_cast<int>(i));
    job.scans.push_back(
        {name, "scans/" + name + ".ply", 0, guess.translation() + demo.origin, yaw_pitch_roll(guess), {}});
  }
  if (demo.options.control) {
    job.control = "control.csv";
    job.targets = "targets.csv";
  }
  job.alignment = "axis.xml";
  job.profiles.emplace_back();
  job.profiles.back().from_m = axis_start_m;
  job.profiles.back().file = "profile.dxf";
  job.lines = {{"excavation", 0.0}, {"pay", 0.25}};
  job.chainage = demo.stretch;
  int number = 100;
  for (double s = first_round_m; s + round_length_m <= demo.stretch.to_m; s += round_length_m, ++number)
    if (s >= demo.stretch.from_m) job.rounds.push_back({number, s, s + round_length_m, round_length_m + 0.2});
  if (demo.options.before.empty()) return job;
  job.before = JobBefore{demo.options.before, {}, {}};
  job.face = true;
  const double face_m = demo.tunnel.options().face_m;
  job.rounds.push_back({number, face_m - round_length_m, face_m, round_length_m + 0.2});
  return job;
}

void take_pictures(const Demo& demo, const std::vector<Pose>& poses, const fs::path& folder, Job& job,
                   Progress& progress) {
  const auto context = demo.options.pictures_in();
  context->make_current();
  Progress taking = progress.part(0.2, "taking pictures");
  write_demo_pictures({demo.tunnel, demo.origin, demo.stretch.from_m + 4.0, demo.tunnel.options().face_m - 1.0, poses,
                       demo.options.seed},
                      folder, job, taking);
}

Truth demo_truth(const Demo& demo, const std::vector<Pose>& poses, Progress& progress) {
  Truth truth;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    truth.scan_names.push_back("S" + std::to_string(i + 1));
    truth.site_from_scan.push_back(poses[i]);
    truth.site_from_scan.back().translation() += demo.origin;
  }
  truth.face_chainage_m = true_face_chainage(demo.tunnel);
  truth.from_m = demo.stretch.from_m;
  truth.to_m = demo.stretch.to_m;
  truth.volume = true_volume(demo.tunnel, truth.from_m, truth.to_m, progress);
  for (const double s : section_chainages(truth.from_m, truth.to_m, demo.stretch.interval_m))
    truth.sections.push_back(true_section(demo.tunnel, s));
  return truth;
}

void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) throw Error("this is a file", folder.string(), "name a folder");
  io::remove_leftovers(folder);
  const bool empty = fs::is_empty(folder, error);
  if (error) throw Error("the folder cannot be read: " + error.message(), folder.string(), "name another");
  if (empty || fs::exists(folder / "truth.json", error)) return;
  throw Error("the folder is not empty and holds no demo", folder.string(), "name a new folder");
}

}  // namespace

void make_demo(const fs::path& folder, const DemoOptions& options, Progress& progress) {
  check_folder(folder);
  Progress planning = progress.part(0.05, "planning the tunnel");
  planning.check();
  const Demo demo = plan_demo(options);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error("the folder cannot be made: " + error.message(), folder.string(), "choose another");
  std::vector<Pose> poses;
  for (int i = 0; i < options.stations; ++i) poses.push_back(true_pose(demo, i));
  // The truth first, the job last: a demo that was cut short is known as one and has nothing to run.
  Progress truth = progress.part(0.05, "writing the truth");
  io::write_file_atomically(folder / "truth.json", io::truth_text(demo_truth(demo, poses, truth)));
  fs::remove(folder / "job.json", error);
  fs::create_directories(folder / "scans", error);
  io::remove_leftovers(folder / "scans");
  Progress scanning = progress.part(options.pictures_in ? 0.7 : 0.9, "scanning");
  for (int i = 0; i < options.stations; ++i) {
    Progress part = scanning.part(1.0 / options.stations, "scanning");
    write_scan(demo, poses[static_cast<std::size_t>(i)], i, folder, part);
  }
  io::write_file_atomically(folder / "axis.xml", io::landxml_text(demo.axis));
  io::write_dxf_profile(folder / "profile.dxf", demo.tunnel.profile());
  if (options.control && !options.scan_targets) write_control(demo, poses, folder);
  Job job = demo_job(demo, poses);
  if (options.scan_targets) write_scan_targets(demo.targets, demo.origin, options.seed, folder, job);
  if (options.pictures_in) take_pictures(demo, poses, folder, job, progress);
  io::write_file_atomically(folder / "job.json", io::job_text(job));
}

}  // namespace adit::app
