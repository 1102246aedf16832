#include "core/design/profile_checks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

constexpr double join_m = 1e-3;
constexpr double shortest_m = 1e-4;
constexpr double touch_m = 1e-7;
constexpr double crossing_flatness_m = 1e-3;
constexpr double least_area_m2 = 0.01;
constexpr double largest_bulge = 50.0;
constexpr double largest_m = 500.0;

struct NumberedSegment {
  ProfileSegment segment;
  std::size_t number;
};
using NumberedRing = std::vector<NumberedSegment>;

std::string rounded(double value) {
  return short_number(std::round(value * 1000.0) / 1000.0);
}

std::string place(const Eigen::Vector2d& p) {
  return "(" + rounded(p.x()) + ", " + rounded(p.y()) + ") m";
}

std::string segment_name(const NumberedSegment& s) {
  return "segment " + std::to_string(s.number);
}

void check_numbers(const NumberedSegment& s) {
  if (!s.segment.start.allFinite() || !s.segment.end.allFinite() || !std::isfinite(s.segment.bulge)) {
    throw Error(segment_name(s) + " of the profile holds a number that is not finite");
  }
  if (std::abs(s.segment.bulge) > largest_bulge) {
    throw Error(segment_name(s) + " of the profile is nearly a full circle, at " + place(s.segment.start), {},
                "give a circle as two half circles");
  }
}

void check_size(const NumberedRing& ring) {
  Eigen::AlignedBox2d box;
  for (const NumberedSegment& s : ring) box.extend(ProfilePiece(s.segment).box());
  if (box.sizes().maxCoeff() <= largest_m) return;
  throw Error("the profile is " + rounded(box.sizes().x()) + " m wide and " + rounded(box.sizes().y()) + " m high", {},
              "check its unit: metres are needed");
}

/// Throws at the first joint that is wider than 1 mm; a line with a single gap is called open.
void check_joints(const NumberedRing& ring) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& next = ring[(i + 1) % ring.size()];
    if ((next.segment.start - ring[i].segment.end).norm() > join_m) gaps.push_back(i);
  }
  if (gaps.empty()) return;
  const NumberedSegment& before = ring[gaps.front()];
  const NumberedSegment& behind = ring[(gaps.front() + 1) % ring.size()];
  const std::string width = rounded((behind.segment.start - before.segment.end).norm());
  if (gaps.size() == 1) {
    throw Error("the profile is open: from " + place(before.segment.end) + " to " + place(behind.segment.start) +
                    " there are " + width + " m without a line",
                {}, "close the line along the floor");
  }
  throw Error(segment_name(before) + " and " + segment_name(behind) + " of the profile do not join: " + width +
                  " m between " + place(before.segment.end) + " and " + place(behind.segment.start),
              {}, "let every segment start where the one before it ends");
}

NumberedRing joined(const std::vector<ProfileSegment>& segments) {
  NumberedRing ring;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const NumberedSegment s{segments[i], i + 1};
    check_numbers(s);
    if ((s.segment.end - s.segment.start).norm() >= shortest_m) ring.push_back(s);
  }
  if (ring.size() < 2)
    throw Error("the profile has no inside: it needs at least two segments", {}, "draw a closed line");
  check_joints(ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    ring[(i + 1) % ring.size()].segment.start = ring[i].segment.end;
  }
  std::erase_if(ring, [](const NumberedSegment& s) { return (s.segment.end - s.segment.start).norm() < shortest_m; });
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i].segment.end = ring[(i + 1) % ring.size()].segment.start;
  return ring;
}

struct Edge {
  Eigen::Vector2d a, b;
  std::size_t in_ring;
};

