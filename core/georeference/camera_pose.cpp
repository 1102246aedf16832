#include "core/georeference/camera_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/geometry/statistics.h"
#include "core/georeference/posit.h"

namespace adit {
namespace {

constexpr std::size_t least_targets = 4;
constexpr double wrong_sigmas = 4.0;

using Indices = std::vector<std::size_t>;

/// Targets relative to their middle, so that site coordinates lose nothing.
struct Scene {
  const CameraLens& lens;
  const CameraPoseOptions& options;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector2d> places;  ///< on the plane z = 1
  std::vector<double> sigmas_px;

  /// One sigma of a pixel coordinate with its landmark's part, which grows as the camera is near.
  double sigma_px(std::size_t i, double depth_m) const {
    return std::hypot(sigmas_px[i], options.lens_sigma_px, options.landmark_sigma_m * lens.focal_px() / depth_m);
  }
};

Scene scene_of(const CameraLens& lens, const std::vector<LandmarkSight>& sights, const CameraPoseOptions& options) {
  Scene scene{lens, options, Eigen::Vector3d::Zero(), {}, {}, {}, {}};
  for (const LandmarkSight& sight : sights) scene.middle += sight.site / static_cast<double>(sights.size());
  for (const LandmarkSight& sight : sights) {
    const auto place = place_of(lens, sight.pixel);
    if (!place)
      throw Error("target " + sight.id + " stands at a pixel that the lens cannot show", {},
                  "check the camera file: is it of this camera and picture size?");
    scene.points.push_back(sight.site - scene.middle);
    scene.pixels.push_back(sight.pixel);
    scene.places.push_back(*place);
    scene.sigmas_px.push_back(sight.sigma_px);
  }
  return scene;
}

double off_px(const Scene& scene, const Pose& camera_from_site, std::size_t i) {
  const Eigen::Vector3d at = camera_from_site * scene.points[i];
  if (at.z() <= 0.01) return std::numeric_limits<double>::infinity();
  return (pixel_of(scene.lens, at) - scene.pixels[i]).norm();
}

/// d pixel / d (turn, shift of the camera frame) of a point, seen after `turned` = rotation * point and the shift.
Eigen::Matrix<double, 2, 6> sight_derivative(const CameraLens& lens, const Eigen::Vector3d& turned,
                                             const Eigen::Vector3d& at) {
  Eigen::Matrix<double, 3, 6> moves;
  moves << 0.0, turned.z(), -turned.y(), 1.0, 0.0, 0.0, -turned.z(), 0.0, turned.x(), 0.0, 1.0, 0.0, turned.y(),
      -turned.x(), 0.0, 0.0, 0.0, 1.0;
  return pixel_derivative(lens, at) * moves;
}

struct Adjusted {
  Pose camera_from_site = Pose::Identity();
  Matrix6d normal = Matrix6d::Zero();  ///< of a turn and a shift of the camera frame
  double cost = std::numeric_limits<double>::infinity();
};

/// Gauss-Newton on the pixels of some targets; nothing where a target comes behind the camera.
std::optional<Adjusted> adjust(const Scene& scene, const Pose& start, const Indices& which) {
  constexpr int most_steps = 30;
  Adjusted adjusted{start, {}, std::numeric_limits<double>::infinity()};
  const auto sums = [&](const Pose& pose, Matrix6d& normal, Vector6d& right) {
    normal.setZero();
    right.setZero();
    double cost = 0.0;
    for (const std::size_t i : which) {
      const Eigen::Vector3d turned = pose.linear() * scene.points[i], at = turned + pose.translation();
      if (at.z() <= 0.01) return std::numeric_limits<double>::infinity();
      const double weight = 1.0 / std::pow(scene.sigma_px(i, at.z()), 2);
      const Eigen::Vector2d off = scene.pixels[i] - pixel_of(scene.lens, at);
      const Eigen::Matrix<double, 2, 6> derivative = sight_derivative(scene.lens, turned, at);
      normal += weight * derivative.transpose() * derivative;
      right += weight * derivative.transpose() * off;
      cost += weight * off.squaredNorm();
    }
    return cost;
  };
  Vector6d right;
  adjusted.cost = sums(adjusted.camera_from_site, adjusted.normal, right);
  if (!std::isfinite(adjusted.cost)) return std::nullopt;
  double damping = 1e-6;
  for (int i = 0; i < most_steps; ++i) {
    Matrix6d damped = adjusted.normal;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d by = damped.ldlt().solve(right);
    if (!by.allFinite()) return std::nullopt;
    Pose moved = adjusted.camera_from_site;
    moved.linear() = rotation_from_vector(by.head<3>()) * moved.linear();
    moved.translation() += by.tail<3>();
    Matrix6d normal;
    Vector6d next;
    const double cost = sums(moved, normal, next);
    if (cost <= adjusted.cost) {
      const bool still = adjusted.cost - cost < 1e-12 * (1.0 + cost);
      adjusted = {moved, normal, cost};
      right = next;
      damping = std::max(1e-9, damping * 0.1);
      if (still) break;
    } else {
      damping = std::max(1e-6, damping * 10.0);
      if (damping > 1e6) break;
    }
  }
  return adjusted;
}

template <typename Value>
std::vector<Value> chosen(const std::vector<Value>& values, const Indices& which) {
  std::vector<Value> some;
  for (const std::size_t i : which) some.push_back(values[i]);
  return some;
}

/// The other pose that shows points of a plane nearly alike: their depths turned round about that of their middle.
Pose mirrored(const Pose& camera_from_site, const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) middle += point / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) spread += (point - middle) * (point - middle).transpose();
  const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  const Eigen::Vector3d seen = camera_from_site * middle, ahead = seen.normalized();
  const auto mirror = [](const Eigen::Vector3d& across) {
    return Eigen::Matrix3d(Eigen::Matrix3d::Identity() - 2.0 * across * across.transpose());
  };
  Pose pose = Pose::Identity();
  pose.linear() = mirror(ahead) * camera_from_site.linear() * mirror(normal);
  pose.translation() = seen - pose.linear() * middle;
  return pose;
}

