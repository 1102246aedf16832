#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <span>
#include <string_view>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/camera_file.h"

namespace adit::io {
namespace {

[[noreturn]] void fail(const std::string& what, const std::string& file) {
  throw Error(what, file, "write the file with adit target calibrate, or with OpenCV");
}

/// OpenCV takes the first of two, and whole numbers modulo 2^32.
void check_keys(const std::string& text, const std::string& file) {
  for (const char* key :
       {"image_width", "image_height", "camera_matrix", "distortion_coefficients", "focal_sigma_px"}) {
    const std::string line = std::string("\n") + key + ":";
    const std::size_t first = text.find(line);
    if (first == std::string::npos) continue;
    if (text.find(line, first + 1) != std::string::npos) fail(std::string("the key ") + key + " stands twice", file);
    if (std::string_view(key).substr(0, 5) == "image" && std::strtod(text.c_str() + first + line.size(), nullptr) > 1e6)
      fail(std::string("the key ") + key + " is beyond a million pixels", file);
  }
}

int whole_number(const cv::FileStorage& storage, const char* key, const std::string& file) {
  const cv::FileNode node = storage[key];
  if (!node.isInt()) fail(std::string("the key ") + key + " is missing, or no whole number", file);
  return static_cast<int>(node);
}

cv::Mat numbers(const cv::FileStorage& storage, const char* key, const std::string& file) {
  cv::Mat matrix;
  storage[key] >> matrix;
  if (matrix.empty() || matrix.channels() != 1) fail(std::string("the key ") + key + " is missing, or no matrix", file);
  if (matrix.depth() != CV_64F && matrix.depth() != CV_32F)
    fail(std::string("the key ") + key + " holds whole numbers (dt): digits are lost", file);
  matrix.convertTo(matrix, CV_64F);
  return matrix;
}

/// Files of fisheye lenses have the same keys, with coefficients that mean something else.
void refuse_other_models(const cv::FileStorage& storage, const std::string& file) {
  const auto refuse = [&](const char* key) {
    fail(std::string("the key ") + key +
             " says that the lens is a fisheye or otherwise special, which Adit does not know",
         file);
  };
  for (const char* key : {"distortion_model", "camera_model", "model_type", "model"}) {
    const cv::FileNode node = storage[key];
    if (!node.isString()) continue;
    std::string model = static_cast<std::string>(node);
    std::transform(model.begin(), model.end(), model.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const char* other : {"fisheye", "equidistant", "kannala", "omni", "mei", "scaramuzza", "equirect", "fov"})
      if (model.find(other) != std::string::npos) refuse(key);
  }
  for (const char* key : {"fisheye", "fisheye_model"}) {
    const cv::FileNode node = storage[key];
    if (node.isInt() && static_cast<int>(node) == 0) continue;
    if (!node.isNone() && !node.empty() && !(node.isString() && static_cast<std::string>(node) == "false")) refuse(key);
  }
}

/// OpenCV reads nested lists by recursion: deep ones end the program.
bool is_nested_deeply(const std::string& text) {
  constexpr int most = 20;
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > most) return true;
  }
  return false;
}

