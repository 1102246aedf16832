#include "io/mesh_ply.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/bytes.h"

namespace adit::io {
namespace {

constexpr std::size_t point_size = 3 * sizeof(double) + sizeof(float);
constexpr std::size_t face_size = 1 + 3 * sizeof(std::uint32_t);

std::string header(std::size_t points, std::size_t triangles) {
  return "ply\nformat binary_little_endian 1.0\ncomment Adit: surface in site coordinates, deviation outwards positive "
         "[m]\n"
         "element vertex " +
         std::to_string(points) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty float deviation\nelement face " +
         std::to_string(triangles) + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

template <typename Value>
void put(std::string& bytes, Value value) {
  static_assert(std::endian::native == std::endian::little);
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

/// The number behind a word of the header.
std::uint64_t counted(const InputFile& file, const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  if (at == std::string::npos) throw Error("this is not a surface that Adit wrote", file.name(), "run the job again");
  return std::strtoull(text.c_str() + at + word.size(), nullptr, 10);
}

}  // namespace

void write_mesh_ply(const std::filesystem::path& path, const MeshFile& content, const Eigen::Vector3d& origin) {
  const MeshArrays& mesh = content.mesh;
  AtomicFile file(path);
  file.append(header(mesh.points.size(), mesh.triangles.size()));
  std::string bytes;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Eigen::Vector3d point = mesh.points[i] + origin;
    for (const double coordinate : point) put(bytes, coordinate);
    put(bytes, content.deviation_m.empty() ? std::numeric_limits<float>::quiet_NaN() : content.deviation_m[i]);
  }
  file.append(bytes);
  bytes.clear();
  for (const auto& triangle : mesh.triangles) {
    bytes.push_back(3);
    for (const std::uint32_t corner : triangle) put(bytes, corner);
  }
  file.append(bytes);
  file.commit();
}

MeshFile read_mesh_ply(const std::filesystem::path& path, const Eigen::Vector3d& origin) {
  const InputFile file(path);
  const std::string start = file.beginning(1024);
  const std::uint64_t points = counted(file, start, "element vertex ");
  const std::uint64_t triangles = counted(file, start, "element face ");
  const std::string expected = header(points, triangles);
  if (start.compare(0, expected.size(), expected) != 0 || points > (1ULL << 32) || triangles > (1ULL << 33) ||
      file.size() != expected.size() + points * point_size + triangles * face_size)
    throw Error("this is not a whole surface that Adit wrote", file.name(), "run the job again");
  MeshFile result;
  ByteCursor cursor(file, expected.size(), file.size());
  for (std::uint64_t i = 0; i < points; ++i) {
    const std::byte* at = cursor.take(point_size);
    result.mesh.points.emplace_back(
        Eigen::Vector3d(little<double>(at), little<double>(at + 8), little<double>(at + 16)) - origin);
    result.deviation_m.push_back(little<float>(at + 24));
  }
  for (std::uint64_t i = 0; i < triangles; ++i) {
    const std::byte* at = cursor.take(face_size);
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = little<std::uint32_t>(at + 1 + 4 * k);
      if (triangle[k] >= points)
        throw Error("a triangle names a point that is not there", file.name(), "run the job again");
    }
    result.mesh.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace adit::io