/// POSIT, then a few steps on the pixels: of every pose that POSIT gives.
std::vector<Pose> poses_of(const Scene& scene, const Indices& which) {
  std::vector<Pose> poses;
  const std::vector<Eigen::Vector3d> points = chosen(scene.points, which);
  for (const PositPose& found : posit(points, chosen(scene.places, which)))
    if (const auto better = adjust(scene, found.camera_from_site, which)) poses.push_back(better->camera_from_site);
  if (!poses.empty() && flatness(points) < flat_points)
    if (const auto other = adjust(scene, mirrored(poses.front(), points), which))
      poses.push_back(other->camera_from_site);
  return poses;
}

/// Calls visit for subsets of four: all of few targets, drawn ones of many.
template <typename Visit>
void for_fours(std::size_t n, std::uint64_t seed, const Visit& visit) {
  constexpr std::size_t most_for_all = 11, draws = 400;
  if (n <= most_for_all) {
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        for (std::size_t c = b + 1; c < n; ++c)
          for (std::size_t d = c + 1; d < n; ++d) visit(Indices{a, b, c, d});
    return;
  }
  const Random random(seed, n);
  std::uint64_t k = 0;
  for (std::size_t t = 0; t < draws; ++t) {
    Indices four;
    while (four.size() < least_targets) {
      const auto i = std::min(n - 1, static_cast<std::size_t>(random.uniform(k++) * static_cast<double>(n)));
      if (std::find(four.begin(), four.end(), i) == four.end()) four.push_back(i);
    }
    std::sort(four.begin(), four.end());
    visit(four);
  }
}

struct Consensus {
  Pose pose = Pose::Identity();
  Indices agreeing;
  double off_px = std::numeric_limits<double>::infinity();  ///< sum over those
};

