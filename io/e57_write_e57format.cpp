#include <E57Format.h>

#include <cmath>
#include <optional>

#include "io/atomic_file.h"
#include "io/e57.h"
#include "io/e57_scan_e57format.h"
#include "io/sha256.h"

namespace adit::io {
namespace {

using e57::FloatNode;
using e57::IntegerNode;
using e57::StringNode;
using e57::StructureNode;

constexpr double scale_m = 1e-4;
constexpr double most_steps = 4e9;  // 400 km: beyond, doubles take hardly more room
constexpr const char* normals_uri = "http://www.libe57.org/E57_NOR_surface_normals.txt";

/// 128 bits of a hash as E57 writes identifiers.
std::string guid_of(const std::string& content) {
  const std::string hex = sha256_of_bytes(content);
  return "{" + hex.substr(0, 8) + "-" + hex.substr(8, 4) + "-" + hex.substr(12, 4) + "-" + hex.substr(16, 4) + "-" +
         hex.substr(20, 12) + "}";
}

/// All facts of a scan to the last bit.
std::string words_of(const ScanFacts& facts) {
  std::string words = facts.header.name + "|" + std::to_string(facts.points);
  const auto add = [&](double value) {
    char number[32];
    std::snprintf(number, sizeof number, "|%a", value);
    words += number;
  };
  for (int k = 0; k < 3; ++k) {
    add(facts.box.min()[k]);
    add(facts.box.max()[k]);
  }
  if (facts.header.file_pose)
    for (int k = 0; k < 16; ++k) add(facts.header.file_pose->matrix().data()[k]);
  add(static_cast<double>(facts.least_intensity));
  add(static_cast<double>(facts.greatest_intensity));
  return words;
}

/// Coordinates are stored as steps about this.
double whole_offset(double least, double greatest) {
  return std::round((least + greatest) / 2.0);
}

/// The nodes of one file, which all hang on it.
class Nodes {
 public:
  explicit Nodes(e57::ImageFile file) : file_(std::move(file)) {}

  FloatNode number(double value) const { return FloatNode(file_, value); }
  IntegerNode whole(std::int64_t value) const { return IntegerNode(file_, value); }
  StringNode text(const std::string& words) const { return StringNode(file_, words); }
  StructureNode structure() const { return StructureNode(file_); }

  /// A coordinate of the records: whole steps about a whole-metre offset, or a double.
  e57::Node coordinate(double least, double greatest, bool as_double) const {
    if (as_double) return FloatNode(file_, least, e57::E57_DOUBLE, least, greatest);
    const double offset = whole_offset(least, greatest);
    const auto steps = [&](double value) { return static_cast<std::int64_t>(std::floor((value - offset) / scale_m)); };
    return e57::ScaledIntegerNode(file_, std::int64_t{0}, std::min<std::int64_t>(0, steps(least)),
                                  std::max<std::int64_t>(0, steps(greatest) + 1), scale_m, offset);
  }
  e57::Node single() const { return FloatNode(file_, 0.0, e57::E57_SINGLE); }
  e57::Node whole_between(std::int64_t least, std::int64_t greatest) const {
    return IntegerNode(file_, least, least, greatest);
  }

