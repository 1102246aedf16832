#include "core/registration/fit_check.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr std::size_t enough_points = 6000;
constexpr double surface_cell_m = 0.4;
constexpr double margin_m = 0.5;

struct Counts {
  double compared = 0.0;
  double agreeing = 0.0;
  double seen_through = 0.0;
  Counts& operator+=(const Counts& other) {
    compared += other.compared;
    agreeing += other.agreeing;
    seen_through += other.seen_through;
    return *this;
  }
};

/// The piece of surface whose middle is nearest.
const NormalDistribution* nearest_piece(const DistributionMap& cells, const Eigen::Vector3d& place) {
  const NormalDistribution* nearest = nullptr;
  double least = cells.cell_m() * cells.cell_m();
  cells.visit_near(place, [&](const NormalDistribution& piece) {
    const double squared = (piece.mean - place).squaredNorm();
    if (piece.flat && squared < least) {
      least = squared;
      nearest = &piece;
    }
  });
  return nearest;
}

Counts counted(const PreparedScan& of, const PreparedScan& in, const Pose& in_from_of, double near_m) {
  const std::size_t step = std::max<std::size_t>(1, of.points.size() / enough_points);
  const DistributionMap& cells = in.pyramid.levels[in.pyramid.level_near(surface_cell_m)];
  return parallel_ordered_sum(of.points.size() / step, 512, Counts{}, [&](std::size_t begin, std::size_t end) {
    Counts sums;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d place = in_from_of * of.points[i * step].cast<double>();
      if (const NormalDistribution* piece = nearest_piece(cells, place)) {
        const double off = std::abs(piece->normal.dot(place - piece->mean));
        sums.compared += 1.0;
        if (off < std::max(near_m, 3.0 * piece->thickness_m)) sums.agreeing += 1.0;
      } else if (in.ranges.sight_of(place, margin_m) == Sight::seen_through) {
        sums.compared += 1.0;
        sums.seen_through += 1.0;
      }
    }
    return sums;
  });
}

}  // namespace

FitCheck check_fit(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                   double near_m) {
  Counts counts = counted(source, target, target_from_source, near_m);
  counts += counted(target, source, target_from_source.inverse(), near_m);
  const double all = std::max(1.0, counts.compared);
  return {counts.compared, counts.agreeing / all, counts.seen_through / all};
}

}  // namespace adit
