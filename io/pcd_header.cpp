#include "io/pcd_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/foundation/error.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::size_t longest_header_bytes = std::size_t{1} << 20;
constexpr std::uint64_t most_points = 0x7FFFFFFF;  // PCL counts in 32 bits
constexpr std::uint64_t most_values_per_field = 65536;
constexpr std::uint64_t most_point_bytes = std::uint64_t{1} << 20;
constexpr const char* damaged = "the header is damaged; export the file again";

struct TargetName {
  std::string_view name;
  PcdTarget target;
};
constexpr std::array<TargetName, 14> target_names = {{{"x", PcdTarget::x},
                                                      {"y", PcdTarget::y},
                                                      {"z", PcdTarget::z},
                                                      {"intensity", PcdTarget::intensity},
                                                      {"scalar_intensity", PcdTarget::intensity},
                                                      {"reflectance", PcdTarget::intensity},
                                                      {"rgb", PcdTarget::packed_colour},
                                                      {"rgba", PcdTarget::packed_colour},
                                                      {"normal_x", PcdTarget::nx},
                                                      {"normal_y", PcdTarget::ny},
                                                      {"normal_z", PcdTarget::nz},
                                                      {"nx", PcdTarget::nx},
                                                      {"ny", PcdTarget::ny},
                                                      {"nz", PcdTarget::nz}}};

PcdTarget target_of(std::string_view name) {
  for (const TargetName& known : target_names)
    if (known.name == name) return known.target;
  return PcdTarget::none;
}

/// Walks through the header's lines; each function takes one kind of line.
class HeaderParser {
 public:
  explicit HeaderParser(const InputFile& file) : file_(file), text_(file.beginning(longest_header_bytes)) {}

  PcdHeader parsed() {
    while (true) {
      if (!next_line()) fail("the header has no DATA line", "the file is cut short; copy or export it again");
      if (words_.empty() || words_[0].text.starts_with('#')) continue;
      take_line(words_[0].text);
      if (words_[0].text == "DATA") break;
    }
    finish();
    return std::move(header_);
  }

 private:
  bool next_line() {
    const std::size_t end = text_.find('\n', next_);
    if (end == std::string::npos) return false;
    std::string_view line = std::string_view(text_).substr(next_, end - next_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    next_ = end + 1;
    split_at_blanks(line, ++line_, words_);
    return true;
  }

  void take_line(std::string_view key) {
    if (key == "VERSION") return;
    if (key == "FIELDS" || key == "COLUMNS") return take_names();
    if (key == "SIZE") return for_each_field([this](PcdField& field, const Field& word) { take_size(field, word); });
    if (key == "TYPE") return for_each_field([this](PcdField& field, const Field& word) { take_type(field, word); });
    if (key == "COUNT") return for_each_field([this](PcdField& field, const Field& word) { take_count(field, word); });
    if (key == "VIEWPOINT") return take_viewpoint();
    if (words_.size() != 2) fail("unknown header line " + quoted_word(key), damaged);
    if (key == "WIDTH")
      header_.width = whole(words_[1]);
    else if (key == "HEIGHT")
      header_.height = whole(words_[1]);
    else if (key == "POINTS")
      points_ = whole(words_[1]);
    else if (key == "DATA")
      take_encoding(words_[1].text);
    else
      fail("unknown header line " + quoted_word(key), "this is no PCD file, or its header is damaged");
  }

  void take_names() {
    header_.fields.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) {
      PcdField field;
      field.name = words_[i].text;
      field.target = target_of(field.name);
      header_.fields.push_back(std::move(field));
    }
  }

  template <typename Take>
  void for_each_field(const Take& take) {
    if (words_.size() != header_.fields.size() + 1)
      fail("the line has " + std::to_string(words_.size() - 1) + " values for " +
               std::to_string(header_.fields.size()) + " fields",
           damaged);
    for (std::size_t i = 0; i < header_.fields.size(); ++i) take(header_.fields[i], words_[i + 1]);
  }

