#include "core/profiling/volume.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/foundation/parallel.h"
#include "core/profiling/outline.h"
#include "core/profiling/overbreak.h"
#include "core/profiling/profiling.h"
#include "core/profiling/uncertainty.h"

namespace adit {
namespace {

void add_weighted(VolumeAmounts& sum, double weight, const VolumeAmounts& amounts) {
  sum.design_m3 += weight * amounts.design_m3;
  sum.excavated_m3 += weight * amounts.excavated_m3;
  sum.overbreak_m3 += weight * amounts.overbreak_m3;
  sum.underbreak_m3 += weight * amounts.underbreak_m3;
}

struct SliceSums {
  VolumeAmounts amounts;
  double measured_m2 = 0.0;
  double interpolated_m2 = 0.0;
  double unseen_m2 = 0.0;
  double opening_m2 = 0.0;

  SliceSums& operator+=(const SliceSums& other) {
    add_weighted(amounts, 1.0, other.amounts);
    measured_m2 += other.measured_m2;
    interpolated_m2 += other.interpolated_m2;
    unseen_m2 += other.unseen_m2;
    opening_m2 += other.opening_m2;
    return *this;
  }
};

/// One profile with its stretch and its line, made once.
struct LineOfProfile {
  const Profile* profile;
  ProfileStretch stretch;
  LinePolygon line;
};

std::vector<LineOfProfile> lines_of(const DesignTunnel& design, const DesignLine& line) {
  std::vector<LineOfProfile> lines;
  for (const auto& stepped : design.profiles())
    lines.push_back({&stepped.profile, ProfileStretch(stepped.profile), line_polygon(stepped.profile, line)});
  return lines;
}

/// Where profiles change within a stretch, with both its ends.
std::vector<double> parts_of(const DesignTunnel& design, double from_m, double to_m) {
  std::vector<double> bounds{from_m};
  for (const ProfileFrom& profile : design.profiles())
    if (profile.from_m > from_m && profile.from_m < to_m) bounds.push_back(profile.from_m);
  bounds.push_back(to_m);
  return bounds;
}

const LineOfProfile& line_at(const std::vector<LineOfProfile>& lines, const DesignTunnel& design, double chainage_m) {
  const Profile* profile = &design.profile_at(chainage_m);
  return *std::find_if(lines.begin(), lines.end(), [&](const LineOfProfile& l) { return l.profile == profile; });
}

/// One row of the map over the part of its thickness that lies in [from, to].
SliceSums slice_sums(const DeviationMap& map, std::size_t r, const DesignTunnel& design,
                     const std::vector<LineOfProfile>& lines, double from_m, double to_m,
                     const ProfilingOptions& options) {
  SliceSums sums;
  const double begin = std::max(from_m, map.from_m + static_cast<double>(r) * map.step_s_m);
  const double end = std::min(to_m, map.from_m + static_cast<double>(r + 1) * map.step_s_m);
  if (end - begin <= 1e-12) return sums;
  const double ds = end - begin;
  const double chainage = map.row_chainage(r);
  const LineOfProfile& line = line_at(lines, design, chainage);
  const std::vector<MapCell> row(map.cells.begin() + static_cast<std::ptrdiff_t>(r * map.columns),
                                 map.cells.begin() + static_cast<std::ptrdiff_t>((r + 1) * map.columns));
  const Outline outline = outline_of(row, line.stretch, map.step_q_m, options.gap_m);
  const SliceShape shape = design.slice_shape(chainage);
  std::optional<LinePolygon> grown;
  // One rock for the whole slice, and each of the profiles that hold in it for its own part.
  const std::vector<double> bounds = parts_of(design, begin, end);
  for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
    const double length_m = bounds[part + 1] - bounds[part];
    const double middle_m = 0.5 * (bounds[part] + bounds[part + 1]);
    const LineOfProfile& prepared = line_at(lines, design, middle_m);
    const DesignLine& wanted = prepared.line.line;
    if (wanted.growth_per_m != 0.0) grown = line_polygon(*prepared.profile, design.line_at(wanted, middle_m));
    const LinePolygon& there = grown ? *grown : prepared.line;
    const SliceAmounts amounts = slice_amounts(outline.points, there);
    const auto volume = [&](const AreaMoment& a) { return length_m * shape.of(a.area_m2, a.moment_m3, a.moment_z_m3); };
    add_weighted(sums.amounts, 1.0,
                 {volume(there.design), volume(amounts.area), volume(amounts.over), volume(amounts.under)});
  }
  sums.measured_m2 = ds * outline.measured_m;
  sums.interpolated_m2 = ds * outline.interpolated_m;
  sums.unseen_m2 = ds * outline.unseen_m;
  sums.opening_m2 = ds * outline.opening_m;
  return sums;
}

VolumeAmounts amounts_of(const Section& section, const std::string& line) {
  for (const SectionAreas& areas : section.lines)
    if (areas.line == line) return {areas.design_area_m2, areas.area_m2, areas.overbreak_m2, areas.underbreak_m2};
  return {};
}

/// Both methods on over and under separately; sections at the ends, every interval, and half-way for the prismoid.
void add_section_methods(Volume& volume, const DeviationMap& map, const DesignTunnel& design, double interval_m,
                         const ProfilingOptions& options) {
  const std::vector<double> chainages = section_chainages(volume.from_m, volume.to_m, interval_m);
  const std::size_t intervals = chainages.size() - 1;
  std::vector<VolumeAmounts> at(2 * intervals + 1);
  parallel_for_each_index(
      at.size(),
      [&](std::size_t i) {
        const double chainage = i % 2 == 0 ? chainages[i / 2] : 0.5 * (chainages[i / 2] + chainages[i / 2 + 1]);
        at[i] = amounts_of(cut_section(map, design, chainage, options), volume.line);
      },
      1);
  for (std::size_t i = 0; i < intervals; ++i) {
    const double length = chainages[i + 1] - chainages[i];
    for (const std::size_t end : {2 * i, 2 * i + 2}) {
      add_weighted(volume.average_end_area, length / 2.0, at[end]);
      add_weighted(volume.prismoidal, length / 6.0, at[end]);
    }
    add_weighted(volume.prismoidal, 4.0 * length / 6.0, at[2 * i + 1]);
  }
}

}  // namespace

