#include "core/simulation/rock_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

float albedo_of(const Random& random, std::uint64_t index, bool floor) {
  const double patch = 0.5 + 0.5 * random.uniform(1000000 + index / 37);
  return static_cast<float>((floor ? 0.18 : 0.32) * patch * (0.6 + 0.8 * random.uniform(index)));
}

}  // namespace

RockMesh rock_mesh(const RockTunnel& tunnel, double from_m, double to_m, double step_m) {
  const double end_m = std::min(to_m, tunnel.options().face_m);
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::ceil((end_m - from_m) / step_m))) + 1;
  const double length_m = tunnel.profile().length_m();
  const auto columns = static_cast<std::size_t>(std::ceil(length_m / step_m));
  const Random random(tunnel.options().seed, 71);
  RockMesh rock;
  rock.mesh.points.resize(rows * columns);
  rock.albedo.resize(rows * columns);
  parallel_for_each_index(
      rows,
      [&](std::size_t r) {
        const double s = from_m + (end_m - from_m) * static_cast<double>(r) / static_cast<double>(rows - 1);
        for (std::size_t c = 0; c < columns; ++c) {
          const double p = length_m * (static_cast<double>(c) / static_cast<double>(columns) - 0.5);
          const ProfilePoint at = tunnel.profile().at(p);
          const Eigen::Vector2d place = at.position + tunnel.deviation(s, p) * at.normal;
          const std::size_t i = r * columns + c;
          rock.mesh.points[i] = tunnel.design().alignment().to_site({s, place.x(), place.y()});
          rock.albedo[i] = albedo_of(random, i, at.normal.y() < -0.5);
        }
      },
      4);
  const auto index = [&](std::size_t r, std::size_t c) {
    return static_cast<std::uint32_t>(r * columns + c % columns);
  };
  for (std::size_t r = 0; r + 1 < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      rock.mesh.triangles.push_back({index(r, c), index(r + 1, c), index(r + 1, c + 1)});
      rock.mesh.triangles.push_back({index(r, c), index(r + 1, c + 1), index(r, c + 1)});
    }
  if (to_m <= tunnel.options().face_m) return rock;
  // The face: a fan about its middle.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < columns; ++c)
    middle += rock.mesh.points[index(rows - 1, c)] / static_cast<double>(columns);
  rock.mesh.points.push_back(middle);
  rock.albedo.push_back(0.3F);
  for (std::size_t c = 0; c < columns; ++c)
    rock.mesh.triangles.push_back(
        {index(rows - 1, c), static_cast<std::uint32_t>(rock.mesh.points.size() - 1), index(rows - 1, c + 1)});
  return rock;
}

Pose place_on_rock(const RockTunnel& tunnel, double chainage_m, double p_m, double before_m) {
  const ProfilePoint at = tunnel.profile().at(p_m);
  const Alignment& axis = tunnel.design().alignment();
  const Eigen::Vector2d place = at.position + (tunnel.deviation(chainage_m, p_m) - before_m) * at.normal;
  const PlanPoint plan = axis.horizontal().at(chainage_m);
  const Eigen::Vector3d right(plan.right().x(), plan.right().y(), 0.0);
  const Eigen::Vector3d inwards = -(at.normal.x() * right + at.normal.y() * Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d along(plan.tangent().x(), plan.tangent().y(), 0.0);
  // Up on the paper: upwards on walls, along the tunnel on the roof.
  const Eigen::Vector3d wanted = std::abs(inwards.z()) < 0.8 ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : along;
  const Eigen::Vector3d up = (wanted - wanted.dot(inwards) * inwards).normalized();
  Pose pose = Pose::Identity();
  pose.linear() << up.cross(inwards), up, inwards;
  pose.translation() = axis.to_site({chainage_m, place.x(), place.y()});
  return pose;
}

Pose place_facing_back(const RockTunnel& tunnel, double chainage_m, double p_m, double before_m) {
  constexpr double turned = 1.2;  // to one of the rock's own direction: 50 degrees
  Pose pose = place_on_rock(tunnel, chainage_m, p_m, before_m);
  const PlanPoint plan = tunnel.design().alignment().horizontal().at(chainage_m);
  const Eigen::Vector3d back(-plan.tangent().x(), -plan.tangent().y(), 0.0), inwards = pose.linear().col(2);
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(inwards, (inwards + turned * back).normalized());
  pose.linear() = (turn.toRotationMatrix() * pose.linear()).eval();
  return pose;
}

}  // namespace adit
