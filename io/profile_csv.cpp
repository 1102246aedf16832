#include "io/profile_csv.h"

#include <vector>

#include "core/foundation/error.h"
#include "io/csv_rows.h"
#include "io/text_line.h"

namespace adit::io {
namespace {

constexpr double repeated_m = 1e-3;

struct Vertex {
  Eigen::Vector2d position;
  double bulge;
};

std::vector<Vertex> read_vertices(const std::filesystem::path& file) {
  const std::string form = "offset,height or offset,height,bulge";
  CsvRows rows(file, CsvRows::Blanks::separate, 0);
  std::vector<Vertex> vertices;
  while (rows.next()) {
    if (vertices.empty()) rows.expect_header({"oxdy", "hzeyl", "b"}, form);
    rows.expect_fields(2, 3, form);
    vertices.push_back({{rows.number(0), rows.number(1)}, rows.fields().size() == 3 ? rows.number(2) : 0.0});
  }
  if (vertices.size() > 1 && (vertices.back().position - vertices.front().position).norm() < repeated_m) {
    vertices.pop_back();
  }
  if (vertices.size() < 2) throw Error("the file holds no line", file.string(), "write " + form);
  return vertices;
}

}  // namespace

Profile read_profile_csv(const std::filesystem::path& file) {
  const std::vector<Vertex> vertices = read_vertices(file);
  std::vector<ProfileSegment> segments;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    segments.push_back({vertices[i].position, vertices[(i + 1) % vertices.size()].position, vertices[i].bulge});
  }
  try {
    return Profile(file.stem().string(), std::move(segments));
  } catch (const Error& error) {
    throw Error(error.what_is_wrong(), file.string(), error.mend());
  }
}

std::string profile_csv_text(const Profile& profile) {
  std::string text = "offset,height,bulge\n";
  for (const ProfileSegment& segment : profile.segments()) {
    text += TextLine(',').add(segment.start.x(), 9).add(segment.start.y(), 9).add(segment.bulge, 12).ended();
  }
  return text;
}

}  // namespace adit::io
