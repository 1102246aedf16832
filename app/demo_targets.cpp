#include "app/demo_targets.h"

#include <string>

#include "core/foundation/random.h"
#include "core/simulation/rock_mesh.h"
#include "io/atomic_file.h"
#include "io/control_csv.h"

namespace adit::app {
namespace {

constexpr double sphere_radius_m = 0.0725, board_radius_m = 0.15;
constexpr int first_code_id = 1;

std::string name_of(const ScannedTarget& target, std::size_t i) {
  if (target.kind == TargetKind::coded) return std::to_string(id_of_code(target.code));
  return (target.kind == TargetKind::sphere ? "K" : "B") + std::to_string(i + 1);
}

}  // namespace

std::vector<ScannedTarget> hung_scan_targets(const RockTunnel& tunnel, double from_m, double to_m) {
  constexpr double apart_m = 1.3, before_rock_m = 0.22;
  const double places[] = {-8.0, 7.2, -5.4, 4.9, -2.8, 2.3, 0.3};
  std::vector<ScannedTarget> targets;
  int id = first_code_id;
  for (double s = from_m; s < to_m; s += apart_m) {
    ScannedTarget target;
    target.kind = static_cast<TargetKind>(targets.size() % 3);
    target.radius_m = target.kind == TargetKind::sphere ? sphere_radius_m : board_radius_m;
    if (target.kind == TargetKind::coded) target.code = code_of_id(id++);
    target.pose = place_facing_back(tunnel, s, places[targets.size() % std::size(places)], before_rock_m);
    targets.push_back(target);
  }
  return targets;
}

void write_scan_targets(const std::vector<ScannedTarget>& targets, const Eigen::Vector3d& origin, std::uint64_t seed,
                        const std::filesystem::path& folder, Job& job) {
  constexpr double surveyed_sigma_m = 0.0007;
  const Random random(seed, 1501);
  std::vector<ControlPoint> surveyed;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Eigen::Vector3d noise(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2));
    surveyed.push_back({name_of(targets[i], i), targets[i].pose.translation() + origin + surveyed_sigma_m * noise});
  }
  io::write_file_atomically(folder / "control.csv", io::control_csv_text(surveyed));
  job.control = "control.csv";
  job.targets.clear();
  job.scan_targets = {2.0 * sphere_radius_m, true, true};
}

}  // namespace adit::app