CameraLens lens_of(const cv::FileStorage& storage, const std::string& file) {
  refuse_other_models(storage, file);
  CameraLens lens;
  lens.width = whole_number(storage, "image_width", file);
  lens.height = whole_number(storage, "image_height", file);
  const cv::Mat matrix = numbers(storage, "camera_matrix", file);
  if (matrix.rows != 3 || matrix.cols != 3) fail("camera_matrix is not 3 x 3", file);
  if (matrix.at<double>(1, 0) != 0.0 || matrix.at<double>(2, 0) != 0.0 || matrix.at<double>(2, 1) != 0.0 ||
      matrix.at<double>(2, 2) != 1.0)
    fail("camera_matrix is no camera's: its last row is 0, 0, 1, and nothing stands below its diagonal", file);
  lens.fx = matrix.at<double>(0, 0);
  lens.fy = matrix.at<double>(1, 1);
  lens.cx = matrix.at<double>(0, 2);
  lens.cy = matrix.at<double>(1, 2);
  if (matrix.at<double>(0, 1) != 0.0) fail("camera_matrix has a skew, which Adit does not know", file);
  const cv::Mat bends = numbers(storage, "distortion_coefficients", file).reshape(1, 1);
  if (bends.cols != 4 && bends.cols != 5 && bends.cols != 8) {
    for (int k = 8; k < bends.cols; ++k)
      if (bends.at<double>(0, k) != 0.0)
        fail("distortion_coefficients holds thin prism or tilt coefficients, which Adit does not know", file);
    if (bends.cols < 8)
      fail("distortion_coefficients holds " + std::to_string(bends.cols) + " numbers, not 4, 5 or 8", file);
  }
  const std::array<double*, 8> places{&lens.k1, &lens.k2, &lens.p1, &lens.p2, &lens.k3, &lens.k4, &lens.k5, &lens.k6};
  for (int k = 0; k < std::min(8, bends.cols); ++k) *places[static_cast<std::size_t>(k)] = bends.at<double>(0, k);
  if (const cv::FileNode sigma = storage["focal_sigma_px"]; !sigma.empty()) {
    if (!sigma.isReal() && !sigma.isInt()) fail("the key focal_sigma_px is no number", file);
    lens.focal_sigma = static_cast<double>(sigma) / lens.focal_px();
    if (!(lens.focal_sigma >= 0.0 && lens.focal_sigma < 0.1))
      fail("focal_sigma_px is not from 0 to a tenth of the focal length", file);
  }
  try {
    check_lens(lens);
  } catch (const Error& error) {
    throw Error(error.what_is_wrong(), file, error.mend());
  }
  return lens;
}

std::string digits(double value) {
  std::array<char, 40> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

CameraLens read_camera(const std::filesystem::path& path) {
  constexpr std::uint64_t largest_file = std::uint64_t{1} << 20;
  const InputFile file(path);
  if (file.size() == 0 || file.size() > largest_file)
    fail("this is no camera file: it has " + std::to_string(file.size()) + " bytes", file.name());
  const std::string text = file.beginning(static_cast<std::size_t>(file.size()));
  if (text.rfind("%YAML", 0) != 0) fail("this is no camera file: it does not begin with %YAML", file.name());
  if (is_nested_deeply(text)) fail("this is no camera file: its lists are nested more than twenty deep", file.name());
  check_keys(text, file.name());
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!storage.isOpened()) fail("the file is damaged", file.name());
    return lens_of(storage, file.name());
  } catch (const cv::Exception&) {
    fail("the file is damaged", file.name());
  }
}

std::string camera_text(const CameraLens& lens, const std::string& note) {
  const std::array<double, 9> matrix{lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0};
  const std::array<double, 8> bends{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4, lens.k5, lens.k6};
  const bool rational = lens.k4 != 0.0 || lens.k5 != 0.0 || lens.k6 != 0.0;
  const auto add = [](std::string& text, const char* key, std::span<const double> values, int rows) {
    text += std::string(key) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
            "\n   cols: " + std::to_string(values.size() / static_cast<std::size_t>(rows)) + "\n   dt: d\n   data: [ ";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + digits(values[i]);
    text += " ]\n";
  };
  std::string text = "%YAML:1.0\n---\n";
  if (!note.empty()) text += "# " + note + "\n";
  text += "image_width: " + std::to_string(lens.width) + "\nimage_height: " + std::to_string(lens.height) + "\n";
  add(text, "camera_matrix", matrix, 3);
  add(text, "distortion_coefficients", std::span(bends).first(rational ? 8 : 5), 1);
  text += "focal_sigma_px: " + digits(lens.focal_sigma * lens.focal_px()) + "\n";
  return text;
}

}  // namespace adit::io
