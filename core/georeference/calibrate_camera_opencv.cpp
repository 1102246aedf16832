#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/calib3d.hpp>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/georeference/board_checks.h"
#include "core/georeference/calibrate_camera.h"

namespace adit {
namespace {

constexpr std::size_t least_targets = 6, least_pictures = 4;

void judge(CameraCalibration& calibration, int width, int height, const std::vector<BoardPicture>& used) {
  constexpr double poor_rms_px = 0.5, poor_focal = 0.005, least_filled = 0.5, square_pixels = 0.001,
                   doubtful_rms_px = 0.15, worse = 3.0;
  char words[200];
  if (calibration.rms_px > poor_rms_px) {
    std::snprintf(words, sizeof words, "the pictures fit to %.2f pixels (rms) only", calibration.rms_px);
    calibration.findings.push_back(
        {Severity::decision, "calibration", words,
         "print the board on a stiff plane, measure it, and keep focus and zoom as they are"});
  }
  double variance = 0.0, n = 0.0;
  for (const BoardPicture& picture : used)
    for (const BoardSight& sight : picture.sights) variance += 2.0 * sight.sigma_px * sight.sigma_px, n += 1.0;
  const double expected_px = std::sqrt(variance / std::max(1.0, n));
  if (calibration.rms_px <= poor_rms_px && calibration.rms_px > doubtful_rms_px && expected_px > 0.0 &&
      calibration.rms_px > worse * expected_px) {
    std::snprintf(words, sizeof words, "the pictures fit to %.2f pixels (rms), the targets are seen to %.2f",
                  calibration.rms_px, expected_px);
    calibration.findings.push_back(
        {Severity::warning, "calibration", words,
         "measure the print both ways, keep it stiff and flat, and keep focus and zoom as they are"});
  }
  if (calibration.sigma_fx > poor_focal * calibration.lens.fx) {
    std::snprintf(words, sizeof words, "the focal length is known to %.1f %% only (one sigma)",
                  100.0 * calibration.sigma_fx / calibration.lens.fx);
    calibration.findings.push_back(
        {Severity::decision, "calibration", words, "take more pictures, the board tilted to all sides"});
  }
  const double apart = std::abs(calibration.lens.fx - calibration.lens.fy);
  if (apart >
      std::max(square_pixels * calibration.lens.fx, 4.0 * std::hypot(calibration.sigma_fx, calibration.sigma_fy))) {
    std::snprintf(
        words, sizeof words,
        "both focal lengths differ by %.2f %%: pixels are rarely so far from square, and the print may be longer one way",
        100.0 * apart / calibration.lens.fx);
    calibration.findings.push_back(
        {Severity::warning, "calibration", words, "measure the print both ways, and scale the columns of its table"});
  }
  Eigen::AlignedBox2d box;
  for (const BoardPicture& picture : used)
    for (const BoardSight& sight : picture.sights) box.extend(sight.pixel);
  const double filled = box.sizes().x() * box.sizes().y() / (static_cast<double>(width) * height);
  if (filled < least_filled) {
    std::snprintf(words, sizeof words, "the board was seen in %.0f %% of the picture only: the lens's rim is a guess",
                  100.0 * filled);
    calibration.findings.push_back({Severity::decision, "calibration", words, "move the board into every corner"});
  }
}

std::vector<BoardResidual> residuals_of(const std::vector<BoardPicture>& used,
                                        const std::vector<std::vector<cv::Point3f>>& board,
                                        const std::vector<cv::Mat>& turns, const std::vector<cv::Mat>& shifts,
                                        const cv::Mat& matrix, const cv::Mat& bends) {
  std::vector<BoardResidual> residuals;
  for (std::size_t i = 0; i < used.size(); ++i) {
    std::vector<cv::Point2f> computed;
    cv::projectPoints(board[i], turns[i], shifts[i], matrix, bends, computed);
    for (std::size_t k = 0; k < computed.size(); ++k) {
      const BoardSight& sight = used[i].sights[k];
      residuals.push_back({sight.id, sight.pixel - Eigen::Vector2f(computed[k].x, computed[k].y).cast<double>()});
    }
  }
  return residuals;
}

}  // namespace

CameraCalibration calibrate_camera(const std::vector<BoardPicture>& pictures, int width, int height) {
  CameraCalibration calibration;
  std::vector<BoardPicture> used;
  for (const BoardPicture& picture : pictures) {
    if (picture.sights.size() >= least_targets) {
      used.push_back(picture);
      continue;
    }
    calibration.findings.push_back(
        {Severity::warning, picture.name,
         "shows " + std::to_string(picture.sights.size()) + " targets of the board and is not used", "six are needed"});
  }
  if (used.size() < least_pictures)
    throw Error("only " + std::to_string(used.size()) + " pictures show six targets of the board or more", {},
                "take at least four, better fifteen, with the board tilted to all sides");
  check_board(used);
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardPicture& picture : used) {
    board.emplace_back();
    seen.emplace_back();
    for (const BoardSight& sight : picture.sights) {
      const Eigen::Vector3f at = sight.board.cast<float>();
      const Eigen::Vector2f pixel = sight.pixel.cast<float>();
      board.back().emplace_back(at.x(), at.y(), 0.0F);  // it is flat, wherever its zero is
      seen.back().emplace_back(pixel.x(), pixel.y());
    }
  }
  cv::Mat matrix, bends, sigmas, board_sigmas, per_picture;
  std::vector<cv::Mat> turns, shifts;
  try {
    calibration.rms_px = cv::calibrateCamera(board, seen, cv::Size(width, height), matrix, bends, turns, shifts, sigmas,
                                             board_sigmas, per_picture);
  } catch (const cv::Exception&) {
    throw Error("no camera fits to these pictures", {},
                "check that the board's coordinates are those of the printed one");
  }
  constexpr double no_camera_px = 2.0;
  if (!(calibration.rms_px < no_camera_px)) {
    char words[120];
    std::snprintf(words, sizeof words, "no camera fits to these pictures: the best one leaves %.1f pixels (rms)",
                  calibration.rms_px);
    throw Error(words, {}, "check the board's table against the print, and that focus and zoom stayed as they were");
  }
  double most_tilt = 0.0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    cv::Mat rotation;
    cv::Rodrigues(turns[i], rotation);
    const double tilt = std::acos(std::min(1.0, std::abs(rotation.at<double>(2, 2))));
    most_tilt = std::max(most_tilt, tilt);
    calibration.pictures.push_back(
        {used[i].name, per_picture.at<double>(static_cast<int>(i)), used[i].sights.size(), tilt});
  }
  constexpr double least_tilt_deg = 10.0;
  if (most_tilt < rad_from_deg(least_tilt_deg))
    throw Error(
        "the board was held square to the camera in all pictures: focal length and distance cannot be told apart", {},
        "tilt it by 30 degrees and more, to all sides");
  CameraLens& lens = calibration.lens;
  lens.width = width;
  lens.height = height;
  lens.fx = matrix.at<double>(0, 0);
  lens.fy = matrix.at<double>(1, 1);
  lens.cx = matrix.at<double>(0, 2);
  lens.cy = matrix.at<double>(1, 2);
  lens.k1 = bends.at<double>(0);
  lens.k2 = bends.at<double>(1);
  lens.p1 = bends.at<double>(2);
  lens.p2 = bends.at<double>(3);
  lens.k3 = bends.at<double>(4);
  check_lens(lens);
  calibration.sigma_fx = sigmas.at<double>(0);
  calibration.sigma_fy = sigmas.at<double>(1);
  constexpr double least_focal_sigma = 5e-5;  // warmth, and what the model of the lens leaves
  lens.focal_sigma =
      std::max(least_focal_sigma, std::max(calibration.sigma_fx, calibration.sigma_fy) / lens.focal_px());
  calibration.sigma_cx = sigmas.at<double>(2);
  calibration.sigma_cy = sigmas.at<double>(3);
  judge(calibration, width, height, used);
  for (Finding& finding : wrong_on_board(residuals_of(used, board, turns, shifts, matrix, bends)))
    calibration.findings.push_back(std::move(finding));
  return calibration;
}

}  // namespace adit
