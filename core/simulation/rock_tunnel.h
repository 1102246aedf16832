#pragma once
// A simulated rock tunnel: the analytic surface that everything is judged against.

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "core/design/design_tunnel.h"

namespace adit {

struct RockTunnelOptions {
  std::uint64_t seed = 1;
  double from_m = 0.0;         ///< the tunnel exists from here (open end) ...
  double face_m = 60.0;        ///< ... to the mean chainage of the face
  double first_round_m = 0.0;  ///< a round begins here, and every round_length_m after
  double round_length_m = 4.0;
  double lookout_collar_m = 0.06;    ///< overbreak of the contour holes at the collar of a round
  double lookout_toe_m = 0.38;       ///< and at its toe: the saw-tooth
  double roughness_sigma_m = 0.045;  ///< of the walls and the arch
  double shortest_wave_m = 0.9;      ///< band limits of the roughness
  double longest_wave_m = 6.0;
  double floor_mean_m = -0.04;  ///< floor with fine muck: mean deviation, negative = above the line
  double floor_sigma_m = 0.03;
  double corner_m = 0.03;  ///< deviation in the corners between wall and floor
  bool clutter = true;     ///< duct, rig, people and the muck heap at the face
};

/// What a ray met.
enum class Surface : std::uint8_t { rock, face, muck, duct, rig, person };

/// Deviation d(s, p) of the rock from the design line is defined on a fine grid with bilinear interpolation between its
/// nodes, plus the look-out saw-tooth, so that it can be evaluated and integrated exactly. The surface at chainage s is
/// the set of points whose signed distance to the design line equals d(s, p of their foot). Frame: that of the design.
class RockTunnel {
 public:
  /// The design's profile at face_m is used throughout. Throws Error when the axis does not cover [from, face + 1 m].
  RockTunnel(DesignTunnel design, const RockTunnelOptions& options);

  const DesignTunnel& design() const { return design_; }
  const Profile& profile() const { return profile_; }
  const RockTunnelOptions& options() const { return options_; }

  /// Rock deviation [m]; s in [from, face + 1].
  double deviation(double s_m, double p_m) const;

  /// Chainage of the face at a place of the section.
  double face_chainage(double x_m, double z_m) const;

  /// Distance-like value: positive in the air, zero on a surface, negative inside rock or an object. Never more than
  /// about 1.3 times the true distance, save at the steps between rounds. people: where persons stand, (s, x).
  struct Nearness {
    double value_m = 0.0;
    Surface surface = Surface::rock;
  };
  Nearness nearness(const TunnelPoint& point, const std::vector<Eigen::Vector2d>& people) const;

 private:
  void fill_grid();
  double clutter_distance(const TunnelPoint& point, Surface& surface) const;

  DesignTunnel design_;
  Profile profile_;
  RockTunnelOptions options_;
  double step_s_m_ = 0.05;
  double step_p_m_ = 0.05;
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<double> grid_;     ///< roughness and floor, row-major over (s, p)
  std::vector<double> lookout_;  ///< share of the saw-tooth per column
  std::vector<double> floor_;    ///< share of the floor field per column
  double crown_z_m_ = 0.0;
  double half_width_m_ = 0.0;
};

}  // namespace adit
