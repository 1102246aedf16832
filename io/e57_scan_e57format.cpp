#include "io/e57_scan_e57format.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <set>

#include "io/e57_xml.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;
using e57::StructureNode;

constexpr const char* export_again = "export the scan again";
constexpr double beyond_any_site = 1e10;  // some programs write the greatest double where they know no bounds
/// So many records may take no room at all in a file: those that are all alike.
constexpr std::uint64_t most_alike = PointBlock::most_points;

std::optional<double> number(const StructureNode& parent, const char* name) {
  if (!parent.isDefined(name)) return std::nullopt;
  const e57::Node node = parent.get(name);
  switch (node.type()) {
    case e57::E57_INTEGER:
      return static_cast<double>(e57::IntegerNode(node).value());
    case e57::E57_SCALED_INTEGER:
      return e57::ScaledIntegerNode(node).scaledValue();
    case e57::E57_FLOAT:
      return e57::FloatNode(node).value();
    default:
      return std::nullopt;
  }
}

std::optional<StructureNode> structure(const StructureNode& parent, const char* name) {
  if (!parent.isDefined(name) || parent.get(name).type() != e57::E57_STRUCTURE) return std::nullopt;
  return StructureNode(parent.get(name));
}

/// Text of one line.
std::string text(const StructureNode& parent, const char* name) {
  if (!parent.isDefined(name) || parent.get(name).type() != e57::E57_STRING) return {};
  std::string words = e57::StringNode(parent.get(name)).value();
  std::replace_if(
      words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20U; }, ' ');
  const auto begin = words.find_first_not_of(' ');
  return begin == std::string::npos ? "" : words.substr(begin, words.find_last_not_of(' ') - begin + 1);
}

std::optional<Pose> pose_of(const StructureNode& scan, const std::string& where) {
  const auto node = structure(scan, "pose");
  if (!node) return std::nullopt;
  Pose pose = Pose::Identity();
  if (const auto rotation = structure(*node, "rotation")) {
    const auto part = [&](const char* name) { return number(*rotation, name).value_or(0.0); };
    const Eigen::Quaterniond q(part("w"), part("x"), part("y"), part("z"));
    if (!(std::abs(q.norm() - 1.0) < 1e-3))
      throw Error("the rotation of the pose is no unit quaternion", where, export_again);
    pose.linear() = q.normalized().toRotationMatrix();
  }
  if (const auto translation = structure(*node, "translation")) {
    const auto part = [&](const char* name) { return number(*translation, name).value_or(0.0); };
    pose.translation() = Eigen::Vector3d(part("x"), part("y"), part("z"));
    if (!pose.translation().allFinite()) throw Error("the translation of the pose is not finite", where, export_again);
  }
  return pose;
}

/// The day of a time that is counted in seconds of the Global Positioning System, a few seconds beside UTC.
std::string date_text(const StructureNode& time) {
  const double seconds = number(time, "dateTimeValue").value_or(0.0);
  if (!(seconds > 0.0 && seconds < 1e10)) return {};
  const auto begin = std::chrono::sys_days(std::chrono::year(1980) / std::chrono::January / 6);
  const std::chrono::year_month_day day(begin + std::chrono::days(static_cast<int>(seconds / 86400.0)));
  char words[32];
  std::snprintf(words, sizeof words, "%04d-%02u-%02u", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                static_cast<unsigned>(day.day()));
  return words;
}

BoundingBox box_of(const StructureNode& scan) {
  const auto bounds = structure(scan, "cartesianBounds");
  if (!bounds) return {};
  const auto part = [&](const char* name) { return number(*bounds, name).value_or(std::nan("")); };
  const Eigen::Vector3d least(part("xMinimum"), part("yMinimum"), part("zMinimum"));
  const Eigen::Vector3d greatest(part("xMaximum"), part("yMaximum"), part("zMaximum"));
  const double farthest = least.cwiseAbs().cwiseMax(greatest.cwiseAbs()).maxCoeff<Eigen::PropagateNaN>();
  if (!(farthest < beyond_any_site) || (greatest - least).minCoeff() < 0.0) return {};
  return {least, greatest};
}

/// Rows or columns of the raster.
std::uint64_t lines_of(const StructureNode& scan, const std::string& line) {
  const auto bounds = structure(scan, "indexBounds");
  if (!bounds) return 0;
  const double least = number(*bounds, (line + "Minimum").c_str()).value_or(0.0);
  const double greatest = number(*bounds, (line + "Maximum").c_str()).value_or(-1.0);
  return least >= 0.0 && greatest >= least && greatest < 4e9 ? static_cast<std::uint64_t>(greatest - least) + 1 : 0;
}

