#include "io/scan_formats.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/checked_writer.h"
#include "io/e57.h"
#include "io/las.h"
#include "io/laz.h"
#include "io/pcd.h"
#include "io/ply.h"
#include "io/pts.h"
#include "io/ptx.h"
#include "io/scan_beginning.h"
#include "io/scan_collector.h"
#include "io/scan_from_memory.h"
#include "io/scan_sample.h"
#include "io/xyz.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;
using Scans = std::vector<ScanData>;

using Stream = void (*)(const fs::path&, const ReadOptions&, ScanSink&, Progress&);
using Summarise = ScanFileSummary (*)(const fs::path&, Progress&);

Scans collected(Stream stream, const fs::path& file, const ReadOptions& options, Progress& progress) {
  ScanCollector collector;
  stream(file, options, collector, progress);
  return std::move(collector.scans);
}

using MakeFormatWriter = std::unique_ptr<ScanWriter> (*)(const fs::path&, const std::vector<ScanFacts>&,
                                                         const WriteOptions&);

/// A row of the table. `begins` may be empty: the format has no signature. `make_writer` may be empty: it is only read.
struct ScanFormat {
  std::vector<std::string> endings;
  bool (*begins)(std::string_view) = nullptr;
  Stream stream = nullptr;
  Summarise summarise = nullptr;
  MakeFormatWriter make_writer = nullptr;
  FormatHolds holds;
  std::vector<std::string> variants;
  bool built_in = true;  ///< false: every function refuses the file by name
};

constexpr double las_intensity = 65535.0;

std::vector<ScanFormat> make_formats() {
  using enum PoseGoes;
  // pose, several scans, normals, raster, intensities up to
  const FormatHolds ply{into_points, false, true, false, 0.0};
  const FormatHolds pcd{beside_points, false, true, false, 0.0};
  const FormatHolds e57{beside_points, true, true, true, 0.0};
  const FormatHolds las{into_points, false, false, false, las_intensity};
  const FormatHolds pts{into_points, false, false, false, 0.0};
  const FormatHolds ptx{beside_points, true, false, true, 1.0};
  const FormatHolds xyz{into_points, false, true, false, 0.0};
  const std::vector<std::string> ply_variants = {"ascii", "little", "big"};
  const std::vector<std::string> pcd_variants = {"ascii", "binary", "compressed"};
  const std::vector<std::string> e57_variants = {"scaled", "double"};
  return {
      {{".ply"}, is_ply, stream_ply, summarise_ply, make_ply_writer, ply, ply_variants},
      {{".pcd"}, is_pcd, stream_pcd, summarise_pcd, make_pcd_writer, pcd, pcd_variants},
      {{".e57"}, is_e57, stream_e57, summarise_e57, make_e57_writer, e57, e57_variants, e57_is_built_in()},
      // In front of LAS: is_las() knows no difference.
      {{".laz"}, is_laz, stream_laz, summarise_laz, make_laz_writer, las, {}, laz_is_built_in()},
      {{".las"}, is_las, stream_las, summarise_las, make_las_writer, las, {}},
      {{".pts"}, nullptr, stream_pts, summarise_pts, make_pts_writer, pts, {}},
      {{".ptx"}, nullptr, stream_ptx, summarise_ptx, make_ptx_writer, ptx, {}},
      {{".xyz", ".csv", ".txt"}, nullptr, stream_xyz, summarise_xyz, make_xyz_writer, xyz, {}},
  };
}

const std::vector<ScanFormat>& formats() {
  static const std::vector<ScanFormat> table = make_formats();
  return table;
}

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

const ScanFormat* format_by_ending(const fs::path& file) {
  const std::string ending = ending_of(file);
  for (const ScanFormat& format : formats())
    if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end()) return &format;
  return nullptr;
}

const ScanFormat* format_by_beginning(const InputFile& file) {
  const std::string beginning = file.beginning(128);
  for (const ScanFormat& format : formats())
    if (format.begins != nullptr && format.begins(beginning)) return &format;
  return nullptr;
}

std::string listed(const std::vector<std::string>& words, const char* between = " ") {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : between) + word;
  return list;
}

template <typename Test>
std::vector<std::string> endings_that(const Test& test) {
  std::vector<std::string> endings;
  for (const ScanFormat& format : formats())
    if (test(format)) endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  return endings;
}