/// The pose that most targets fit; of equal ones that which they fit better.
Consensus consensus_of(const Scene& scene) {
  const double limit_px = scene.options.most_off_px * std::max(0.5, scene.lens.focal_px() / 1000.0);
  Consensus best;
  const auto look = [&](const Pose& pose) {
    Consensus one;
    one.pose = pose;
    one.off_px = 0.0;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      const double off = off_px(scene, pose, i);
      if (off > std::hypot(limit_px, 3.0 * scene.sigmas_px[i])) continue;
      one.agreeing.push_back(i);
      one.off_px += off;
    }
    if (one.agreeing.size() > best.agreeing.size() ||
        (one.agreeing.size() == best.agreeing.size() && one.off_px < best.off_px))
      best = one;
  };
  Indices all(scene.points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  for (const Pose& pose : poses_of(scene, all)) look(pose);
  if (best.agreeing.size() == all.size()) return best;
  for_fours(scene.points.size(), scene.options.seed, [&](const Indices& four) {
    for (const Pose& pose : poses_of(scene, four)) look(pose);
  });
  return best;
}

/// Residual of a target over its sigma, its own share of the adjustment considered.
double normalised_residual(const Scene& scene, const Adjusted& adjusted, const Matrix6d& covariance, std::size_t i) {
  const Eigen::Vector3d turned = adjusted.camera_from_site.linear() * scene.points[i];
  const Eigen::Vector3d at = turned + adjusted.camera_from_site.translation();
  const Eigen::Matrix<double, 2, 6> derivative = sight_derivative(scene.lens, turned, at);
  const double variance = std::pow(scene.sigma_px(i, at.z()), 2);
  const Eigen::Matrix2d left =
      variance * Eigen::Matrix2d::Identity() - derivative * covariance * derivative.transpose();
  const Eigen::Vector2d off = scene.pixels[i] - pixel_of(scene.lens, at);
  double worst = 0.0;
  for (int k = 0; k < 2; ++k)
    if (left(k, k) > 0.01 * variance) worst = std::max(worst, std::abs(off(k)) / std::sqrt(left(k, k)));
  return worst;
}

/// The adjustment of those that agree, less what lies off by too many of its sigmas, one at a time.
std::optional<Adjusted> adjusted_without_blunders(const Scene& scene, const Pose& start, Indices& used) {
  std::optional<Adjusted> adjusted = adjust(scene, start, used);
  while (adjusted && used.size() > least_targets) {
    const Matrix6d covariance = adjusted->normal.inverse();
    std::size_t worst = used.size();
    double most = wrong_sigmas;
    for (std::size_t k = 0; k < used.size(); ++k) {
      const double normalised = normalised_residual(scene, *adjusted, covariance, used[k]);
      if (normalised > most) {
        most = normalised;
        worst = k;
      }
    }
    if (worst == used.size()) break;
    used.erase(used.begin() + static_cast<std::ptrdiff_t>(worst));
    adjusted = adjust(scene, adjusted->camera_from_site, used);
  }
  return adjusted;
}

/// From the targets' middle to the site.
Pose site_from_camera(const Scene& scene, const Pose& camera_from_middle) {
  Pose camera_from_site = camera_from_middle;
  camera_from_site.translation() -= camera_from_site.linear() * scene.middle;
  return camera_from_site.inverse();
}

/// What an error of the focal length adds: it moves the camera along its axis by as much of the distances, and hardly
/// shows in the residuals (a considered parameter, Schmidt 1966).
Vector6d by_focal_length(const Scene& scene, const Adjusted& adjusted, const Indices& used) {
  Vector6d moved = Vector6d::Zero();
  for (const std::size_t i : used) {
    const Eigen::Vector3d turned = adjusted.camera_from_site.linear() * scene.points[i],
                          at = turned + adjusted.camera_from_site.translation();
    const Eigen::Vector2d by_log_focal = pixel_of(scene.lens, at) - Eigen::Vector2d(scene.lens.cx, scene.lens.cy);
    moved +=
        sight_derivative(scene.lens, turned, at).transpose() * by_log_focal / std::pow(scene.sigma_px(i, at.z()), 2);
  }
  return scene.lens.focal_sigma * adjusted.normal.ldlt().solve(moved);
}

