#include "core/profiling/round_review.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/foundation/angle.h"
#include "core/profiling/outline.h"
#include "core/profiling/overbreak.h"

namespace adit {
namespace {

constexpr std::size_t least_rows = 3, least_cells = 10;
constexpr double block_m = 3.0;  // of the contour: farther rock is taken as independent

double standard_deviation(const std::vector<double>& values) {
  double mean = 0.0, sum = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// A straight line through mean deviations over the chainage.
struct Regression {
  std::vector<double> s, d;

  struct Line {
    double middle_s, middle_d, slope;
  };
  std::optional<Line> line() const {
    const auto n = static_cast<double>(s.size());
    Line fit{0.0, 0.0, 0.0};
    double ss = 0.0, sd = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      fit.middle_s += s[i] / n;
      fit.middle_d += d[i] / n;
    }
    for (std::size_t i = 0; i < s.size(); ++i) {
      ss += (s[i] - fit.middle_s) * (s[i] - fit.middle_s);
      sd += (s[i] - fit.middle_s) * (d[i] - fit.middle_d);
    }
    if (s.size() < least_rows || ss <= 0.0) return std::nullopt;
    fit.slope = sd / ss;
    return fit;
  }
};

/// Standard deviation of the mean slope, from how much the slopes of blocks of the contour differ. Rows beside each
/// other are the same rock and would promise far too much.
double sigma_of_slopes(const std::vector<Regression>& blocks) {
  std::vector<double> slopes;
  for (const Regression& block : blocks)
    if (const auto line = block.line()) slopes.push_back(line->slope);
  if (slopes.size() < 3) return RoundReview::unknown;
  return standard_deviation(slopes) / std::sqrt(static_cast<double>(slopes.size()));
}

/// Length of the outline and of the line over the measured pieces.
double contour_ratio(const Outline& outline, double offset_m) {
  double rock = 0.0, line = 0.0;
  for (std::size_t i = 0; i + 1 < outline.points.size(); ++i) {
    const OutlinePoint &a = outline.points[i], &b = outline.points[i + 1];
    if (a.kind != CellKind::measured || b.kind != CellKind::measured) continue;
    const auto base = [&](const OutlinePoint& p) -> Eigen::Vector2d {
      return p.position - (p.deviation_m - offset_m) * p.normal;
    };
    rock += (b.position - a.position).norm();
    line += (base(b) - base(a)).norm();
  }
  return line > 0.0 ? rock / line : RoundReview::unknown;
}

}  // namespace

RoundReview review_round(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line, double from_m,
                         double to_m, double gap_m) {
  const double downwards = std::cos(rad_from_deg(105.0));
  Regression regression;
  std::vector<Regression> blocks;
  std::vector<double> ratios, over_areas;
  std::size_t cells = 0, outside = 0;
  double depth = 0.0;
  for (std::size_t r = 0; r < map.rows; ++r) {
    const double chainage = map.row_chainage(r);
    if (chainage < from_m || chainage > to_m) continue;
    const Profile& profile = design.profile_at(chainage);
    const ProfileStretch stretch(profile);
    const std::vector<MapCell> row(map.cells.begin() + static_cast<std::ptrdiff_t>(r * map.columns),
                                   map.cells.begin() + static_cast<std::ptrdiff_t>((r + 1) * map.columns));
    const Outline outline = outline_of(row, stretch, map.step_q_m, gap_m);
    const DesignLine here = design.line_at(line, chainage);
    double sum = 0.0;
    std::size_t seen = 0;
    std::vector<std::pair<double, std::size_t>> of_block(static_cast<std::size_t>(profile.length_m() / block_m) + 1);
    for (std::size_t c = 0; c < outline.cells.size(); ++c) {
      const double q = std::min((static_cast<double>(c) + 0.5) * map.step_q_m, stretch.length_m());
      if (outline.cells[c].kind != CellKind::measured || stretch.at(q).normal.y() < downwards) continue;
      const double over = static_cast<double>(outline.cells[c].deviation_m) - here.offset_m;
      sum += over;
      ++seen;
      auto& [block_sum, block_seen] =
          of_block[static_cast<std::size_t>((stretch.at(q).p_m + 0.5 * profile.length_m()) / block_m)];
      block_sum += over;
      ++block_seen;
      if (over > 0.0) depth += over;
      outside += over > 0.0 ? 1 : 0;
    }
    cells += seen;
    if (seen < least_cells) continue;
    blocks.resize(std::max(blocks.size(), of_block.size()));
    for (std::size_t b = 0; b < of_block.size(); ++b) {
      if (of_block[b].second < least_cells) continue;
      blocks[b].s.push_back(chainage);
      blocks[b].d.push_back(of_block[b].first / static_cast<double>(of_block[b].second));
    }
    regression.s.push_back(chainage);
    regression.d.push_back(sum / static_cast<double>(seen));
    ratios.push_back(contour_ratio(outline, here.offset_m));
    over_areas.push_back(slice_amounts(outline.points, line_polygon(profile, here)).over.area_m2);
  }
  RoundReview review;
  const auto fit = regression.line();
  if (!fit) return review;
  review.lookout_per_m = fit->slope;
  review.lookout_sigma_per_m = sigma_of_slopes(blocks);
  review.lookout_collar_m = fit->middle_d + fit->slope * (from_m - fit->middle_s);
  review.lookout_toe_m = fit->middle_d + fit->slope * (to_m - fit->middle_s);
  review.contour_ratio = 0.0;
  for (const double ratio : ratios) review.contour_ratio += ratio / static_cast<double>(ratios.size());
  review.overbreak_area_sd_m2 = standard_deviation(over_areas);
  review.affected_share = static_cast<double>(outside) / static_cast<double>(cells);
  review.mean_overbreak_m = outside > 0 ? depth / static_cast<double>(outside) : 0.0;
  return review;
}

}  // namespace adit
