// Boolean operations through Clipper: integer arithmetic on a micrometre grid, so no degenerate case can fail.

#include <cmath>
#include <polyclipping/clipper.hpp>

#include "core/foundation/error.h"
#include "core/geometry/polygon.h"

namespace adit {
namespace {

constexpr double units_per_m = 1e6;

ClipperLib::Path to_path(const Polygon& ring) {
  ClipperLib::Path path;
  path.reserve(ring.size());
  for (const auto& p : ring) {
    if (!(p.cwiseAbs().maxCoeff() < 1000.0)) throw Error("a section outline reaches further than 1000 m from the axis");
    path.emplace_back(std::llround(p.x() * units_per_m), std::llround(p.y() * units_per_m));
  }
  return path;
}

std::vector<Polygon> to_polygons(const ClipperLib::Paths& paths) {
  std::vector<Polygon> polygons;
  for (const auto& path : paths) {
    Polygon ring;
    ring.reserve(path.size());
    for (const auto& p : path)
      ring.emplace_back(static_cast<double>(p.X) / units_per_m, static_cast<double>(p.Y) / units_per_m);
    polygons.push_back(std::move(ring));
  }
  return polygons;
}

}  // namespace

std::vector<Polygon> difference(const Polygon& a, const Polygon& b) {
  ClipperLib::Clipper clipper;
  ClipperLib::Paths result;
  if (a.size() < 3) return {};
  clipper.AddPath(to_path(a), ClipperLib::ptSubject, true);
  if (b.size() >= 3) clipper.AddPath(to_path(b), ClipperLib::ptClip, true);
  clipper.Execute(ClipperLib::ctDifference, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return to_polygons(result);
}

std::vector<Polygon> offset_ring(const Polygon& ring, double distance_m) {
  ClipperLib::Path path = to_path(ring);
  if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
  ClipperLib::ClipperOffset offset(2.0, 20.0);
  offset.AddPath(path, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  offset.Execute(result, distance_m * units_per_m);
  return to_polygons(result);
}

}  // namespace adit