/// Limits where the scan states them, else what the records can hold; whole bytes where neither says anything.
E57ColourRange colour_range(const StructureNode& scan, const StructureNode& record, const char* colour) {
  const std::string name = std::string("color") + colour;
  double least = 0.0;
  double greatest = 255.0;
  if (record.isDefined(name) && record.get(name).type() == e57::E57_INTEGER) {
    const e57::IntegerNode node(record.get(name));
    least = static_cast<double>(node.minimum());
    greatest = static_cast<double>(node.maximum());
  } else if (record.isDefined(name) && record.get(name).type() == e57::E57_FLOAT) {
    greatest = 1.0;
  }
  if (const auto limits = structure(scan, "colorLimits")) {
    least = number(*limits, (name + "Minimum").c_str()).value_or(least);
    greatest = number(*limits, (name + "Maximum").c_str()).value_or(greatest);
  }
  if (!(greatest > least) || !std::isfinite(greatest - least)) return {};
  return {least, 255.0 / (greatest - least)};
}

/// Bits that one record takes in the file, at least.
std::uint64_t bits_of(const e57::Node& node) {
  const auto span_bits = [](std::int64_t least, std::int64_t most) {
    return std::uint64_t(std::bit_width(static_cast<std::uint64_t>(most) - static_cast<std::uint64_t>(least)));
  };
  switch (node.type()) {
    case e57::E57_INTEGER:
      return span_bits(e57::IntegerNode(node).minimum(), e57::IntegerNode(node).maximum());
    case e57::E57_SCALED_INTEGER:
      return span_bits(e57::ScaledIntegerNode(node).minimum(), e57::ScaledIntegerNode(node).maximum());
    case e57::E57_FLOAT:
      return e57::FloatNode(node).precision() == e57::E57_SINGLE ? 32 : 64;
    case e57::E57_STRING:
      return 8;
    case e57::E57_STRUCTURE: {
      const StructureNode parts(node);
      std::uint64_t bits = 0;
      for (std::int64_t i = 0; i < parts.childCount(); ++i) bits += bits_of(parts.get(i));
      return bits;
    }
    default:
      return 0;
  }
}

/// The number of records stands in the XML alone; nothing may loop over it before the file's size has confirmed it.
std::uint64_t records_in(const e57::CompressedVectorNode& records, std::uint64_t file_bytes, const std::string& where) {
  const std::int64_t count = records.childCount();
  const std::uint64_t bits = bits_of(records.prototype());
  const std::uint64_t most = bits == 0 ? most_alike : 8 * file_bytes / bits;
  if (count < 0 || static_cast<std::uint64_t>(count) > most)
    throw Error("the XML says " + std::to_string(count) + " points; the file has room for " + std::to_string(most),
                where, "the file is damaged; copy or export it again");
  return static_cast<std::uint64_t>(count);
}

/// True when the record holds the field as a number.
bool is_number(const StructureNode& record, const char* name) {
  if (std::string_view(name).find(':') != std::string_view::npos) {
    e57::ustring uri;
    if (!record.destImageFile().extensionsLookupPrefix("nor", uri)) return false;
  }
  if (!record.isDefined(name)) return false;
  const e57::NodeType type = record.get(name).type();
  return type == e57::E57_INTEGER || type == e57::E57_SCALED_INTEGER || type == e57::E57_FLOAT;
}

/// A scale of zero puts all points onto one.
void expect_scales(const StructureNode& record, const std::string& where) {
  for (std::int64_t i = 0; i < record.childCount(); ++i) {
    const e57::Node field = record.get(i);
    if (field.type() != e57::E57_SCALED_INTEGER) continue;
    const double scale = e57::ScaledIntegerNode(field).scale();
    if (!(std::abs(scale) > 0.0) || !std::isfinite(scale))
      throw Error("the scale of " + field.elementName() + " is zero or no number", where, export_again);
  }
}

