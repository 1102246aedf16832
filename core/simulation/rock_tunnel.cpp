#include "core/simulation/rock_tunnel.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "core/simulation/rock_waves.h"

namespace adit {
namespace {

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Distance along the closed line between two places.
double along_line(double a_m, double b_m, double length_m) {
  return std::abs(std::remainder(a_m - b_m, length_m));
}

/// Without hypot's care for overflow, which costs half of a cast.
double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

double box_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const Eigen::Vector3d outside = (low - point).cwiseMax(point - high);
  return outside.cwiseMax(0.0).norm() + std::min(outside.maxCoeff(), 0.0);
}

}  // namespace

RockTunnel::RockTunnel(DesignTunnel design, const RockTunnelOptions& options)
    : design_(std::move(design)), profile_(design_.profile_at(options.face_m)), options_(options) {
  if (options.from_m < design_.alignment().from_m() || options.face_m + 1.0 > design_.alignment().to_m())
    throw Error("the simulated tunnel reaches beyond its axis", "", "lengthen the axis");
  rows_ = static_cast<std::size_t>(std::ceil((options.face_m + 1.0 - options.from_m) / step_s_m_)) + 2;
  columns_ = static_cast<std::size_t>(std::ceil(profile_.length_m() / step_p_m_));
  step_p_m_ = profile_.length_m() / static_cast<double>(columns_);
  crown_z_m_ = profile_.box().max().y();
  half_width_m_ = 0.5 * profile_.box().sizes().x();
  fill_grid();
}

void RockTunnel::fill_grid() {
  const double length = profile_.length_m();
  const RockWaves rock(options_.seed, 1, options_.shortest_wave_m, options_.longest_wave_m, length);
  const RockWaves muck(options_.seed, 2, 1.2, 8.0, length);
  std::vector<double> taper(columns_);
  std::vector<RockWaves::Phases> rock_at_p(columns_), muck_at_p(columns_);
  lookout_.resize(columns_);
  floor_.resize(columns_);
  for (std::size_t c = 0; c < columns_; ++c) {
    const ProfilePoint point = profile_.at(static_cast<double>(c) * step_p_m_ - 0.5 * length);
    rock_at_p[c] = rock.phases_at_p(static_cast<double>(c) * step_p_m_ - 0.5 * length);
    muck_at_p[c] = muck.phases_at_p(static_cast<double>(c) * step_p_m_ - 0.5 * length);
    floor_[c] = smooth_step((-point.normal.y() - 0.5) / 0.3);
    taper[c] = 1.0;
    for (const ProfileCorner& corner : profile_.corners())
      taper[c] *= smooth_step(along_line(corner.p_m, point.p_m, length) / 0.6);
    lookout_[c] = (1.0 - floor_[c]) * taper[c];
    floor_[c] *= taper[c];
  }
  grid_.resize(rows_ * columns_);
  parallel_for_each_index(
      rows_,
      [&](std::size_t r) {
        const double s = options_.from_m + static_cast<double>(r) * step_s_m_;
        const RockWaves::Phases rock_at_s = rock.phases_at_s(s);
        const RockWaves::Phases muck_at_s = muck.phases_at_s(s);
        for (std::size_t c = 0; c < columns_; ++c) {
          const double wall = options_.roughness_sigma_m * rock.at(rock_at_s, rock_at_p[c]);
          const double floor = options_.floor_mean_m + options_.floor_sigma_m * muck.at(muck_at_s, muck_at_p[c]);
          grid_[r * columns_ + c] = lookout_[c] * wall + floor_[c] * floor + (1.0 - taper[c]) * options_.corner_m;
        }
      },
      8);
}