/// From turns and shifts of the camera frame to those of the camera in the site.
Matrix6d to_site(const Adjusted& adjusted) {
  const Eigen::Matrix3d back = adjusted.camera_from_site.linear().transpose();
  const Eigen::Vector3d t = adjusted.camera_from_site.translation();
  Eigen::Matrix3d cross;
  cross << 0.0, -t.z(), t.y(), t.z(), 0.0, -t.x(), -t.y(), t.x(), 0.0;
  Matrix6d change = Matrix6d::Zero();
  change.topLeftCorner<3, 3>() = -back * cross;  // of the position -R^T t
  change.topRightCorner<3, 3>() = -back;
  change.bottomLeftCorner<3, 3>() = -back;
  return change;
}

/// Whether a target may be seen at all. Camera frame.
bool ahead(const Eigen::Vector3d& in_camera) {
  return in_camera.z() > 0.01;
}

/// How far beside its surveyed place the line of sight to a target passes.
double beside_m(const Scene& scene, const Pose& camera_from_site, std::size_t i) {
  const Eigen::Vector3d at = camera_from_site * scene.points[i];
  const Eigen::Vector3d ray = Eigen::Vector3d(scene.places[i].x(), scene.places[i].y(), 1.0).normalized();
  return (at - ray * ray.dot(at)).norm();
}

void add_residuals(const Scene& scene, const Adjusted& adjusted, const std::vector<LandmarkSight>& sights,
                   const Indices& used, CameraPose& result) {
  const Matrix6d covariance = adjusted.normal.inverse();
  double squares = 0.0;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    LandmarkResidual one;
    one.id = sights[i].id;
    one.used = std::find(used.begin(), used.end(), i) != used.end();
    const Eigen::Vector3d at = adjusted.camera_from_site * scene.points[i];
    if (ahead(at)) one.residual_px = scene.pixels[i] - pixel_of(scene.lens, at);
    if (one.used) {
      one.normalised = normalised_residual(scene, adjusted, covariance, i);
      squares += one.residual_px.squaredNorm();
    } else {
      one.across_m = beside_m(scene, adjusted.camera_from_site, i);
    }
    result.landmarks.push_back(one);
  }
  result.rms_px = std::sqrt(squares / static_cast<double>(used.size()));
}

void name_left_out(const Scene& scene, const Adjusted& adjusted, const std::vector<LandmarkSight>& sights,
                   const Indices& used, CameraPose& result) {
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (std::find(used.begin(), used.end(), i) != used.end()) continue;
    char words[200];
    if (ahead(adjusted.camera_from_site * scene.points[i]))
      std::snprintf(words, sizeof words, "is not used: it is seen %.3f m beside its surveyed place (%.1f pixels)",
                    beside_m(scene, adjusted.camera_from_site, i), off_px(scene, adjusted.camera_from_site, i));
    else
      std::snprintf(words, sizeof words, "is not used: its surveyed place lies behind the camera");
    result.findings.push_back(
        {Severity::decision, "target " + sights[i].id, words,
         sights.size() - used.size() > 1
             ? "check that the camera file is of this camera, zoom and focus; then survey these targets again"
             : "survey it again: it may have moved, or its id may be wrong in the database"});
  }
}

/// What makes a pose doubtful.
void judge(const Scene& scene, const Adjusted& adjusted, const Indices& used, CameraPose& result) {
  if (used.size() == least_targets)
    result.findings.push_back(
        {Severity::warning, "pose",
         "four targets give a pose that hardly anything checks: a wrong one among them may not show",
         "put up more, around the camera"});
  constexpr double worse = 2.0, wrong = 5.0;
  if (result.sigma_factor > worse) {
    char words[160];
    std::snprintf(words, sizeof words,
                  "the targets fit %.1f times worse than their sigmas say; the pose's sigmas are as much greater",
                  result.sigma_factor);
    result.findings.push_back({result.sigma_factor > wrong ? Severity::decision : Severity::warning, "pose", words,
                               "calibrate the camera, and check the database"});
  }
  if (!result.flat) return;
  // The other pose of a plane: is it worse for certain?
  const auto other = adjust(scene, mirrored(adjusted.camera_from_site, chosen(scene.points, used)), used);
  if (!other || rotation_between_rad(other->camera_from_site, adjusted.camera_from_site) < 0.01) return;
  if (other->cost < adjusted.cost + 9.0 * std::max(1.0, std::pow(result.sigma_factor, 2)))
    result.findings.push_back({Severity::decision, "pose",
                               "the targets lie in one plane, and a second pose fits to them as well",
                               "put up a target before or behind the others"});
}

