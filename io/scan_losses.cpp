#include "io/scan_losses.h"

#include <algorithm>

#include "core/foundation/options.h"
#include "io/intensity_range.h"
#include "io/scan_formats.h"

namespace adit::io {
namespace {

template <typename Count>
std::uint64_t sum(const std::vector<ScanFacts>& scans, const Count& count) {
  std::uint64_t total = 0;
  for (const ScanFacts& scan : scans) total += count(scan);
  return total;
}

std::uint64_t not_finite(const ScanFacts& scan) {
  const std::uint64_t known = scan.points + scan.no_returns;
  return scan.header.points > known ? scan.header.points - known : 0;
}

std::string counted(std::uint64_t n, const char* one, const char* several) {
  return n == 1 ? std::string("1 ") + one + " is left out" : std::to_string(n) + " " + several + " are left out";
}

void add_intensities(const ScanFacts& facts, double most, bool whole, const std::string& name,
                     std::vector<std::string>& losses) {
  const IntensityRange range = intensity_range(facts, most, whole);
  if (range.zero == 0.0 && range.factor == 1.0) return;
  losses.push_back("intensities" + name + " are written as (value - " + short_number(range.zero) + ") * " +
                   short_number(range.factor));
}

}  // namespace

std::vector<std::string> losses_of_writing(const std::filesystem::path& file, const std::vector<ScanFacts>& scans) {
  const FormatHolds holds = format_holds(file);
  const auto any = [&](const auto& test) { return std::any_of(scans.begin(), scans.end(), test); };
  std::vector<std::string> losses;
  if (!holds.normals && any([](const ScanFacts& s) { return s.header.attributes.normals; }))
    losses.emplace_back("normals are left out");
  if (!holds.raster && any([](const ScanFacts& s) { return s.header.attributes.grid; }))
    losses.emplace_back("rows and columns of the raster are left out");
  // With rows and columns the places without a return are known again.
  const auto places = [&](const ScanFacts& s) { return holds.raster && s.header.attributes.grid ? 0 : s.no_returns; };
  if (const std::uint64_t n = sum(scans, places); n > 0)
    losses.push_back(counted(n, "place without a return", "places without a return"));
  if (const std::uint64_t n = sum(scans, not_finite); n > 0)
    losses.push_back(counted(n, "point that is not finite", "points that are not finite"));
  if (holds.pose_goes == PoseGoes::into_points &&
      any([](const ScanFacts& s) { return s.header.file_pose && !s.header.file_pose->matrix().isIdentity(0.0); }))
    losses.emplace_back("the pose is left out; the points are moved by it");
  if (holds.most_intensity > 1.0)
    for (const ScanFacts& scan : scans) add_intensities(scan, holds.most_intensity, true, "", losses);
  if (holds.most_intensity == 1.0) add_intensities(all_intensities(scans), 1.0, false, " of all scans", losses);
  return losses;
}

}  // namespace adit::io
