#include "core/georeference/board_checks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "core/foundation/error.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

bool same_pixels(const BoardPicture& a, const BoardPicture& b) {
  return a.sights.size() == b.sights.size() &&
         std::equal(a.sights.begin(), a.sights.end(), b.sights.begin(),
                    [](const BoardSight& p, const BoardSight& q) { return p.board == q.board && p.pixel == q.pixel; });
}

}  // namespace

void check_board(const std::vector<BoardPicture>& pictures) {
  constexpr double least_m = 0.02, most_m = 20.0, flat_m = 0.001;
  Eigen::AlignedBox3d box;
  for (const BoardPicture& picture : pictures)
    for (const BoardSight& sight : picture.sights) box.extend(sight.board);
  const double wide_m = box.sizes().head<2>().norm();
  if (!(wide_m >= least_m && wide_m <= most_m)) {
    char words[120];
    std::snprintf(words, sizeof words, "the board is %.3g m wide", wide_m);
    throw Error(words, {}, "write its table in metres");
  }
  if (box.sizes().z() > flat_m)
    throw Error("the targets of the board lie at different elevations", {}, "use a flat board, all at elevation 0");
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (same_pixels(pictures[i], pictures[k]))
        throw Error("it shows the same as " + pictures[k].name + ", to the last digit", pictures[i].name,
                    "name each picture once");
}

Findings wrong_on_board(const std::vector<BoardResidual>& residuals) {
  constexpr double most_times = 3.0, least_rms_px = 0.3;
  constexpr int least_pictures = 3;
  struct Sum {
    double squares = 0.0;
    int count = 0;
    double rms_px() const { return std::sqrt(squares / std::max(1, count)); }
  };
  std::map<int, Sum> of_target;
  for (const BoardResidual& one : residuals) {
    of_target[one.id].squares += one.off_px.squaredNorm();
    ++of_target[one.id].count;
  }
  std::vector<double> all;
  for (const auto& [id, sum] : of_target) all.push_back(sum.rms_px());
  if (all.empty()) return {};
  const double usual_px = median(all);
  Findings findings;
  for (const auto& [id, sum] : of_target) {
    if (sum.count < least_pictures || sum.rms_px() < std::max(least_rms_px, most_times * usual_px)) continue;
    char words[160];
    std::snprintf(words, sizeof words, "fits to %.2f pixels only, where %.2f are usual: it is not where the table says",
                  sum.rms_px(), usual_px);
    findings.push_back({Severity::decision, "target " + std::to_string(id), words,
                        "measure the print, and correct the board's table"});
  }
  return findings;
}

}  // namespace adit
