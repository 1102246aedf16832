#include "core/registration/picture_findings.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double wrong_misfit = 27.0;  // of six sigmas squared: one in 7,000

double normalised_of(double misfit) {
  return std::sqrt(misfit / 6.0);
}

double largest_sigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(2)));
}

PictureResult picture_of(const CameraSight& sight, const RegistrationContext& context) {
  PictureResult picture;
  picture.scan = sight.scan;
  picture.picture = sight.picture;
  picture.camera = context.cameras[sight.camera].name;
  picture.located = true;
  picture.local_from_camera = sight.local_from_camera;
  picture.sigma_m = largest_sigma(sight.covariance.topLeftCorner<3, 3>());
  picture.sigma_rad = largest_sigma(sight.covariance.bottomRightCorner<3, 3>());
  return picture;
}

void report_wrong(const PictureResult& picture, Findings& findings) {
  char words[200];
  std::snprintf(words, sizeof words,
                "puts its camera %.1f mm and %.3f degrees from where the rest puts it: %.1f times what its sigmas "
                "explain",
                1e3 * picture.residual_m.norm(), deg_from_rad(picture.turned_rad.norm()), picture.normalised);
  findings.push_back({Severity::decision, "picture " + picture.picture, words,
                      "check whether it was taken during scan " + picture.scan +
                          ", its targets' coordinates, and how its camera sits"});
}

/// Where the adjustment puts a camera that it was not told of by this picture.
void measure_against_rest(PictureResult& picture, const PoseGraphResult& solved, const GraphSight& sight) {
  const Pose rest = solved.local_from_scan[sight.node] * solved.scan_from_camera[sight.camera];
  picture.residual_m = picture.local_from_camera.translation() - rest.translation();
  picture.turned_rad = rotation_vector(picture.local_from_camera.linear() * rest.linear().transpose());
  Vector6d off;
  off << picture.turned_rad, picture.residual_m;
  picture.normalised = normalised_of(off.dot(sight.information * off));
}

/// Those of which a picture took part.
void report_cameras(RegistrationResult& result, const PoseGraphResult& solved, const RegistrationContext& context) {
  for (std::size_t i = 0; i < context.cameras.size(); ++i) {
    if (std::none_of(result.pictures.begin(), result.pictures.end(), [&](const PictureResult& picture) {
          return picture.used && picture.camera == context.cameras[i].name;
        }))
      continue;
    const RigCamera& said = context.cameras[i];
    CameraResult camera{said.name, solved.scan_from_camera[i], 0.0, 0.0, normalised_of(solved.camera_misfit[i])};
    camera.moved_m = distance_between_m(camera.scan_from_camera, said.scan_from_camera);
    camera.moved_rad = rotation_between_rad(camera.scan_from_camera, said.scan_from_camera);
    result.cameras.push_back(camera);
    if (solved.camera_misfit[i] <= wrong_misfit) continue;
    char words[200];
    std::snprintf(words, sizeof words,
                  "sits %.1f mm and %.3f degrees from where the job says, %.1f times what its sigmas explain",
                  1e3 * camera.moved_m, deg_from_rad(camera.moved_rad), camera.normalised);
    result.findings.push_back({Severity::decision, "camera " + camera.camera, words,
                               "check its position and angles in job.json, and whether it was mounted anew"});
  }
}

}  // namespace

void report_pictures(RegistrationResult& result, const Adjustment& adjustment, const PoseGraphResult& solved,
                     const PoseGraph& graph, const std::vector<Node>& nodes, const RegistrationContext& context) {
  // The graph has the pictures of the scans that take part, scan by scan; the job's order is what a reader looks for.
  std::vector<std::vector<std::size_t>> of_scan(nodes.size());
  for (std::size_t k = 0; k < graph.sights.size(); ++k) of_scan[graph.sights[k].node].push_back(k);
  std::vector<std::size_t> next(nodes.size(), 0);
  for (const CameraSight& sight : context.pictures) {
    PictureResult picture = picture_of(sight, context);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].prepared->name != sight.scan) continue;
      const std::size_t k = of_scan[i][next[i]++];
      measure_against_rest(picture, solved, graph.sights[k]);
      picture.used = adjustment.sight_used[k];
      if (picture.used && 6.0 * picture.normalised * picture.normalised > wrong_misfit)
        report_wrong(picture, result.findings);
    }
    result.pictures.push_back(picture);
  }
  report_cameras(result, solved, context);
  const bool any =
      std::any_of(adjustment.sight_used.begin(), adjustment.sight_used.end(), [](bool used) { return used; });
  if (any && graph.control.empty())
    result.findings.push_back(
        {Severity::warning, "pictures",
         "only they tie the survey to the site: nothing here checks that each is of its scan, how the camera sits, and its "
         "focal length, which move everything with them",
         "survey three targets that the scans see, or measure the lever arm in a job with control"});
}

namespace {

/// Whether any of the clouds, the scan's targets or a second picture say where a scan stands, beside its picture.
bool is_checked(const RegistrationResult& result, const Node& node, const std::string& scan) {
  return !node.control.empty() || node.sights.size() > 1 ||
         std::any_of(result.pairs.begin(), result.pairs.end(), [&](const PairResult& pair) {
           return pair.used && pair.undetermined.empty() && (pair.source == scan || pair.target == scan);
         });
}

}  // namespace

void compare_guesses_with_pictures(RegistrationResult& result, const std::vector<ScanToPlace>& scans,
                                   const std::vector<Node>& nodes, const RegistrationOptions& options) {
  for (const Node& node : nodes) {
    const auto& guess = scans[node.scan].local_from_scan_guess;
    if (node.sights.empty()) continue;
    if (!guess) {
      if (!is_checked(result, node, scans[node.scan].name))
        result.findings.push_back({Severity::warning, "scan " + scans[node.scan].name,
                                   "only its picture says where it stands: nothing checks that the picture is of this "
                                   "scan, and how its camera sits",
                                   "give it a pose in job.json, control, or scans around that overlap with it"});
      continue;
    }
    const Pose& placed = result.scans[node.scan].local_from_scan;
    const double moved_m = distance_between_m(*guess, placed);
    const double turned_deg = deg_from_rad(rotation_between_rad(*guess, placed));
    if (moved_m <= 3.0 * options.guess_sigma_m && turned_deg <= 3.0 * options.guess_sigma_deg) continue;
    char words[200];
    std::snprintf(words, sizeof words,
                  "its picture puts it %.2f m and %.1f degrees from its guess, more than three times what guesses are "
                  "worth",
                  moved_m, turned_deg);
    result.findings.push_back({Severity::decision, "scan " + scans[node.scan].name, words,
                               "check its pose in job.json, and whether the picture was taken during this scan"});
  }
}

}  // namespace adit
