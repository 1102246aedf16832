#include "io/scan_sample.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "core/foundation/random.h"
#include "io/point_density.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t whole_file_bytes = std::uint64_t{8} << 20;
constexpr std::uint64_t most_places = 2048;  // a disk that turns needs about 5 ms for each
constexpr std::uint64_t records_at_a_place = 96;
constexpr std::uint64_t bytes_at_a_place = 4096;
constexpr std::size_t most_spread = 65536;

/// Even places would fall onto the same rows of a scanner's raster again and again; within its stretch each place is
/// drawn by lot, the same on every run.
std::uint64_t place_in(std::uint64_t stretch, std::uint64_t stretches, std::uint64_t whole, std::uint64_t wanted) {
  const std::uint64_t length = whole / stretches;
  const std::uint64_t room = length > wanted ? length - wanted : 0;
  return stretch * length + Random(1).bits(stretch) % (room + 1);
}

void take_point(ScanSample& sample, const Eigen::Vector3d& position) {
  sample.box.extend(position);
  ++sample.points;
}

std::optional<Eigen::Vector3d> position_on(std::string_view line, const TextColumns& columns,
                                           std::vector<Field>& fields) {
  if (columns.separator == '\0')
    split_at_blanks(line, 0, fields);
  else
    split_at(columns.separator, line, 0, fields);
  Eigen::Vector3d position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t column = columns.xyz[axis];
    const auto number = column < fields.size() ? number_in(fields[column].text) : std::nullopt;
    if (!number) return std::nullopt;
    position[static_cast<Eigen::Index>(axis)] = *number;
  }
  if (!position.allFinite() || (columns.zero_is_no_return && position.isZero(0.0))) return std::nullopt;
  return position;
}

/// The whole lines among the bytes at a place. `is_line_begin`: a line begins with the first byte.
std::string_view whole_lines(std::string_view bytes, bool is_line_begin) {
  const std::size_t first = is_line_begin ? 0 : bytes.find('\n') + 1;
  const std::size_t last = bytes.rfind('\n');
  if (last == std::string_view::npos || last < first) return {};
  return bytes.substr(first, last + 1 - first);
}

/// True when a header's box holds the points, but for what rounding leaves.
bool agrees(const BoundingBox& said, const BoundingBox& seen) {
  constexpr double rounding_m = 0.001;
  if (said.isEmpty() || seen.isEmpty()) return true;
  const double size = std::max(said.sizes().maxCoeff(), 1.0);
  return (said.min() - seen.min()).maxCoeff() < rounding_m * size &&
         (seen.max() - said.max()).maxCoeff() < rounding_m * size;
}

}  // namespace

bool is_read_whole(std::uint64_t file_bytes) {
  return file_bytes <= whole_file_bytes;
}

ScanSample sample_records(const InputFile& file, std::uint64_t begin, std::uint64_t record_bytes, std::uint64_t count,
                          const std::function<Eigen::Vector3d(const std::byte*)>& position) {
  ScanSample sample;
  if (is_read_whole(file.size()) || count == 0) return sample;
  const std::uint64_t run =
      std::min(count, std::clamp<std::uint64_t>(2 * bytes_at_a_place / record_bytes, 1, records_at_a_place));
  const std::uint64_t places = std::min(most_places, count / run);
  for (std::uint64_t place = 0; place < places; ++place) {
    const std::uint64_t first = place_in(place, places, count, run);
    const auto records =
        file.read(begin + first * record_bytes, static_cast<std::size_t>(run * record_bytes), "points");
    for (std::uint64_t i = 0; i < run; ++i) {
      const Eigen::Vector3d p = position(records.data() + i * record_bytes);
      if (!p.allFinite()) continue;
      take_point(sample, p);
      if (i == 0) sample.spread.push_back(p);
    }
  }
  sample.stands_for = static_cast<double>(count) / static_cast<double>(places);
  return sample;
}

ScanSample sample_lines(const InputFile& file, std::uint64_t begin, std::uint64_t end, const TextColumns& columns,
                        std::uint64_t points) {
  ScanSample sample;
  if (is_read_whole(file.size()) || end <= begin) return sample;
  const std::uint64_t places = std::clamp<std::uint64_t>((end - begin) / (2 * bytes_at_a_place), 1, most_places);
  std::string bytes(bytes_at_a_place, '\0');
  std::vector<Field> fields;
  std::uint64_t seen_bytes = 0, lines = 0;
  for (std::uint64_t place = 0; place < places; ++place) {
    const std::uint64_t from = begin + place_in(place, places, end - begin, bytes_at_a_place);
    const std::size_t got =
        file.read_some(from, bytes.data(), static_cast<std::size_t>(std::min(bytes_at_a_place, end - from)));
    std::string_view rest = whole_lines(std::string_view(bytes).substr(0, got), from == begin);
    seen_bytes += rest.size();
    for (bool first = true; !rest.empty(); first = false) {
      const std::size_t length = rest.find('\n');
      const auto p = position_on(rest.substr(0, length), columns, fields);
      rest.remove_prefix(length + 1);
      ++lines;
      if (!p) continue;
      take_point(sample, *p);
      if (first) sample.spread.push_back(*p);
    }
  }
  if (lines > 0) sample.bytes_per_point = static_cast<double>(seen_bytes) / static_cast<double>(lines);
  const double all = points > 0                     ? static_cast<double>(points)
                     : sample.bytes_per_point > 0.0 ? static_cast<double>(end - begin) / sample.bytes_per_point
                                                    : 0.0;
  sample.stands_for = all / static_cast<double>(places);
  return sample;
}

void take_sample(ScanSummary& summary, const ScanSample& sample) {
  if (sample.points == 0) return;
  if (summary.box.isEmpty()) {
    summary.box = sample.box;
    summary.box_from = "sample";
  }
  summary.sampled_points = sample.points;
  summary.density = point_density(sample.spread, sample.stands_for, sample.box);
}

bool WholeScans::begin(const ScanHeader&) {
  scans_.emplace_back();
  return true;
}

void WholeScans::take(PointBlock& block) {
  ScanSample& sample = scans_.back().sample;
  for (const Eigen::Vector3d& p : block.positions) {
    take_point(sample, p);
    if (sample.spread.size() < most_spread) {
      sample.spread.push_back(p);
    } else {  // every point so far has the same chance of being kept (Vitter, algorithm R)
      const std::uint64_t lot = Random(2).bits(sample.points) % sample.points;
      if (lot < most_spread) sample.spread[static_cast<std::size_t>(lot)] = p;
    }
  }
}

void WholeScans::end(std::uint64_t no_returns) {
  Seen& seen = scans_.back();
  seen.no_returns = no_returns;
  seen.sample.stands_for = static_cast<double>(seen.sample.points) /
                           static_cast<double>(std::max<std::size_t>(1, seen.sample.spread.size()));
}

void WholeScans::complete(ScanFileSummary& summary) const {
  for (std::size_t i = 0; i < std::min(scans_.size(), summary.scans.size()); ++i) {
    BoundingBox& said = summary.scans[i].box;
    if (!agrees(said, scans_[i].sample.box)) said = {};  // what all points say is shown instead
    take_sample(summary.scans[i], scans_[i].sample);
    if (summary.scans[i].box_from == "sample") summary.scans[i].box_from = "all points";
    if (scans_[i].no_returns > 0) summary.scans[i].no_returns = scans_[i].no_returns;
  }
}

}  // namespace adit::io
