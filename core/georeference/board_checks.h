#pragma once
// What can be wrong with the pictures of a calibration board.

#include <vector>

#include "core/foundation/finding.h"
#include "core/georeference/calibrate_camera.h"

namespace adit {

/// Throws Error for a board that is not flat (all at one elevation within 1 mm), or under 2 cm or over 20 m wide, and
/// for two pictures in which every target is seen at the same pixels: the same one under two names.
void check_board(const std::vector<BoardPicture>& pictures);

/// Seen less computed, of one target in one picture.
struct BoardResidual {
  int id = 0;
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();
};

/// Targets whose residuals are far beyond those of the others: they are not where the board's table says.
Findings wrong_on_board(const std::vector<BoardResidual>& residuals);

}  // namespace adit
