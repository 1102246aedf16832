#pragma once
// Simulated tunnels of every kind with stations in them: what registration without guesses is judged by.

#include <string>
#include <vector>

#include "core/foundation/random.h"
#include "core/simulation/scanner.h"
#include "tests/core/sample_tunnel.h"

namespace adit::tests {

enum class MineKind { straight, curved, junction, niches };

inline const char* name_of(MineKind kind) {
  constexpr const char* names[] = {"straight", "curved", "junction", "niches"};
  return names[static_cast<int>(kind)];
}

struct SampleMine {
  MineKind kind = MineKind::straight;
  std::vector<RockTunnel> tunnels;  ///< the main one first
  std::vector<Pose> stations;       ///< local_from_scan
};

/// An axis of one element, with a grade.
inline Alignment mine_axis(const Eigen::Vector3d& start, double azimuth_rad, double length_m, double radius_m,
                           double grade) {
  HorizontalElement element;
  element.kind = radius_m == 0.0 ? HorizontalKind::line : HorizontalKind::arc;
  element.start = start.head<2>();
  element.azimuth_rad = azimuth_rad;
  element.length_m = length_m;
  if (radius_m != 0.0) element.start_curvature_per_m = element.end_curvature_per_m = 1.0 / radius_m;
  VerticalPoint begin, end;
  begin.elevation_m = start.z();
  end.chainage_m = length_m;
  end.elevation_m = start.z() + grade * length_m;
  return {"mine", HorizontalAlignment({element}, 0.0), VerticalAlignment({begin, end})};
}

inline RockTunnel mine_tunnel(const Alignment& axis, double face_m, std::uint64_t seed, const RockTunnelOptions& rock) {
  RockTunnelOptions options = rock;
  options.seed = seed;
  options.from_m = 0.5;
  options.face_m = face_m;
  return {DesignTunnel(axis, {{0.0, arch_profile()}}, {{"excavation", 0.0}}), options};
}

/// A tunnel, branch or niche that leaves the axis at a chainage, with so much depth behind the wall.
inline RockTunnel mine_branch(const RockTunnel& main, double chainage_m, double turn_deg, double depth_m,
                              std::uint64_t seed) {
  const Alignment& axis = main.design().alignment();
  const Eigen::Vector2d tangent = axis.horizontal().at(chainage_m).tangent();
  const double azimuth = std::atan2(tangent.x(), tangent.y()) + rad_from_deg(turn_deg);
  const double length = 4.0 + depth_m;
  RockTunnelOptions rock = main.options();
  rock.clutter = false;
  rock.first_round_m = 0.7;
  return mine_tunnel(mine_axis(axis.to_site({chainage_m, 0.0, 0.0}), azimuth, length + 2.0, 0.0, 0.0), length, seed,
                     rock);
}

/// Anything between two numbers, by a place in the stream.
inline Pose mine_station(const Alignment& axis, double chainage_m, const Random& random, std::uint64_t i,
                         double most_tilt_deg) {
  const Eigen::Vector3d at =
      axis.to_site({chainage_m, random.uniform(10 * i, -1.2, 1.2), 1.6 + 0.2 * random.uniform(10 * i + 1)});
  const double tilt = rad_from_deg(most_tilt_deg) * random.uniform(10 * i + 2);
  const double towards = random.uniform(10 * i + 3, -pi, pi);
  Pose pose = make_pose(at, {random.uniform(10 * i + 4, -pi, pi), 0.0, 0.0});
  pose.linear() =
      rotation_from_vector(tilt * Eigen::Vector3d(std::cos(towards), std::sin(towards), 0.0)) * pose.linear();
  return pose;
}

/// So many stations 8 to 15 m apart in a rough tunnel, any yaw; in every other mine tilted by up to 5 degrees.
inline SampleMine sample_mine(MineKind kind, std::uint64_t seed, int stations, const RockTunnelOptions& rock = {}) {
  const Random random(seed, 4000);
  SampleMine mine;
  mine.kind = kind;
  const double tilt_deg = seed % 2 == 0 ? 5.0 : 0.0;
  std::vector<double> chainages{14.0 + 6.0 * random.uniform(1)};
  for (int i = 1; i < stations; ++i)
    chainages.push_back(chainages.back() + random.uniform(100 + static_cast<std::uint64_t>(i), 8.0, 15.0));
  const double face = chainages.back() + random.uniform(2, 17.0, 24.0);
  const double radius =
      kind == MineKind::curved ? (random.uniform(3) < 0.5 ? -1.0 : 1.0) * random.uniform(4, 60, 250) : 0;
  const Alignment axis = mine_axis(Eigen::Vector3d(100, 200, 30), random.uniform(5, -pi, pi), face + 3.0, radius,
                                   random.uniform(6, -0.1, 0.1));
  mine.tunnels.push_back(mine_tunnel(axis, face, seed, rock));
  for (std::size_t i = 0; i < chainages.size(); ++i)
    mine.stations.push_back(mine_station(axis, chainages[i], random, 20 + i, tilt_deg));
  if (kind == MineKind::junction) {
    const double at = chainages[chainages.size() / 2] + 2.0;
    const double turn = (random.uniform(7) < 0.5 ? -1.0 : 1.0) * random.uniform(8, 55.0, 90.0);
    mine.tunnels.push_back(mine_branch(mine.tunnels.front(), at, turn, 25.0, seed + 1000));
    // The last station stands in the branch.
    mine.stations.back() =
        mine_station(mine.tunnels.back().design().alignment(), random.uniform(9, 8.0, 12.0), random, 90, tilt_deg);
  }
  if (kind == MineKind::niches)
    for (std::size_t i = 0; i + 1 < chainages.size(); i += 2)
      mine.tunnels.push_back(mine_branch(mine.tunnels.front(), 0.5 * (chainages[i] + chainages[i + 1]),
                                         i % 4 == 0 ? 90.0 : -90.0, 2.0 + random.uniform(200 + i, 0.0, 1.5),
                                         seed + 2000 + i));
  return mine;
}

}  // namespace adit::tests
