#include "core/registration/surface_match.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

// Cosine of 32 degrees: two faces of one wall, or a corner that either scanner sees from one side, are not the same
// surface.
constexpr double least_facing = 0.85;

/// The target's surface about a source piece.
class Surface {
 public:
  Surface(const Eigen::Vector3d& place, const Eigen::Vector3d& source_normal, double cell_m)
      : place_(place), source_normal_(source_normal), reach2_(cell_m * cell_m) {}

  void add(const SurfacePiece& piece) {
    const Eigen::Vector3d away = place_ - piece.place.cast<double>();
    const double squared = away.squaredNorm();
    if (squared >= reach2_) return;
    near_ = true;
    Eigen::Vector3d normal = piece.normal.cast<double>();
    const double facing = source_normal_.dot(normal);
    if (std::abs(facing) < least_facing) return;
    if (facing < 0.0) normal = -normal;
    const double weight = near_weight(squared / reach2_);
    weight_ += weight;
    residual_ += 0.5 * weight * (source_normal_ + normal).dot(away);
    normal_ += weight * normal;
    nearest2_ = std::min(nearest2_, squared);
  }

  bool is_near() const { return near_; }

  std::optional<SurfaceMatch> match(const Eigen::Vector3d& origin) const {
    if (!(weight_ > 1e-6)) return std::nullopt;
    SurfaceMatch match;
    const Eigen::Vector3d target_normal = normal_.normalized();
    match.arm = place_ - origin;
    match.normal = (source_normal_ + target_normal).normalized();
    match.normal_error = 0.5 * (source_normal_ - target_normal);
    match.residual_m = residual_ / weight_;
    match.distance_m = std::sqrt(nearest2_);
    return match;
  }

 private:
  Eigen::Vector3d place_, source_normal_;
  double reach2_;
  bool near_ = false;
  double weight_ = 0.0, residual_ = 0.0, nearest2_ = 1e300;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
};

CubeSums empty_cube(std::uint64_t key) {
  CubeSums cube;
  cube.key = key;
  return cube;
}

/// Whether one scanner stands before the surface and one behind it; a surface seen along itself says neither.
bool is_of_two_sides(const SurfaceMatch& match, const Eigen::Vector3d& place) {
  constexpr double grazing = 0.1;
  const double of_source = match.arm.dot(match.normal);
  const double of_target = place.dot(match.normal);
  const auto is_clear = [](double of, const Eigen::Vector3d& ray) {
    return of * of > grazing * grazing * ray.squaredNorm();
  };
  return of_source * of_target < 0.0 && is_clear(of_source, match.arm) && is_clear(of_target, place);
}

}  // namespace

Meeting meeting_of(const SurfaceMap& target, const SurfacePiece& piece, const Pose& target_from_source,
                   bool from_origins) {
  const Eigen::Vector3d place = target_from_source * piece.place.cast<double>();
  Surface surface(place, target_from_source.linear() * piece.normal.cast<double>(), target.cell_m());
  target.visit_near(place, [&](const SurfacePiece& near) { surface.add(near); });
  Meeting meeting{surface.is_near(), surface.match(target_from_source.translation())};
  if (from_origins && meeting.match && is_of_two_sides(*meeting.match, place)) meeting.match.reset();
  return meeting;
}

std::vector<SurfaceMatch> surface_matches(const SurfaceMap& target, const SurfaceMap& source,
                                          const Pose& target_from_source, Progress& progress, std::size_t enough) {
  const std::vector<SurfacePiece>& pieces = source.pieces();
  const std::size_t step = 1 + pieces.size() / std::max<std::size_t>(enough, 1);
  const bool from_origins = target.seen_from_origin() && source.seen_from_origin();
  return parallel_ordered_list((pieces.size() + step - 1) / step, 1024, [&](std::size_t begin, std::size_t end) {
    progress.check();
    std::vector<SurfaceMatch> matches;
    matches.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i)
      if (const auto match = meeting_of(target, pieces[i * step], target_from_source, from_origins).match)
        matches.push_back(*match);
    return matches;
  });
}

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  hessian += other.hessian;
  gradient += other.gradient;
  weight += other.weight;
  curvature += other.curvature;
  noise += other.noise;
  return *this;
}

NormalEquations normal_equations(std::span<const SurfaceMatch> matches, double tukey_m) {
  return parallel_ordered_sum(matches.size(), 4096, NormalEquations{}, [&](std::size_t begin, std::size_t end) {
    NormalEquations sums;
    for (const SurfaceMatch& match : matches.subspan(begin, end - begin)) {
      const double weight = tukey_weight(match.residual_m, tukey_m);
      if (!(weight > 0.0)) continue;
      const Vector6d j = jacobian_of(match);
      const Vector6d weighted = weight * j;
      sums.hessian.noalias() += weighted * j.transpose();
      sums.gradient += match.residual_m * weighted;
      sums.weight += weight;
      sums.curvature += tukey_curvature(match.residual_m, tukey_m);
      Vector6d error;
      error << match.arm.cross(match.normal_error), match.normal_error;
      const Vector6d weighted_error = weight * error;
      sums.noise.noalias() += weighted_error * error.transpose();
    }
    return sums;
  });
}

std::vector<CubeSums> sums_by_cubes(std::span<const SurfaceMatch> matches, double tukey_m, double cube_m) {
  std::vector<std::pair<std::uint64_t, std::size_t>> by_cube;
  for (std::size_t i = 0; i < matches.size(); ++i) by_cube.emplace_back(cell_key(in_cells(matches[i].arm, cube_m)), i);
  std::sort(by_cube.begin(), by_cube.end());
  std::vector<CubeSums> cubes;
  for (std::size_t n = 0; n < by_cube.size(); ++n) {
    if (n == 0 || by_cube[n - 1].first != by_cube[n].first) cubes.push_back(empty_cube(by_cube[n].first));
    const SurfaceMatch& match = matches[by_cube[n].second];
    const Vector6d j = jacobian_of(match);
    const Vector6d weighted = tukey_weight(match.residual_m, tukey_m) * j;
    cubes.back().hessian.noalias() += weighted * j.transpose();
    cubes.back().gradient += match.residual_m * weighted;
  }
  return cubes;
}

std::vector<CubeSums> with_double_cubes(const std::vector<CubeSums>& cubes) {
  std::vector<CubeSums> doubled;
  for (const CubeSums& cube : cubes) {
    const std::uint64_t key = cube.key >> 3;  // along a Morton curve eight follow one another
    if (doubled.empty() || doubled.back().key != key) doubled.push_back(empty_cube(key));
    doubled.back().hessian += cube.hessian;
    doubled.back().gradient += cube.gradient;
  }
  return doubled;
}

}  // namespace adit
