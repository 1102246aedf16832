#include "io/scan_formats.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/las.h"
#include "io/pcd.h"
#include "io/ply.h"
#include "io/pts.h"
#include "io/ptx.h"
#include "io/scan_collector.h"
#include "io/xyz.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;
using Scans = std::vector<ScanData>;

using Stream = void (*)(const fs::path&, const ReadOptions&, ScanSink&, Progress&);

Scans collected(Stream stream, const fs::path& file, const ReadOptions& options, Progress& progress) {
  ScanCollector collector;
  stream(file, options, collector, progress);
  return std::move(collector.scans);
}

BoundingBox box_of(const ScanData& scan) {
  BoundingBox box;
  for (const Eigen::Vector3f& p : scan.cloud.points) box.extend(p.cast<double>() + scan.offset);
  return box;
}

/// For headers that do not say where the points lie.
ScanFileSummary with_box(ScanFileSummary summary, const ScanData& scan) {
  summary.scans.front().box = box_of(scan);
  return summary;
}

constexpr ReadOptions finite_points{true};

/// For text formats: only reading tells how many points there are, and where.
ScanFileSummary summary_of(const std::string& format, const Scans& scans) {
  ScanFileSummary summary;
  summary.format = format;
  for (const ScanData& scan : scans) {
    ScanSummary row;
    row.name = scan.name;
    row.points = scan.cloud.size();
    row.pose = scan.file_pose;
    row.box = box_of(scan);
    if (scan.cloud.has_intensity()) row.attributes.emplace_back("intensity");
    if (scan.cloud.has_colour()) row.attributes.emplace_back("colour");
    if (scan.cloud.has_normals()) row.attributes.emplace_back("normals");
    summary.scans.push_back(std::move(row));
  }
  return summary;
}

/// A row of the table. `begins` may be empty: the format has no signature.
struct ScanFormat {
  std::vector<std::string> endings;
  bool (*begins)(std::string_view) = nullptr;
  Stream stream = nullptr;
  std::function<ScanFileSummary(const fs::path&, Progress&)> summarise;
  std::function<void(const fs::path&, const Scans&, const WriteOptions&, Progress&)> write;
  bool holds_several_scans = false;
};

std::vector<ScanFormat> make_formats() {
  return {
      {{".ply"},
       is_ply,
       stream_ply,
       [](auto& file, auto& progress) {
         return with_box(summarise_ply(file), collected(stream_ply, file, finite_points, progress)[0]);
       },
       [](auto& file, auto& scans, auto& options, auto& progress) { write_ply(file, scans[0], options, progress); }},
      {{".pcd"},
       is_pcd,
       stream_pcd,
       [](auto& file, auto& progress) {
         return with_box(summarise_pcd(file), collected(stream_pcd, file, finite_points, progress)[0]);
       },
       [](auto& file, auto& scans, auto& options, auto& progress) { write_pcd(file, scans[0], options, progress); }},
      {{".las"},
       is_las,
       stream_las,
       [](auto& file, auto&) { return summarise_las(file); },
       [](auto& file, auto& scans, auto& options, auto& progress) { write_las(file, scans[0], options, progress); }},
      {{".pts"},
       nullptr,
       stream_pts,
       [](auto& file, auto& progress) { return summary_of("PTS", collected(stream_pts, file, {}, progress)); },
       [](auto& file, auto& scans, auto& options, auto& progress) { write_pts(file, scans[0], options, progress); }},
      {{".ptx"},
       nullptr,
       stream_ptx,
       [](auto& file, auto& progress) { return summary_of("PTX", collected(stream_ptx, file, {}, progress)); },
       write_ptx,
       true},
      {{".xyz", ".csv", ".txt"},
       nullptr,
       stream_xyz,
       [](auto& file, auto& progress) { return summary_of("XYZ text", collected(stream_xyz, file, {}, progress)); },
       [](auto& file, auto& scans, auto& options, auto& progress) { write_xyz(file, scans[0], options, progress); }},
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
  const std::string beginning = file.beginning(64);
  for (const ScanFormat& format : formats())
    if (format.begins != nullptr && format.begins(beginning)) return &format;
  return nullptr;
}

std::string listed(const std::vector<std::string>& endings) {
  std::string list;
  for (const std::string& ending : endings) list += (list.empty() ? "" : " ") + ending;
  return list;
}

/// The format of an existing file: its first bytes say more than its name.
const ScanFormat& format_of(const fs::path& path) {
  const InputFile file(path);
  if (const ScanFormat* format = format_by_beginning(file)) return *format;
  if (ending_of(path) == ".e57")
    throw Error("this is an E57 file", path.string(), "reading E57 comes with a later version; convert to PLY or LAS");
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
  return format_of(file).summarise(file, progress);
}

void write_scans(const fs::path& file, const std::vector<ScanData>& scans, const WriteOptions& options,
                 Progress& progress) {
  const ScanFormat* format = format_by_ending(file);
  if (format == nullptr)
    throw Error("the ending names no scan format", file.string(), "known are " + listed(writable_endings()));
  if (scans.empty()) throw Error("there is no scan to write", file.string(), "choose at least one scan");
  if (scans.size() > 1 && !format->holds_several_scans)
    throw Error("the format holds one scan, not " + std::to_string(scans.size()), file.string(),
                "write .ptx, or one file a scan");
  format->write(file, scans, options, progress);
}

std::vector<std::string> readable_endings() {
  std::vector<std::string> endings;
  for (const ScanFormat& format : formats())
    endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  return endings;
}

std::vector<std::string> writable_endings() {
  return readable_endings();
}

}  // namespace adit::io