double RockTunnel::deviation(double s_m, double p_m) const {
  const double row = std::clamp((s_m - options_.from_m) / step_s_m_, 0.0, static_cast<double>(rows_ - 1) - 1e-9);
  const auto r = static_cast<std::size_t>(row);
  const double u = row - static_cast<double>(r);
  double column = (p_m + 0.5 * profile_.length_m()) / step_p_m_;
  column = std::clamp(column, 0.0, static_cast<double>(columns_) - 1e-9);
  const auto c = static_cast<std::size_t>(column);
  const double v = column - static_cast<double>(c);
  const std::size_t next = c + 1 == columns_ ? 0 : c + 1;
  const double* a = &grid_[r * columns_];
  const double* b = a + columns_;
  const double rough = (1.0 - u) * ((1.0 - v) * a[c] + v * a[next]) + u * ((1.0 - v) * b[c] + v * b[next]);
  const double in_round = (s_m - options_.first_round_m) / options_.round_length_m;
  const double tooth = in_round - std::floor(in_round);
  const double lookout = options_.lookout_collar_m + (options_.lookout_toe_m - options_.lookout_collar_m) * tooth;
  return rough + lookout * ((1.0 - v) * lookout_[c] + v * lookout_[next]);
}

double RockTunnel::face_chainage(double x_m, double z_m) const {
  return options_.face_m + 0.12 * std::sin(1.3 * x_m + 0.4) * std::cos(1.1 * z_m) +
         0.05 * std::sin(3.1 * x_m - 2.2 * z_m);
}

double RockTunnel::clutter_distance(const TunnelPoint& point, Surface& surface) const {
  double best = 1e9;
  const auto offer = [&](double distance, Surface kind) {
    if (distance < best) {
      best = distance;
      surface = kind;
    }
  };
  const double face = options_.face_m;
  const double beyond_duct = std::max(point.s_m - (face - 9.0), 0.0);
  offer(length_of(std::max(length_of(point.x_m + 0.35 * half_width_m_, point.z_m - (crown_z_m_ - 0.85)) - 0.4, 0.0),
                  beyond_duct),
        Surface::duct);
  if (face - 14.0 - point.s_m > best) return best;  // the rig and the muck are farther
  const Eigen::Vector3d q(point.s_m, point.x_m, point.z_m);
  const double right = 0.30 * half_width_m_;
  const auto offer_rig = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    offer(box_distance(q, low, high), Surface::rig);
  };
  // One box about the whole rig spares most points its parts.
  if (box_distance(q, {face - 14.0, right - 1.2, -0.5}, {face - 4.5, right + 1.2, 2.9}) < best) {
    offer_rig({face - 14.0, right - 1.1, 0.4}, {face - 8.0, right + 1.1, 2.3});
    offer_rig({face - 13.0, right - 0.8, 2.3}, {face - 11.2, right + 0.8, 2.9});
    offer_rig({face - 8.0, right - 0.15, 1.5}, {face - 4.5, right + 0.15, 1.8});
    for (const double wheel : {-13.2, -9.0})
      for (const double side : {-0.95, 0.95})
        offer_rig({face + wheel - 0.5, right + side - 0.2, -0.5}, {face + wheel + 0.5, right + side + 0.2, 0.5});
  }
  const double run = std::clamp((point.s_m - (face - 4.0)) / 4.0, 0.0, 1.0);
  const double across = std::clamp(std::abs(point.x_m) / half_width_m_, 0.0, 1.0);
  const double heap = 2.2 * run * run * (1.0 - 0.35 * across * across) - 0.3;
  if (point.s_m > face - 4.0) offer(0.6 * (point.z_m - heap), Surface::muck);
  return best;
}

RockTunnel::Nearness RockTunnel::nearness(const TunnelPoint& point, const std::vector<Eigen::Vector2d>& people) const {
  const ProfileFoot foot = profile_.nearest({point.x_m, point.z_m});
  Nearness nearest{deviation(point.s_m, foot.p_m) - foot.deviation_m, Surface::rock};
  const auto offer = [&](double distance, Surface kind) {
    if (distance < nearest.value_m) nearest = {distance, kind};
  };
  constexpr double face_relief_m = 0.17;
  if (options_.face_m - face_relief_m - point.s_m < nearest.value_m)
    offer(face_chainage(point.x_m, point.z_m) - point.s_m, Surface::face);
  if (!options_.clutter) return nearest;
  Surface kind = Surface::rig;
  const double distance = clutter_distance(point, kind);
  offer(distance, kind);
  for (const auto& person : people) {
    const double above = std::max({0.0, point.z_m - 1.5, 0.25 - point.z_m});
    offer(length_of(length_of(point.s_m - person.x(), point.x_m - person.y()), above) - 0.25, Surface::person);
  }
  return nearest;
}

}  // namespace adit
