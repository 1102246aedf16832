#include "render/section_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit::render {
namespace {

CellKind weaker(CellKind a, CellKind b) {
  const auto rank = [](CellKind k) { return k == CellKind::unseen ? 2 : k == CellKind::interpolated ? 1 : 0; };
  return rank(a) > rank(b) ? a : b;
}

struct RingFoot {
  std::size_t edge = 0;
  double share = 0.0;  ///< along the edge
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

RingFoot foot_on(const Polygon& ring, const Eigen::Vector2d& point) {
  RingFoot best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d edge = ring[(i + 1) % ring.size()] - a;
    const double length2 = edge.squaredNorm();
    const double share = length2 > 0.0 ? std::clamp((point - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
    const Eigen::Vector2d position = a + share * edge;
    const double distance2 = (point - position).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      best = {i, share, position};
    }
  }
  return best;
}

// Corners of the ring between two feet, in the ring's sense; none when the second lies (a little) before the first.
void follow(const Polygon& ring, const RingFoot& from, const RingFoot& to, Polygon& out) {
  const std::size_t n = ring.size();
  const std::size_t steps = (to.edge + n - from.edge) % n;
  if (steps > n / 2) return;
  for (std::size_t k = 1; k <= steps; ++k) out.push_back(ring[(from.edge + k) % n]);
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

Polygon outline_against(const std::vector<OutlinePoint>& outline, const Polygon& line) {
  Polygon ring;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (outline[i].kind != CellKind::unseen || line.empty()) {
      ring.push_back(outline[i].position);
      continue;
    }
    const RingFoot foot = foot_on(line, outline[i].position);
    ring.push_back(foot.position);
    const OutlinePoint& next = outline[(i + 1) % n];
    if (next.kind == CellKind::unseen) follow(line, foot, foot_on(line, next.position), ring);
  }
  return ring;
}

OverUnder over_under(const std::vector<OutlinePoint>& outline, const Polygon& line) {
  if (outline.size() < 3 || line.size() < 3) return {};
  const Polygon as_built = outline_against(outline, line);
  return {difference(as_built, line), difference(line, as_built)};
}

const OutlinePoint* outline_at(const std::vector<OutlinePoint>& outline, double p_m) {
  if (outline.empty()) return nullptr;
  return &*std::min_element(outline.begin(), outline.end(), [&](const OutlinePoint& a, const OutlinePoint& b) {
    return std::abs(a.p_m - p_m) < std::abs(b.p_m - p_m);
  });
}

}  // namespace adit::render