Volume compute_volume(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line, double from_m,
                      double to_m, double interval_m, const RegistrationResult& registration,
                      const ProfilingOptions& options, Progress& progress) {
  Volume volume;
  volume.line = line.name;
  volume.line_offset_m = line.offset_m;
  volume.line_growth_per_m = line.growth_per_m;
  volume.from_m = from_m;
  volume.to_m = to_m;
  const std::vector<LineOfProfile> lines = lines_of(design, line);
  const SliceSums sums = parallel_ordered_sum(map.rows, 4, SliceSums{}, [&](std::size_t begin, std::size_t end) {
    progress.step(begin, map.rows);
    SliceSums part;
    for (std::size_t r = begin; r < end; ++r) part += slice_sums(map, r, design, lines, from_m, to_m, options);
    return part;
  });
  volume.slices = sums.amounts;
  volume.measured_m2 = sums.measured_m2;
  volume.interpolated_m2 = sums.interpolated_m2;
  volume.unseen_m2 = sums.unseen_m2;
  volume.opening_m2 = sums.opening_m2;
  volume.coverage = sums.measured_m2 / std::max(1e-12, sums.measured_m2 + sums.interpolated_m2 + sums.unseen_m2);
  volume.closure_m3 = (volume.slices.excavated_m3 - volume.slices.design_m3) -
                      (volume.slices.overbreak_m3 - volume.slices.underbreak_m3);
  add_section_methods(volume, map, design, interval_m, options);
  const auto sigma = [&](VolumePart part) {
    return volume_sigma_m3(map, design, line, from_m, to_m, part, registration, options);
  };
  volume.sigma_excavated_m3 = sigma(VolumePart::excavated);
  volume.sigma_overbreak_m3 = sigma(VolumePart::over);
  volume.sigma_underbreak_m3 = sigma(VolumePart::under);
  return volume;
}

}  // namespace adit
