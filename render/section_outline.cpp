#include "render/section_outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/profiling/outline.h"

namespace adit::render {
namespace {

CellKind weaker(CellKind a, CellKind b) {
  const auto rank = [](CellKind k) { return has_rock(k) ? (k == CellKind::interpolated ? 1 : 0) : 2; };
  return rank(a) > rank(b) ? a : b;
}

double distance_to(const Eigen::Vector2d& point, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length2 = edge.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((point - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (point - a - share * edge).norm();
}

}  // namespace

std::vector<OutlineRun> outline_runs(const std::vector<OutlinePoint>& outline) {
  const std::size_t n = outline.size();
  if (n < 2) return {};
  const auto kind_of = [&](std::size_t i) { return weaker(outline[i % n].kind, outline[(i + 1) % n].kind); };
  std::size_t start = 0;
  while (start < n && kind_of(start + n - 1) == kind_of(start)) ++start;
  if (start == n) start = 0;
  std::vector<OutlineRun> runs;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (runs.empty() || runs.back().kind != kind_of(i)) runs.push_back({kind_of(i), {outline[i].position}});
    runs.back().points.push_back(outline[(i + 1) % n].position);
  }
  return runs;
}

OverUnder over_under(const std::vector<OutlinePoint>& outline, const Polygon& line, double offset_m) {
  if (outline.size() < 3 || line.size() < 3) return {};
  const Polygon as_built = polygon_of(outline, offset_m);
  return {difference(as_built, line), difference(line, as_built)};
}

Polygon thinned(const Polygon& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<char> kept(points.size(), 0);
  kept.front() = kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, points.size() - 1}};
  while (!stretches.empty()) {
    const auto [from, to] = stretches.back();
    stretches.pop_back();
    std::size_t worst = from;
    double farthest = tolerance;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double distance = distance_to(points[i], points[from], points[to]);
      if (distance > farthest) {
        farthest = distance;
        worst = i;
      }
    }
    if (worst == from) continue;
    kept[worst] = 1;
    stretches.emplace_back(from, worst);
    stretches.emplace_back(worst, to);
  }
  Polygon result;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i] != 0) result.push_back(points[i]);
  return result;
}

const OutlinePoint* outline_at(const std::vector<OutlinePoint>& outline, double p_m) {
  if (outline.empty()) return nullptr;
  return &*std::min_element(outline.begin(), outline.end(), [&](const OutlinePoint& a, const OutlinePoint& b) {
    return std::abs(a.p_m - p_m) < std::abs(b.p_m - p_m);
  });
}

}  // namespace adit::render