  void take_size(PcdField& field, const Field& word) {
    field.size = whole(word);
    if (field.size != 1 && field.size != 2 && field.size != 4 && field.size != 8)
      fail("a field cannot have " + std::to_string(field.size) + " bytes", damaged);
  }
  void take_type(PcdField& field, const Field& word) {
    field.type = word.text.size() == 1 ? word.text[0] : '?';
    if (field.type != 'F' && field.type != 'U' && field.type != 'I')
      fail("unknown type " + quoted_word(word.text), damaged);
    if (field.type == 'F' && field.size < 4)
      fail("a float cannot have " + std::to_string(field.size) + " bytes", damaged);
  }
  void take_count(PcdField& field, const Field& word) {
    field.count = whole(word);
    if (field.count < 1 || field.count > most_values_per_field)
      fail("a field cannot have " + std::to_string(field.count) + " values", damaged);
  }

  void take_viewpoint() {
    if (words_.size() != 8) fail("a VIEWPOINT needs seven numbers", "write tx ty tz qw qx qy qz");
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < 7; ++i) {
      const std::string_view text = words_[i + 1].text;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), v[i]);
      if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(v[i]))
        fail("a number is needed, found " + quoted_word(text), "write tx ty tz qw qx qy qz");
    }
    const Eigen::Quaterniond turn(v[3], v[4], v[5], v[6]);
    if (std::abs(turn.norm() - 1.0) > 1e-3)
      fail("the quaternion of the VIEWPOINT has not the length 1", "write qw qx qy qz of a rotation, or 1 0 0 0");
    Pose pose = Pose::Identity();
    pose.linear() = turn.normalized().toRotationMatrix();
    pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
    if (!pose.matrix().isIdentity(0.0)) header_.viewpoint = pose;
  }

  void take_encoding(std::string_view word) {
    if (word == "ascii")
      header_.encoding = PcdEncoding::ascii;
    else if (word == "binary")
      header_.encoding = PcdEncoding::binary;
    else if (word == "binary_compressed")
      header_.encoding = PcdEncoding::compressed;
    else
      fail("unknown DATA " + quoted_word(word), "export as ascii, binary or binary_compressed");
  }

  void finish() {
    if (header_.width > most_points || header_.height > most_points || header_.width * header_.height > most_points)
      fail("the cloud is too large for a PCD file", "split it, or check WIDTH and HEIGHT");
    header_.points = header_.width * header_.height;
    if (points_ && *points_ != header_.points)
      fail("POINTS " + std::to_string(*points_) + " is not WIDTH times HEIGHT, " + std::to_string(header_.points),
           damaged);
    for (PcdField& field : header_.fields) {
      field.offset = header_.point_bytes;
      header_.point_bytes += field.size * field.count;
      header_.values += field.count;
    }
    if (header_.point_bytes > most_point_bytes) fail("a point has more than 1 MiB", damaged);
    header_.body_offset = next_;
    header_.body_line = line_ + 1;
    expect_coordinates();
    if (header_.points == 0) fail("the scan holds no points", "export the scan again with its points");
  }

  void expect_coordinates() const {
    for (const TargetName& wanted : target_names) {
      const auto count = std::count_if(header_.fields.begin(), header_.fields.end(),
                                       [&](const PcdField& f) { return f.name == wanted.name; });
      if (count > 1) fail("the field " + std::string(wanted.name) + " is there twice", damaged);
      if (count == 0 && wanted.target <= PcdTarget::z)
        fail("the points have no " + std::string(wanted.name), "export with the fields x y z");
    }
    for (const PcdField& field : header_.fields) {
      if (field.target == PcdTarget::none) continue;
      if (field.count != 1) fail("the field " + field.name + " must hold one value", damaged);
      if (field.target == PcdTarget::packed_colour && field.size != 4)
        fail("the field " + field.name + " must have 4 bytes", damaged);
    }
  }

  std::uint64_t whole(const Field& word) const {
    std::uint64_t value = 0;
    const char* end = word.text.data() + word.text.size();
    const auto result = std::from_chars(word.text.data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end)
      fail("a whole number is needed, found " + quoted_word(word.text), damaged);
    return value;
  }

  [[noreturn]] void fail(const std::string& what_is_wrong, const std::string& mend) const {
    throw Error(what_is_wrong, file_.name() + ":" + std::to_string(std::max(line_, 1)), mend);
  }

  const InputFile& file_;
  std::string text_;
  std::size_t next_ = 0;
  int line_ = 0;
  std::vector<Field> words_;
  std::optional<std::uint64_t> points_;
  PcdHeader header_;
};

