#include "core/registration/plan_view.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr double grid_m = 0.5;
constexpr double most_range_m = 25.0;

using Pieces = std::vector<const NormalDistribution*>;

Pieces pieces_of(const DistributionMap& cells) {
  Pieces pieces;
  for (const NormalDistribution& cell : cells.distributions())
    if (cell.flat && cell.mean.norm() < most_range_m) pieces.push_back(&cell);
  return pieces;
}

/// z = a x + b y + c through the floor near the scanner, robustly; false when there is too little of it.
bool fit_floor(const Pieces& pieces, Eigen::Vector3d& abc) {
  constexpr double near_m = 10.0;
  constexpr std::size_t least_pieces = 20;
  std::vector<Eigen::Vector3d> floor;
  for (const NormalDistribution* piece : pieces)
    if (piece->mean.head<2>().norm() < near_m && piece->mean.z() < -0.3 && std::abs(piece->normal.z()) > 0.88)
      floor.push_back(piece->mean);
  if (floor.size() < least_pieces) return false;
  std::vector<double> heights;
  for (const auto& p : floor) heights.push_back(p.z());
  abc = {0.0, 0.0, quantile(heights, 0.4)};
  for (const double reach_m : {1.0, 1.0, 0.6, 0.4, 0.3, 0.3}) {
    Eigen::Matrix3d normal = Eigen::Vector3d(1e-3, 1e-3, 1e-6).asDiagonal();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const auto& p : floor) {
      const Eigen::Vector3d row(p.x(), p.y(), 1.0);
      const double u = (p.z() - row.dot(abc)) / reach_m;
      if (std::abs(u) >= 1.0) continue;
      const double weight = (1.0 - u * u) * (1.0 - u * u);
      normal += weight * row * row.transpose();
      right += weight * p.z() * row;
    }
    abc = normal.ldlt().solve(right);
  }
  return abc.head<2>().norm() < std::tan(rad_from_deg(25.0));
}

/// Walls count most, what the target saw through counts against: then a wall cannot lie there.
class PlanMap {
 public:
  explicit PlanMap(const std::vector<Eigen::Vector2d>& walls) {
    const std::vector<float> none(cells_ * cells_, 0.0F);
    std::vector<float> wall = none;
    values_ = none;
    for (const auto& at : walls) {
      wall[index(at)] = 1.0F;
      const double range = at.norm();
      for (double r = 0.0; r < range - 1.5; r += 0.5 * grid_m) values_[index(at * (r / range))] = free_;
    }
    for (std::size_t y = 1; y + 1 < cells_; ++y)
      for (std::size_t x = 1; x + 1 < cells_; ++x) {
        float near = wall[y * cells_ + x];
        for (std::size_t j = y - 1; j <= y + 1; ++j)
          for (std::size_t i = x - 1; i <= x + 1; ++i) near = std::max(near, beside_ * wall[j * cells_ + i]);
        if (near > 0.0F) values_[y * cells_ + x] = near;
      }
  }
  float at(const Eigen::Vector2d& place) const {
    if (place.cwiseAbs().maxCoeff() >= half_m_) return 0.0F;
    return values_[index(place)];
  }

 private:
  static constexpr float free_ = -0.4F;
  static constexpr float beside_ = 0.6F;
  static constexpr std::size_t cells_ = 112;
  static constexpr double half_m_ = 0.5 * grid_m * static_cast<double>(cells_) - grid_m;
  static std::size_t index(const Eigen::Vector2d& place) {
    const Eigen::Vector2d cell = (place / grid_m).array().floor() + 0.5 * static_cast<double>(cells_);
    return static_cast<std::size_t>(cell.y()) * cells_ + static_cast<std::size_t>(cell.x());
  }
  std::vector<float> values_;
};

struct PlanPose {
  double score;
  double yaw_rad;
  Eigen::Vector2d shift;
};

