#include "io/scan_writer.h"

#include <algorithm>
#include <cmath>

namespace adit::io {
namespace {

bool is_float32(const Eigen::Vector3d& position) {
  return position == position.cast<float>().cast<double>();
}

bool comes_later(const GridPlace& a, const GridPlace& b) {
  return a.column > b.column || (a.column == b.column && a.row > b.row);
}

}  // namespace

bool FactsSink::begin(const ScanHeader& scan) {
  scans.emplace_back();
  scans.back().header = scan;
  return true;
}

void FactsSink::take(PointBlock& block) {
  ScanFacts& facts = scans.back();
  take_positions(block, facts);
  take_intensities(block, facts);
  take_grid(block, facts);
  facts.points += block.size();
}

void FactsSink::end(std::uint64_t no_returns) {
  ScanFacts& facts = scans.back();
  facts.no_returns = no_returns;
  if (!facts.header.file_pose) facts.site_box = facts.box;
}

void FactsSink::take_positions(const PointBlock& block, ScanFacts& facts) const {
  for (const Eigen::Vector3d& p : block.positions) {
    facts.box.extend(p);
    if (facts.header.file_pose) facts.site_box.extend(*facts.header.file_pose * p);
    facts.coordinates_are_float32 = facts.coordinates_are_float32 && is_float32(p);
  }
}

void FactsSink::take_intensities(const PointBlock& block, ScanFacts& facts) const {
  if (block.intensity.empty()) return;
  const auto [least, greatest] = std::minmax_element(block.intensity.begin(), block.intensity.end());
  const bool first = facts.points == 0;
  facts.least_intensity = first ? *least : std::min(facts.least_intensity, *least);
  facts.greatest_intensity = first ? *greatest : std::max(facts.greatest_intensity, *greatest);
  facts.whole_intensities =
      facts.whole_intensities && std::all_of(block.intensity.begin(), block.intensity.end(),
                                             [](float value) { return value == std::floor(value); });
}

void FactsSink::take_grid(const PointBlock& block, ScanFacts& facts) {
  for (std::size_t i = 0; i < block.grid.size(); ++i) {
    const GridPlace& place = block.grid[i];
    const bool first = facts.points == 0 && i == 0;
    facts.column_by_column = facts.column_by_column && (first || comes_later(place, last_place_));
    facts.rows = std::max(facts.rows, std::max(place.row, place.row + 1));  // the greatest number has no next one
    facts.columns = std::max(facts.columns, std::max(place.column, place.column + 1));
    last_place_ = place;
  }
}

}  // namespace adit::io