 private:
  e57::ImageFile file_;
};

StructureNode pose_node(const Nodes& make, const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  StructureNode rotation = make.structure();
  rotation.set("w", make.number(q.w()));
  rotation.set("x", make.number(q.x()));
  rotation.set("y", make.number(q.y()));
  rotation.set("z", make.number(q.z()));
  StructureNode translation = make.structure();
  translation.set("x", make.number(pose.translation().x()));
  translation.set("y", make.number(pose.translation().y()));
  translation.set("z", make.number(pose.translation().z()));
  StructureNode node = make.structure();
  node.set("rotation", rotation);
  node.set("translation", translation);
  return node;
}

bool as_doubles(const ScanFacts& facts, bool wanted) {
  return wanted || facts.box.sizes().maxCoeff() / scale_m > most_steps;
}

/// The box of the points as they are stored.
BoundingBox stored_box(const ScanFacts& facts, bool doubles) {
  BoundingBox box = facts.box;
  if (doubles) return box;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double offset = whole_offset(facts.box.min()[k], facts.box.max()[k]);
    for (double* value : {&box.min()[k], &box.max()[k]})
      *value = std::floor((*value - offset) / scale_m + 0.5) * scale_m + offset;
  }
  return box;
}

bool whole_intensity(const ScanFacts& facts) {
  return facts.whole_intensities && std::abs(facts.least_intensity) < 1e9F && std::abs(facts.greatest_intensity) < 1e9F;
}

/// Name, pose, box and limits.
StructureNode scan_node(const Nodes& make, const ScanFacts& facts, const std::string& guid, bool doubles) {
  StructureNode scan = make.structure();
  scan.set("guid", make.text(guid));
  scan.set("name", make.text(facts.header.name));
  if (facts.header.file_pose) scan.set("pose", pose_node(make, *facts.header.file_pose));
  StructureNode box = make.structure();
  const BoundingBox stored = stored_box(facts, as_doubles(facts, doubles));
  const std::array<const char*, 3> axes{"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    box.set(std::string(axes[static_cast<std::size_t>(k)]) + "Minimum", make.number(stored.min()[k]));
    box.set(std::string(axes[static_cast<std::size_t>(k)]) + "Maximum", make.number(stored.max()[k]));
  }
  scan.set("cartesianBounds", box);
  const Attributes& has = facts.header.attributes;
  if (has.intensity) {
    StructureNode limits = make.structure();
    limits.set("intensityMinimum", make.number(static_cast<double>(facts.least_intensity)));
    limits.set("intensityMaximum", make.number(static_cast<double>(facts.greatest_intensity)));
    scan.set("intensityLimits", limits);
  }
  if (has.colour) {
    StructureNode limits = make.structure();
    for (const char* colour : {"Red", "Green", "Blue"}) {
      limits.set("color" + std::string(colour) + "Minimum", make.whole(0));
      limits.set("color" + std::string(colour) + "Maximum", make.whole(255));
    }
    scan.set("colorLimits", limits);
  }
  if (has.grid) {
    StructureNode bounds = make.structure();
    bounds.set("rowMinimum", make.whole(0));
    bounds.set("rowMaximum", make.whole(std::int64_t{facts.rows} - 1));
    bounds.set("columnMinimum", make.whole(0));
    bounds.set("columnMaximum", make.whole(std::int64_t{facts.columns} - 1));
    scan.set("indexBounds", bounds);
  }
  return scan;
}

/// The fields of a record, in the order of E57Field.
std::vector<std::pair<E57Field, e57::Node>> record_fields(const Nodes& make, const ScanFacts& facts, bool doubles) {
  const Attributes& has = facts.header.attributes;
  std::vector<std::pair<E57Field, e57::Node>> fields;
  const bool as_double = as_doubles(facts, doubles);
  for (const E57Field field : {e57_x, e57_y, e57_z})
    fields.emplace_back(field, make.coordinate(facts.box.min()[static_cast<Eigen::Index>(field)],
                                               facts.box.max()[static_cast<Eigen::Index>(field)], as_double));
  if (has.intensity)
    fields.emplace_back(e57_intensity, whole_intensity(facts)
                                           ? make.whole_between(static_cast<std::int64_t>(facts.least_intensity),
                                                                static_cast<std::int64_t>(facts.greatest_intensity))
                                           : make.single());
  if (has.colour)
    for (const E57Field field : {e57_red, e57_green, e57_blue}) fields.emplace_back(field, make.whole_between(0, 255));
  if (has.grid) {
    fields.emplace_back(e57_row, make.whole_between(0, std::int64_t{facts.rows} - 1));
    fields.emplace_back(e57_column, make.whole_between(0, std::int64_t{facts.columns} - 1));
  }
  if (has.normals)
    for (const E57Field field : {e57_normal_x, e57_normal_y, e57_normal_z}) fields.emplace_back(field, make.single());
  return fields;
}

class E57Writer : public ScanWriter {
 public:
  E57Writer(const std::filesystem::path& file, std::vector<ScanFacts> scans, bool doubles)
      : path_(file),
        facts_(std::move(scans)),
        doubles_(doubles),
        file_(path_.temporary().string(), "w"),
        make_(file_),
        scans_(file_, true) {
    std::string content;
    bool normals = false;
    for (const ScanFacts& facts : facts_) {
      content += words_of(facts) + "\n";
      normals = normals || facts.header.attributes.normals;
    }
    guid_ = guid_of(content);
    if (normals) file_.extensionsAdd("nor", normals_uri);
    StructureNode root = file_.root();
    root.set("formatName", make_.text("ASTM E57 3D Imaging Data File"));
    root.set("guid", make_.text(guid_));
    root.set("versionMajor", make_.whole(1));
    root.set("versionMinor", make_.whole(0));
    root.set("coordinateMetadata", make_.text(""));
    root.set("data3D", scans_);
    root.set("images2D", e57::VectorNode(file_, true));
  }