Pose pose_of(const PlanPose& found, const PlanView& target, const PlanView& source) {
  Pose level = Pose::Identity();
  level.linear() = Eigen::AngleAxisd(found.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  level.translation().head<2>() = found.shift;
  return target.scan_from_level * level * source.scan_from_level.inverse();
}

/// One spot for each square metre that has any.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& spots) {
  std::set<std::pair<long, long>> taken;
  std::vector<Eigen::Vector2d> kept;
  for (const auto& spot : spots)
    if (taken.insert({std::lround(spot.x()), std::lround(spot.y())}).second) kept.push_back(spot);
  return kept;
}

std::vector<PlanPose> distinct(std::vector<PlanPose> found, std::size_t most) {
  constexpr double apart_m = 1.2;
  constexpr double apart_rad = rad_from_deg(8.0);
  std::stable_sort(found.begin(), found.end(), [](const PlanPose& a, const PlanPose& b) { return a.score > b.score; });
  std::vector<PlanPose> kept;
  for (const PlanPose& one : found) {
    if (kept.size() == most) break;
    const bool new_one = std::none_of(kept.begin(), kept.end(), [&](const PlanPose& other) {
      return (one.shift - other.shift).norm() < apart_m &&
             std::abs(wrapped_rad(one.yaw_rad - other.yaw_rad)) < apart_rad;
    });
    if (new_one) kept.push_back(one);
  }
  return kept;
}

}  // namespace

PlanView plan_view(const DistributionMap& cells) {
  const Pieces pieces = pieces_of(cells);
  PlanView view;
  Eigen::Vector3d abc = Eigen::Vector3d::Zero();
  view.has_floor = fit_floor(pieces, abc);
  if (!view.has_floor) abc = {0.0, 0.0, -1.6};
  const Eigen::Vector3d up = Eigen::Vector3d(-abc.x(), -abc.y(), 1.0).normalized();
  view.scan_from_level.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up).toRotationMatrix();
  view.scan_from_level.translation() = up * up.dot(Eigen::Vector3d(0.0, 0.0, abc.z()));
  const Pose level_from_scan = view.scan_from_level.inverse();
  for (const NormalDistribution* piece : pieces) {
    const Eigen::Vector3d at = level_from_scan * piece->mean;
    // Over a deep, tilted floor the level frame begins far from the scanner: its map reaches no farther than this.
    const bool in_reach = at.head<2>().norm() < most_range_m;
    if (in_reach && at.z() > 0.5 && at.z() < 3.5 && std::abs(up.dot(piece->normal)) < 0.5)
      view.walls.emplace_back(at.head<2>());
  }
  return view;
}

std::vector<PlanMatch> plan_matches(const PlanView& target, const PlanView& source, double reach_m, std::size_t most) {
  constexpr std::size_t turns = 60;
  constexpr double step_m = 1.0;
  const PlanMap map(target.walls);
  const std::vector<Eigen::Vector2d> spots = thinned(source.walls);
  std::vector<std::vector<PlanPose>> of_turn(turns);
  parallel_for_each_index(
      turns,
      [&](std::size_t turn) {
        const double yaw = 2.0 * pi * static_cast<double>(turn) / static_cast<double>(turns);
        std::vector<Eigen::Vector2d> turned;
        for (const auto& spot : spots) turned.emplace_back(Eigen::Rotation2Dd(yaw) * spot);
        for (double y = -reach_m; y <= reach_m; y += step_m)
          for (double x = -reach_m; x <= reach_m; x += step_m) {
            if (x * x + y * y > reach_m * reach_m) continue;
            double score = 0.0;
            for (const auto& spot : turned) score += static_cast<double>(map.at(spot + Eigen::Vector2d(x, y)));
            of_turn[turn].push_back({score, yaw, {x, y}});
          }
        of_turn[turn] = distinct(std::move(of_turn[turn]), most);
      },
      1);
  std::vector<PlanPose> all;
  for (const auto& some : of_turn) all.insert(all.end(), some.begin(), some.end());
  std::vector<PlanMatch> matches;
  for (const PlanPose& found : distinct(std::move(all), most))
    if (found.score > 0.0) matches.push_back({pose_of(found, target, source), found.score});
  return matches;
}

}  // namespace adit