constexpr std::uint64_t most_padding_bytes = 65536;

/// LZF packs 264 bytes into 3 at best.
constexpr std::uint64_t most_lzf_ratio = 88;

void expect_compressed_body(const InputFile& file, const PcdHeader& header) {
  const auto sizes = file.read(header.body_offset, 8, "the sizes of the compressed points");
  const std::uint64_t packed = little<std::uint32_t>(sizes.data());
  const std::uint64_t unpacked = little<std::uint32_t>(sizes.data() + 4);
  file.expect_records(header.body_offset + 8, packed, 1, "compressed bytes");
  if (unpacked != header.points * header.point_bytes)
    throw Error("the compressed points are " + std::to_string(unpacked) + " bytes, the header says " +
                    std::to_string(header.points) + " points of " + std::to_string(header.point_bytes) + " bytes",
                file.at_byte(header.body_offset + 4), damaged);
  if (unpacked / most_lzf_ratio > packed)
    throw Error(std::to_string(packed) + " compressed bytes cannot hold " + std::to_string(unpacked),
                file.at_byte(header.body_offset), "the file is damaged; export it again");
}

/// Old writers of PCL fill the file up to a page with zeros; anything else behind the points contradicts the header.
void expect_nothing_behind(const InputFile& file, const PcdHeader& header) {
  const std::uint64_t end = header.body_offset + header.points * header.point_bytes;
  const std::uint64_t rest = file.size() - end;
  if (rest < header.point_bytes) return;
  bool padding = rest <= most_padding_bytes;
  if (padding)
    for (const std::byte b : file.read(end, static_cast<std::size_t>(rest), "the end"))
      padding = padding && b == std::byte{0};
  if (!padding)
    throw Error("the file holds " + std::to_string(rest) + " bytes more than its header says (" +
                    std::to_string(header.points) + " points of " + std::to_string(header.point_bytes) + " bytes)",
                file.at_byte(end), damaged);
}

void expect_body(const InputFile& file, const PcdHeader& header) {
  if (header.encoding == PcdEncoding::compressed) return expect_compressed_body(file, header);
  // A line of text holds a letter and an end for each value at least; the last line may lack its end.
  const bool ascii = header.encoding == PcdEncoding::ascii;
  const std::uint64_t record = ascii ? 2 * header.values - 1 : header.point_bytes;
  file.expect_records(header.body_offset, header.points, record, "points");
  if (!ascii) expect_nothing_behind(file, header);
}

}  // namespace

PcdHeader read_pcd_header(const InputFile& file) {
  PcdHeader header = HeaderParser(file).parsed();
  expect_body(file, header);
  return header;
}

Attributes pcd_attributes(const PcdHeader& header) {
  const auto has = [&](PcdTarget target) {
    return std::any_of(header.fields.begin(), header.fields.end(),
                       [&](const PcdField& f) { return f.target == target; });
  };
  return {has(PcdTarget::intensity), has(PcdTarget::packed_colour),
          has(PcdTarget::nx) && has(PcdTarget::ny) && has(PcdTarget::nz)};
}

}  // namespace adit::io