  bool begin(const ScanHeader&) override {
    with_words([&] {
      const ScanFacts& facts = facts_.at(begun_++);
      StructureNode scan = scan_node(make_, facts, guid_of(guid_ + std::to_string(begun_)), doubles_);
      scans_.append(scan);
      StructureNode record = make_.structure();
      std::vector<e57::SourceDestBuffer> buffers;
      for (const auto& [field, node] : record_fields(make_, facts, doubles_)) {
        record.set(e57_field_names[field], node);
        columns_[field].resize(PointBlock::most_points);
        buffers.emplace_back(file_, e57_field_names[field], columns_[field].data(), PointBlock::most_points, true,
                             true);
      }
      e57::CompressedVectorNode records(file_, record, e57::VectorNode(file_, true));
      scan.set("points", records);
      writer_.emplace(records.writer(buffers));
    });
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      columns_[e57_x][i] = block.positions[i].x();
      columns_[e57_y][i] = block.positions[i].y();
      columns_[e57_z][i] = block.positions[i].z();
    }
    const Attributes& has = facts_[begun_ - 1].header.attributes;
    for (std::size_t i = 0; has.intensity && i < block.size(); ++i)
      columns_[e57_intensity][i] = static_cast<double>(block.intensity[i]);
    for (std::size_t i = 0; has.colour && i < block.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) columns_[e57_red + c][i] = static_cast<double>(block.colour[i][c]);
    for (std::size_t i = 0; has.grid && i < block.size(); ++i) {
      columns_[e57_row][i] = static_cast<double>(block.grid[i].row);
      columns_[e57_column][i] = static_cast<double>(block.grid[i].column);
    }
    for (std::size_t i = 0; has.normals && i < block.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        columns_[e57_normal_x + k][i] = static_cast<double>(block.normals[i][static_cast<Eigen::Index>(k)]);
    with_words([&] { writer_->write(block.size()); });
  }

  void end(std::uint64_t) override {
    with_words([&] { writer_->close(); });
  }

  void commit() override {
    with_words([&] {
      writer_.reset();
      file_.close();
    });
    path_.commit();
  }

 private:
  template <typename Work>
  void with_words(const Work& work) const {
    try {
      work();
    } catch (const e57::E57Exception& exception) {
      throw Error("the file cannot be written (" + e57::Utilities::errorCodeToString(exception.errorCode()) + ")",
                  path_.target().string(), "free some space or write to another disk");
    }
  }
  AtomicPath path_;
  std::vector<ScanFacts> facts_;
  bool doubles_;
  e57::ImageFile file_;
  Nodes make_;
  e57::VectorNode scans_;
  std::string guid_;
  std::array<std::vector<double>, e57_fields> columns_;
  std::optional<e57::CompressedVectorWriter> writer_;
  std::size_t begun_ = 0;
};

}  // namespace

std::unique_ptr<ScanWriter> make_e57_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options) {
  return with_e57_errors(file, [&]() -> std::unique_ptr<ScanWriter> {
    return std::make_unique<E57Writer>(file, scans, options.variant == "double");
  });
}

}  // namespace adit::io
