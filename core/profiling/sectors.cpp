#include "core/profiling/sectors.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "core/foundation/parallel.h"
#include "core/geometry/polygon.h"
#include "core/profiling/outline.h"

namespace adit {
namespace {

double clock_deg(const Eigen::Vector2d& normal) {
  return deg_from_rad(std::atan2(normal.x(), normal.y()));
}

bool holds(const Sector& sector, double clock) {
  if (sector.to_deg > sector.from_deg) return clock >= sector.from_deg && clock < sector.to_deg;
  return clock >= sector.from_deg || clock < sector.to_deg;
}

/// An outline point against a line: where the line is, and how far outside it the rock.
struct Ray {
  Eigen::Vector2d base, normal;
  double over_m;
  bool measured;
  Eigen::Vector2d rock() const { return base + over_m * normal; }
};

Ray ray_of(const OutlinePoint& point, double offset_m) {
  const bool unseen = !has_rock(point.kind);
  const Eigen::Vector2d base = point.position - (point.deviation_m - (unseen ? 0.0 : offset_m)) * point.normal;
  return {unseen ? Eigen::Vector2d(point.position + offset_m * point.normal) : base, point.normal,
          unseen ? 0.0 : point.deviation_m - offset_m, point.kind == CellKind::measured};
}

/// Between two rays on the same side of the line.
struct Slice {
  double thickness_m;
  SliceShape shape;
  double volume(const Polygon& ring) const {
    const AreaMoment amount = area_moment(ring);
    return std::abs(thickness_m * shape.of(amount.area_m2, amount.moment_m3, amount.moment_z_m3));
  }
};

void add_piece(const Ray& a, const Ray& b, const Slice& slice, SectorVolume& sector) {
  const auto add = [&](double over_m, const Polygon& ring) {
    (over_m > 0.0 ? sector.overbreak_m3 : sector.underbreak_m3) += slice.volume(ring);
  };
  if (a.over_m * b.over_m >= 0.0) {
    add(a.over_m + b.over_m, {a.base, a.rock(), b.rock(), b.base});
    return;
  }
  const double share = a.over_m / (a.over_m - b.over_m);
  const Eigen::Vector2d crossing = a.base + share * (b.base - a.base);
  add(a.over_m, {a.base, a.rock(), crossing});
  add(b.over_m, {b.base, b.rock(), crossing});
}

std::vector<SectorVolume> of_row(const DeviationMap& map, std::size_t r, const DesignTunnel& design,
                                 const DesignLine& line, const std::vector<Sector>& sectors, double thickness_m,
                                 double gap_m) {
  std::vector<SectorVolume> amounts(sectors.size());
  const double chainage = map.row_chainage(r);
  const std::vector<MapCell> row(map.cells.begin() + static_cast<std::ptrdiff_t>(r * map.columns),
                                 map.cells.begin() + static_cast<std::ptrdiff_t>((r + 1) * map.columns));
  const Outline outline = outline_of(row, ProfileStretch(design.profile_at(chainage)), map.step_q_m, gap_m);
  const Slice slice{thickness_m, design.slice_shape(chainage)};
  const std::size_t n = outline.points.size();
  const double offset_m = design.line_at(line, chainage).offset_m;
  for (std::size_t i = 0; i < n; ++i) {
    const Ray a = ray_of(outline.points[i], offset_m), b = ray_of(outline.points[(i + 1) % n], offset_m);
    SectorVolume& sector = amounts[sector_of(sectors, (a.normal + b.normal).normalized())];
    const double surface_m2 = thickness_m * (b.base - a.base).norm();
    sector.surface_m2 += surface_m2;
    if (a.measured) sector.measured_m2 += surface_m2;
    add_piece(a, b, slice, sector);
    if (!a.measured || a.over_m <= sector.max_overbreak_m) continue;
    sector.max_overbreak_m = a.over_m;
    sector.max_overbreak_chainage_m = chainage;
    sector.max_overbreak_clock_deg = clock_deg(a.normal);
  }
  return amounts;
}

/// Sums of rows, which keep the greatest of their maxima.
struct Sums {
  std::vector<SectorVolume> sectors;
  Sums& operator+=(const Sums& other) {
    for (std::size_t i = 0; i < sectors.size(); ++i) {
      SectorVolume& sum = sectors[i];
      const SectorVolume& more = other.sectors[i];
      sum.surface_m2 += more.surface_m2;
      sum.measured_m2 += more.measured_m2;
      sum.overbreak_m3 += more.overbreak_m3;
      sum.underbreak_m3 += more.underbreak_m3;
      if (more.max_overbreak_m <= sum.max_overbreak_m) continue;
      sum.max_overbreak_m = more.max_overbreak_m;
      sum.max_overbreak_chainage_m = more.max_overbreak_chainage_m;
      sum.max_overbreak_clock_deg = more.max_overbreak_clock_deg;
    }
    return *this;
  }
};

}  // namespace

std::size_t sector_of(const std::vector<Sector>& sectors, const Eigen::Vector2d& normal) {
  const double clock = clock_deg(normal);
  for (std::size_t i = 0; i < sectors.size(); ++i)
    if (holds(sectors[i], clock)) return i;
  return sectors.size() - 1;  // straight down, in a sector that ends there
}

std::vector<Sector> standard_sectors() {
  return {{"crown", -30.0, 30.0},    {"right shoulder", 30.0, 70.0}, {"right wall", 70.0, 135.0},
          {"invert", 135.0, -135.0}, {"left wall", -135.0, -70.0},   {"left shoulder", -70.0, -30.0}};
}

void check_sectors(const std::vector<Sector>& sectors) {
  if (sectors.empty()) throw Error("there is no sector", {}, "leave \"sectors\" out for the standard ones");
  std::set<std::string> names;
  std::vector<double> begins, ends;
  for (const Sector& sector : sectors) {
    if (sector.name.empty() || !names.insert(sector.name).second)
      throw Error("a sector needs a name of its own", {}, "name every sector");
    if (sector.name == "any")
      throw Error("a sector is named \"any\", which stands for all of them", {}, "name it otherwise");
    if (sector.from_deg == sector.to_deg)
      throw Error("the sector \"" + sector.name + "\" is empty", {}, "write different degrees");
    const auto one_down = [](double degrees) { return degrees == -180.0 ? 180.0 : degrees; };  // both are straight down
    begins.push_back(one_down(sector.from_deg));
    ends.push_back(one_down(sector.to_deg));
  }
  std::sort(begins.begin(), begins.end());
  std::sort(ends.begin(), ends.end());
  double total = 0.0;
  for (const Sector& sector : sectors)
    total += sector.to_deg - sector.from_deg + (sector.to_deg > sector.from_deg ? 0.0 : 360.0);
  if (begins != ends || std::abs(total - 360.0) > 1e-9)
    throw Error(
        "the sectors do not cover the whole profile once: together they span " + short_number(total) + " degrees", {},
        "let each sector begin where another one ends");
}

std::vector<SectorVolume> sector_volumes(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line,
                                         const std::vector<Sector>& sectors, double from_m, double to_m, double gap_m) {
  const Sums none{std::vector<SectorVolume>(sectors.size())};
  Sums sums = parallel_ordered_sum(map.rows, 4, none, [&](std::size_t begin, std::size_t end) {
    Sums part = none;
    for (std::size_t r = begin; r < end; ++r) {
      const double row_from = std::max(from_m, map.from_m + static_cast<double>(r) * map.step_s_m);
      const double row_to = std::min(to_m, map.from_m + static_cast<double>(r + 1) * map.step_s_m);
      if (row_to - row_from > 1e-12) part += Sums{of_row(map, r, design, line, sectors, row_to - row_from, gap_m)};
    }
    return part;
  });
  for (std::size_t i = 0; i < sectors.size(); ++i) sums.sectors[i].name = sectors[i].name;
  return sums.sectors;
}

}  // namespace adit
