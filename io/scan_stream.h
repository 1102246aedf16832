#pragma once
// A scan file as a stream: what is known before the first point, then blocks of points. Nothing holds a whole file.

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/bounding_box.h"
#include "core/geometry/pose.h"

namespace adit::io {

/// Which attributes every point of a scan has.
struct Attributes {
  bool intensity = false;
  bool colour = false;
  bool normals = false;
  bool grid = false;  ///< row and column in the scanner's raster
};
/// Their names, for people: "intensity", "colour", "normals", "grid".
std::vector<std::string> attribute_names(const Attributes& attributes);

/// What is known of a scan before its first point.
struct ScanHeader {
  std::string name;
  std::string where;  ///< file, and line or scan in it, for messages
  Attributes attributes;
  /// What the file itself says of the scanner: site-from-file coordinates (E57, PTX, PCD viewpoint).
  std::optional<Pose> file_pose;
  std::uint64_t points = 0;  ///< as the header says, places without a return among them; 0: it does not say
  BoundingBox box;           ///< as the header says, file coordinates; empty: it does not say
  std::string unit{};        ///< of the coordinates, where the file says that it is not the metre: "foot", "degree"
};

/// Error for coordinates that are no metres, as the file itself says.
void expect_metres(const ScanHeader& scan);

/// Name of the n-th scan (from 1) of a file whose scans have none: that of the file, then with -2, -3, ...
std::string name_of_scan(const std::filesystem::path& file, int n);

/// Row and column of a point in the scanner's raster.
struct GridPlace {
  std::uint32_t row = 0;
  std::uint32_t column = 0;
};

/// Consecutive points of one scan. Attributes are as long as positions, or empty when the scan lacks them.
struct PointBlock {
  static constexpr std::size_t most_points = 65536;

  std::vector<Eigen::Vector3d> positions;  ///< file coordinates [m], finite
  std::vector<float> intensity;
  std::vector<std::array<std::uint8_t, 3>> colour;
  std::vector<Eigen::Vector3f> normals;
  std::vector<GridPlace> grid;

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
  /// No points; the memory is kept.
  void clear();
};

/// Takes the scans of a file, one after the other. Called from one thread.
class ScanSink {
 public:
  virtual ~ScanSink() = default;
  /// False: this scan is not wanted; no take() and no end() follow for it.
  virtual bool begin(const ScanHeader& scan) = 0;
  /// Points in the order of the file. The sink may keep the block's vectors and leave others in their place.
  virtual void take(PointBlock& block) = 0;
  /// After the last point. no_returns: places of a raster where the scanner saw nothing; they were not handed out.
  virtual void end(std::uint64_t no_returns) = 0;
};

}  // namespace adit::io
