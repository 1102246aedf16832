#include "io/camera_file.h"

#include <gtest/gtest.h>

#include "io/atomic_file.h"
#include "io/grey_picture_file.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

CameraLens lens_of() {
  CameraLens lens;
  lens.width = 1280;
  lens.height = 800;
  lens.fx = 1001.25;
  lens.fy = 999.75;
  lens.cx = 640.1;
  lens.cy = 399.3;
  lens.k1 = -0.123456789012345;
  lens.k2 = 0.05;
  lens.p1 = 1e-4;
  lens.p2 = -2e-4;
  lens.k3 = 0.01;
  return lens;
}

TEST(CameraFile, ComesBackToTheLastDigit) {
  const tests::TemporaryFolder folder;
  for (const double k4 : {0.0, 0.02}) {
    CameraLens lens = lens_of();
    lens.k4 = k4;
    const auto file = folder.path() / "cam.yaml";
    write_file_atomically(file, camera_text(lens, "a note"));
    const CameraLens back = read_camera(file);
    EXPECT_EQ(back.width, lens.width);
    EXPECT_EQ(back.fx, lens.fx);
    EXPECT_EQ(back.fy, lens.fy);
    EXPECT_EQ(back.cx, lens.cx);
    EXPECT_EQ(back.cy, lens.cy);
    EXPECT_EQ(back.k1, lens.k1);
    EXPECT_EQ(back.p2, lens.p2);
    EXPECT_EQ(back.k3, lens.k3);
    EXPECT_EQ(back.k4, lens.k4);
  }
}

TEST(CameraFile, BrokenOnesAreRefused) {
  const tests::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto file = folder.path() / "cam.yaml";
    write_file_atomically(file, text);
    return tests::error_of([&] { read_camera(file); });
  };
  const std::string good = camera_text(lens_of(), "");
  const auto without = [&](const std::string& word, const std::string& other) {
    std::string text = good;
    return text.replace(text.find(word), word.size(), other);
  };
  tests::expect_words(refusal("image_width: 3"), {"does not begin with %YAML"});
  tests::expect_words(refusal("%YAML:1.0\n---\n[[[{"), {"cam.yaml"});
  tests::expect_words(refusal(without("image_width: 1280", "image_width: wide")), {"image_width"});
  tests::expect_words(refusal(without("camera_matrix", "camera")), {"camera_matrix"});
  tests::expect_words(refusal(without("1001.25", "3.5")), {"focal lengths"});
  tests::expect_words(refusal(without("640.1", "6400")), {"principal point"});
  for (std::size_t cut = 10; cut < good.size(); cut += 23) refusal(good.substr(0, cut));  // a word each, no crash
}

TEST(GreyPictureFile, PngComesBackAndWhatIsNoneIsRefused) {
  const tests::TemporaryFolder folder;
  GreyPicture picture(37, 21);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = static_cast<std::uint8_t>(i * 7);
  const auto file = folder.path() / "p.png";
  const std::string bytes = png_of(picture);
  write_file_atomically(file, bytes);
  const GreyPicture back = read_grey_picture(file);
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.pixels, picture.pixels);
  write_file_atomically(file, bytes.substr(0, 40));
  tests::expect_words(tests::error_of([&] { read_grey_picture(file); }), {"p.png", "no picture, or it is damaged"});
  write_file_atomically(file, "");
  tests::expect_words(tests::error_of([&] { read_grey_picture(file); }), {"empty"});
}

}  // namespace
}  // namespace adit::io