/// A table in millimetres or feet fits as well as one in metres: only the distances tell.
void check_distances(const Scene& scene, const Adjusted& adjusted, const Indices& used) {
  constexpr double least_m = 0.1, most_m = 300.0;
  std::vector<double> ranges_m;
  for (const std::size_t i : used) ranges_m.push_back((adjusted.camera_from_site * scene.points[i]).norm());
  const double usual_m = median(ranges_m);
  if (usual_m >= least_m && usual_m <= most_m) return;
  char words[120];
  std::snprintf(words, sizeof words, "the targets would be %.3g m from the camera", usual_m);
  throw Error(words, {}, "write the coordinates of their table in metres");
}

/// Four of many wrong targets fit some pose by chance, and a wrong focal length or zoom leaves the outer ones out: of
/// five one may be wrong, of eight three, of more three of ten.
void check_contradictions(const std::vector<LandmarkSight>& sights, const Indices& used) {
  const std::size_t left_out = sights.size() - used.size();
  const std::size_t few = std::min<std::size_t>(3, 2 * (used.size() - least_targets) + 1);
  if (left_out < used.size() && left_out <= std::max(few, 3 * sights.size() / 10)) return;
  std::string names;
  for (const std::size_t i : used) names += (names.empty() ? "" : ", ") + sights[i].id;
  throw Error(
      "the targets contradict one another: the pose that most of them fit holds for " + names + ", and the other " +
          std::to_string(left_out) + " speak against it",
      {},
      "check that the camera file is of this camera, its zoom and focus, and the database: east and north may be "
      "exchanged, ids wrong, targets moved");
}

}  // namespace

std::size_t CameraPose::used() const {
  return static_cast<std::size_t>(
      std::count_if(landmarks.begin(), landmarks.end(), [](const LandmarkResidual& one) { return one.used; }));
}

CameraPose locate_camera(const CameraLens& lens, const std::vector<LandmarkSight>& sights,
                         const CameraPoseOptions& options) {
  check_lens(lens);
  if (sights.size() < least_targets)
    throw Error("only " + std::to_string(sights.size()) + " targets of the database are seen; a pose needs four", {},
                "turn the camera to where more of them hang");
  const Scene scene = scene_of(lens, sights, options);
  Consensus consensus = consensus_of(scene);
  if (consensus.agreeing.size() < least_targets)
    throw Error(
        sights.size() == least_targets ? "no pose fits to the four targets"
                                       : "no pose fits to four of the " + std::to_string(sights.size()) + " targets",
        {}, "check their coordinates, that they do not hang on one line, and that the camera file is of this camera");
  Indices used = consensus.agreeing;
  const std::optional<Adjusted> adjusted = adjusted_without_blunders(scene, consensus.pose, used);
  if (!adjusted) throw Error("the targets determine no pose", {}, "put up more targets, around the camera");
  check_contradictions(sights, used);
  check_distances(scene, *adjusted, used);
  CameraPose result;
  result.site_from_camera = site_from_camera(scene, adjusted->camera_from_site);
  result.sigma_factor = std::sqrt(adjusted->cost / std::max(1.0, 2.0 * static_cast<double>(used.size()) - 6.0));
  const double factor = std::max(1.0, result.sigma_factor);
  const Matrix6d change = to_site(*adjusted);
  result.by_focal_length = change * by_focal_length(scene, *adjusted, used);
  result.covariance = factor * factor * change * adjusted->normal.inverse() * change.transpose() +
                      result.by_focal_length * result.by_focal_length.transpose();
  result.flat = flatness(chosen(scene.points, used)) < flat_points;
  add_residuals(scene, *adjusted, sights, used, result);
  const auto raw = posit(chosen(scene.points, used), chosen(scene.places, used));
  if (!raw.empty())
    result.posit = {site_from_camera(scene, raw.front().camera_from_site), raw.front().rms * lens.focal_px(),
                    raw.front().iterations};
  name_left_out(scene, *adjusted, sights, used, result);
  judge(scene, *adjusted, used, result);
  return result;
}

}  // namespace adit
