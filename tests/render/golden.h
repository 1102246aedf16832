#pragma once
// Pictures compared with those in tests/golden. A picture that differs is left in <temporary folder>/adit-golden; look
// at it, and when it is right copy it to tests/golden.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "render/picture.h"

namespace adit::tests {

inline void keep_for_a_look(const std::string& name, const std::string& bytes) {
  const auto folder = std::filesystem::temp_directory_path() / "adit-golden";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << bytes;
}

inline std::string bytes_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Structural similarity of at least 0.98: fonts may be rasterised a little differently elsewhere.
inline ::testing::AssertionResult like_golden(const render::Picture& picture, const std::string& name) {
  const std::filesystem::path file = std::filesystem::path("tests/golden") / (name + ".png");
  const auto fail = [&] {
    keep_for_a_look(name + ".png", render::png_bytes(picture));
    return ::testing::AssertionFailure();
  };
  if (!std::filesystem::exists(file)) return fail() << file << " is missing";
  const render::Picture golden = render::picture_from_png(bytes_of_file(file));
  if (golden.width != picture.width || golden.height != picture.height) return fail() << name << ": another size";
  const double similarity = render::structural_similarity(picture, golden);
  if (similarity < 0.98) return fail() << name << ": similarity " << similarity;
  return ::testing::AssertionSuccess();
}

}  // namespace adit::tests
