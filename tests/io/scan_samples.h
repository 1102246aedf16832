#pragma once
// Scans made for the tests of the formats, and what those tests ask again and again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "io/scan_formats.h"
#include "tests/temporary_folder.h"

namespace adit::tests {

/// n points in a box of 40 x 30 x 20 m with every attribute. Intensities are whole numbers from 0 to 65535.
inline io::ScanData sample_scan(std::size_t n) {
  const Random random(7);
  io::ScanData scan;
  scan.name = "sample";
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = [&](std::uint64_t k, double low, double high) { return random.uniform(16 * i + k, low, high); };
    scan.cloud.points.emplace_back(u(0, -20, 20), u(1, -15, 15), u(2, -10, 10));
    scan.cloud.intensity.push_back(static_cast<float>(random.bits(16 * i + 3) % 65536));
    const auto byte = [&](std::uint64_t k) { return static_cast<std::uint8_t>(random.bits(16 * i + k) & 255); };
    scan.cloud.colour.push_back({byte(4), byte(5), byte(6)});
    scan.cloud.normals.push_back(Eigen::Vector3f(u(7, -1, 1), u(8, -1, 1), u(9, 0.1, 1)).normalized());
  }
  return scan;
}

/// The same far from the site's zero: Norwegian UTM coordinates.
inline io::ScanData sample_scan_at_site(std::size_t n) {
  io::ScanData scan = sample_scan(n);
  scan.offset = Eigen::Vector3d(612345.0, 6998765.0, 412.0);
  return scan;
}

inline Pose sample_pose() {
  return make_pose({12.5, -3.25, 1.75}, {0.7, -0.02, 0.01});
}

inline io::ScanData read_one(const std::filesystem::path& file, const io::ReadOptions& options = {}) {
  Progress progress;
  std::vector<io::ScanData> scans = io::read_scans(file, options, progress);
  EXPECT_EQ(scans.size(), 1U) << file;
  return std::move(scans.at(0));
}

inline void write_one(const std::filesystem::path& file, const io::ScanData& scan, const std::string& variant = {}) {
  Progress progress;
  io::write_scans(file, {scan}, {variant}, progress);
}

/// From file to file as a stream, as adit convert does.
inline void convert(const std::filesystem::path& in, const std::filesystem::path& out,
                    const io::WriteOptions& options = {}) {
  Progress progress;
  io::FactsSink facts;
  io::stream_scans(in, {}, facts, progress);
  const auto writer = io::make_scan_writer(out, facts.scans, options);
  io::stream_scans(in, {}, *writer, progress);
  writer->commit();
}

inline io::ScanFileSummary summary(const std::filesystem::path& file) {
  Progress progress;
  return io::summarise_scan_file(file, progress);
}

/// The words a file is refused with; "(read)" when it is not.
inline std::string refusal(const std::filesystem::path& file, const io::ReadOptions& options = {}) {
  try {
    Progress progress;
    io::read_scans(file, options, progress);
  } catch (const Error& error) {
    EXPECT_FALSE(error.mend().empty()) << error.what();
    EXPECT_THAT(error.where(), testing::HasSubstr(file.filename().string())) << error.what();
    EXPECT_THAT(std::string(error.what()), testing::Not(testing::HasSubstr("\n")));
    return error.what();
  }
  return "(read)";
}

/// Largest distance between points of the same index, in file coordinates [m].
inline double largest_distance_m(const io::ScanData& a, const io::ScanData& b) {
  if (a.cloud.size() != b.cloud.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.cloud.size(); ++i) {
    const Eigen::Vector3d p = a.cloud.points[i].cast<double>() + a.offset;
    const Eigen::Vector3d q = b.cloud.points[i].cast<double>() + b.offset;
    largest = std::max(largest, (p - q).norm());
  }
  return largest;
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

}  // namespace adit::tests