std::vector<Edge> flattened(const NumberedRing& ring) {
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < ring.size(); ++r) {
    const ProfilePiece piece(ring[r].segment);
    int n = 1;
    if (piece.is_arc()) {
      const double step = 2.0 * std::acos(std::max(0.0, 1.0 - crossing_flatness_m / piece.radius_m));
      n = std::max(2, static_cast<int>(std::ceil(2.0 * piece.half_sweep_rad / step)));
    }
    Eigen::Vector2d from = piece.start;
    for (int i = 1; i <= n; ++i) {
      const Eigen::Vector2d to = i == n ? piece.end : piece.position(piece.half_length_m * (2.0 * i / n - 1.0));
      edges.push_back({from, to, r});
      from = to;
    }
  }
  return edges;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distance(const Eigen::Vector2d& point, const Edge& edge) {
  const Eigen::Vector2d ab = edge.b - edge.a;
  const double t = std::clamp((point - edge.a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (edge.a + t * ab - point).norm();
}

/// Where two edges cross or touch.
std::optional<Eigen::Vector2d> meeting(const Edge& e, const Edge& f) {
  const auto apart = [](double a1, double a2, double b1, double b2) {
    return std::max(a1, a2) < std::min(b1, b2) - touch_m || std::max(b1, b2) < std::min(a1, a2) - touch_m;
  };
  if (apart(e.a.x(), e.b.x(), f.a.x(), f.b.x()) || apart(e.a.y(), e.b.y(), f.a.y(), f.b.y())) return std::nullopt;
  for (const Eigen::Vector2d& p : {f.a, f.b}) {
    if (distance(p, e) < touch_m) return p;
  }
  for (const Eigen::Vector2d& p : {e.a, e.b}) {
    if (distance(p, f) < touch_m) return p;
  }
  const Eigen::Vector2d r = e.b - e.a;
  const Eigen::Vector2d s = f.b - f.a;
  const double turn = cross(r, s);
  if (turn == 0.0) return std::nullopt;
  const double t = cross(f.a - e.a, s) / turn;
  const double u = cross(f.a - e.a, r) / turn;
  if (t < 0.0 || t > 1.0 || u < 0.0 || u > 1.0) return std::nullopt;
  return e.a + t * r;
}

/// True when the second edge runs back over the first, from their common point.
bool folds_back(const Edge& e, const Edge& f) {
  const Eigen::Vector2d r = (e.b - e.a).normalized();
  const Eigen::Vector2d s = (f.b - f.a).normalized();
  return r.dot(s) < 0.0 && std::abs(cross(r, s)) < 1e-6;
}

[[noreturn]] void refuse_crossing(const NumberedSegment& a, const NumberedSegment& b, const Eigen::Vector2d& at) {
  throw Error(
      "the profile crosses or touches itself: " + segment_name(a) + " meets " + segment_name(b) + " at " + place(at),
      {}, "draw the line once around without crossing");
}

void check_crossings(const NumberedRing& ring) {
  const std::vector<Edge> edges = flattened(ring);
  const std::size_t n = edges.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Edge& next = edges[(i + 1) % n];
    if (folds_back(edges[i], next)) refuse_crossing(ring[edges[i].in_ring], ring[next.in_ring], edges[i].b);
  }
  // From left to right: an edge is compared with those that begin before it ends.
  const auto left = [&](std::size_t i) { return std::min(edges[i].a.x(), edges[i].b.x()); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  for (std::size_t a = 0; a < n; ++a) {
    const Edge& edge = edges[order[a]];
    const double right = std::max(edge.a.x(), edge.b.x()) + touch_m;
    for (std::size_t b = a + 1; b < n && left(order[b]) <= right; ++b) {
      const auto [first, second] = std::minmax(order[a], order[b]);
      if (second - first == 1 || second - first == n - 1) continue;  // neighbours share their joint
      if (const auto at = meeting(edges[first], edges[second])) {
        refuse_crossing(ring[edges[first].in_ring], ring[edges[second].in_ring], *at);
      }
    }
  }
}

}  // namespace

std::vector<ProfileSegment> checked_ring(const std::vector<ProfileSegment>& segments) {
  const NumberedRing ring = joined(segments);
  check_size(ring);
  check_crossings(ring);
  std::vector<ProfileSegment> plain;
  for (const NumberedSegment& s : ring) plain.push_back(s.segment);
  const double area = std::abs(signed_area_m2(plain));
  if (!(area >= least_area_m2)) {
    throw Error("the profile has no inside: its area is " + short_number(area) + " m2", {},
                "check the unit of the profile");
  }
  return plain;
}

}  // namespace adit