E57Scan scan_of(const StructureNode& node, const fs::path& path, int n) {
  std::string name = text(node, "name");
  const std::string where = path.string() + ": scan " + std::to_string(n) + (name.empty() ? "" : " (" + name + ")");
  if (name.empty()) name = name_of_scan(path, n);
  if (!node.isDefined("points") || node.get("points").type() != e57::E57_COMPRESSED_VECTOR)
    throw Error("the scan has no points", where, export_again);
  E57Scan scan{{}, {}, false, {}, 0, 0, e57::CompressedVectorNode(node.get("points"))};
  if (scan.records.prototype().type() != e57::E57_STRUCTURE)
    throw Error("the points are no records", where, export_again);
  const StructureNode record(scan.records.prototype());
  expect_scales(record, where);
  for (std::size_t i = 0; i < e57_fields; ++i) scan.has[i] = is_number(record, e57_field_names[i]);
  const auto all_of = [&](E57Field a, E57Field b, E57Field c) { return scan.has[a] && scan.has[b] && scan.has[c]; };
  scan.spherical = !all_of(e57_x, e57_y, e57_z);
  if (scan.spherical && !all_of(e57_range, e57_azimuth, e57_elevation))
    throw Error("the points have neither cartesian nor spherical coordinates", where, export_again);
  scan.rows = lines_of(node, "row");
  scan.columns = lines_of(node, "column");
  scan.colours = {colour_range(node, record, "Red"), colour_range(node, record, "Green"),
                  colour_range(node, record, "Blue")};
  ScanHeader& header = scan.header;
  header.name = name;
  header.where = where;
  header.attributes.intensity = scan.has[e57_intensity];
  header.attributes.colour = all_of(e57_red, e57_green, e57_blue);
  header.attributes.normals = all_of(e57_normal_x, e57_normal_y, e57_normal_z);
  header.attributes.grid = scan.has[e57_row] && scan.has[e57_column];
  header.file_pose = pose_of(node, where);
  header.points = records_in(scan.records, fs::file_size(path), where);
  header.box = box_of(node);
  return scan;
}

}  // namespace

std::vector<E57Scan> e57_scans(const OpenE57& file, const fs::path& path) {
  const StructureNode root = file.library.root();
  std::vector<E57Scan> scans;
  if (root.isDefined("data3D") && root.get("data3D").type() == e57::E57_VECTOR) {
    const e57::VectorNode list(root.get("data3D"));
    for (std::int64_t i = 0; i < list.childCount(); ++i) {
      const int n = static_cast<int>(i) + 1;
      if (list.get(i).type() != e57::E57_STRUCTURE)
        throw Error("the scan is no structure", path.string() + ": scan " + std::to_string(n), export_again);
      scans.push_back(scan_of(StructureNode(list.get(i)), path, n));
      const auto place = static_cast<std::size_t>(i);
      if (place < file.record_places.size()) scans.back().records_begin = file.record_places[place];
    }
  }
  if (scans.empty()) throw Error("the file holds no scans", path.string(), "export it again with its points");
  return scans;
}

std::vector<HeaderFact> e57_description(const e57::ImageFile& file) {
  std::vector<HeaderFact> facts;
  const auto add = [&](const char* name, const std::string& words) {
    if (!words.empty()) facts.push_back({name, words});
  };
  const StructureNode root = file.root();
  add("software", text(root, "e57LibraryVersion"));
  if (const auto created = structure(root, "creationDateTime")) add("creation_date", date_text(*created));
  add("coordinate_system", text(root, "coordinateMetadata"));
  if (root.isDefined("images2D") && root.get("images2D").type() == e57::E57_VECTOR)
    if (const auto images = e57::VectorNode(root.get("images2D")).childCount(); images > 0)
      add("images", std::to_string(images));
  if (!root.isDefined("data3D") || root.get("data3D").type() != e57::E57_VECTOR) return facts;
  const e57::VectorNode scans(root.get("data3D"));
  std::set<std::string> sensors;
  for (std::int64_t i = 0; i < scans.childCount(); ++i) {
    if (scans.get(i).type() != e57::E57_STRUCTURE) continue;
    std::string sensor;
    for (const char* part : {"sensorVendor", "sensorModel", "sensorSerialNumber"})
      if (const std::string words = text(StructureNode(scans.get(i)), part); !words.empty())
        sensor += (sensor.empty() ? "" : " ") + words;
    if (sensors.insert(sensor).second) add("sensor", sensor);
  }
  return facts;
}

OpenE57 open_e57(const fs::path& path) {
  const std::string xml = read_plain_e57_xml(InputFile(path));
  // Xerces begins and ends inside, for the whole program: two threads must not.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  return {e57::ImageFile(path.string(), "r", e57::CHECKSUM_POLICY_NONE), e57_record_places(xml)};
}

Error e57_error(const e57::E57Exception& exception, const fs::path& path) {
  const e57::ErrorCode code = exception.errorCode();
  std::string words = e57::Utilities::errorCodeToString(code);
  std::string context = exception.context();
  std::replace_if(
      context.begin(), context.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20U; }, ' ');
  constexpr std::size_t longest = 160;
  if (context.size() > longest) context = context.substr(0, longest) + " ...";
  if (!context.empty()) words += "; " + context;
  return Error("the E57 library refuses it: " + words, path.string(), "export the file again");
}

}  // namespace adit::io