/// The format of a file to be made. Error when the ending or the variant names none.
const ScanFormat& writable_format(const fs::path& file, const WriteOptions& options) {
  const ScanFormat* format = format_by_ending(file);
  if (format == nullptr || format->make_writer == nullptr)
    throw Error("the ending names no scan format" + std::string(format == nullptr ? "" : " that is written"),
                file.string(), "known are " + listed(writable_endings()));
  if (!format->built_in) format->make_writer(file, {}, options);
  const std::vector<std::string>& known = format->variants;
  if (!options.variant.empty() && std::find(known.begin(), known.end(), options.variant) == known.end())
    throw Error("the format has no variant \"" + options.variant + "\"", file.string(),
                known.empty() ? "leave the variant out" : "choose one of " + listed(known, ", "));
  return *format;
}

/// The format of an existing file: its first bytes say more than its name.
const ScanFormat& format_of(const fs::path& path) {
  const InputFile file(path);
  if (const ScanFormat* format = format_by_beginning(file)) return *format;
  const ScanFormat* format = format_by_ending(path);
  if (format == nullptr)
    throw Error("the ending names no scan format", path.string(), "known are " + listed(readable_endings()));
  if (file.size() == 0) throw Error("the file is empty", path.string(), "export the scan again");
  return *format;
}

}  // namespace

bool is_scan_file(const fs::path& path) {
  if (format_by_ending(path) != nullptr) return true;
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && format_by_beginning(InputFile(path)) != nullptr;
}

void stream_scans(const fs::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  format_of(file).stream(file, options, sink, progress);
}

std::vector<ScanData> read_scans(const fs::path& file, const ReadOptions& options, Progress& progress) {
  return collected(format_of(file).stream, file, options, progress);
}

ScanFileSummary summarise_scan_file(const fs::path& file, Progress& progress) {
  const ScanFormat& format = format_of(file);
  ScanFileSummary summary = format.summarise(file, progress);
  if (is_read_whole(InputFile(file).size())) {
    WholeScans whole;
    format.stream(file, {.drop_invalid = true}, whole, progress);
    whole.complete(summary);
  } else {
    complete_from_beginnings(summary, file, format.stream, progress);
  }
  return summary;
}

FormatHolds format_holds(const fs::path& file) {
  return writable_format(file, {}).holds;
}

void expect_writable(const fs::path& file, const WriteOptions& options) {
  writable_format(file, options);
  const AtomicFile probe(file);
}

std::unique_ptr<ScanWriter> make_scan_writer(const fs::path& file, std::vector<ScanFacts> scans,
                                             const WriteOptions& options) {
  const ScanFormat& format = writable_format(file, options);
  if (scans.empty()) throw Error("there is no scan to write", file.string(), "choose at least one scan");
  if (scans.size() > 1 && !format.holds.several_scans)
    throw Error("the format holds one scan, not " + std::to_string(scans.size()), file.string(),
                "write one of " + listed(endings_that([](const ScanFormat& f) { return f.holds.several_scans; })) +
                    ", or one scan each to a file of its own (--scan)");
  return checked_writer(file, std::move(scans), format.holds.pose_goes, [&](const std::vector<ScanFacts>& written) {
    return format.make_writer(file, written, options);
  });
}

void write_scans(const fs::path& file, const Scans& scans, const WriteOptions& options, Progress& progress) {
  writable_format(file, options);
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(scans.size(), 1));
  FactsSink facts;
  for (const ScanData& scan : scans) stream_from_memory(scan, file, facts, progress.part(0.2 * share, scan.name));
  const std::unique_ptr<ScanWriter> writer = make_scan_writer(file, std::move(facts.scans), options);
  for (const ScanData& scan : scans) stream_from_memory(scan, file, *writer, progress.part(0.8 * share, scan.name));
  writer->commit();
}

std::vector<std::string> readable_endings() {
  return endings_that([](const ScanFormat& format) { return format.built_in; });
}

std::vector<std::string> writable_endings() {
  return endings_that([](const ScanFormat& format) { return format.built_in && format.make_writer != nullptr; });
}

std::vector<std::string> endings_not_built_in() {
  return endings_that([](const ScanFormat& format) { return !format.built_in; });
}

}  // namespace adit::io
