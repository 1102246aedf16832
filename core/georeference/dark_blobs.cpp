#include "core/georeference/dark_blobs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace adit {
namespace {

/// Sums of a blob over whole pixels.
struct Sums {
  std::int64_t n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
  bool at_rim = false;

  /// The pixels first .. last - 1 of a row.
  void add_run(std::int64_t first, std::int64_t last, std::int64_t row) {
    const auto sum = [](std::int64_t k) { return k * (k - 1) / 2; };  // 0 + ... + k - 1
    const auto squares = [](std::int64_t k) { return (k - 1) * k * (2 * k - 1) / 6; };
    const std::int64_t count = last - first, along = sum(last) - sum(first);
    n += count;
    u += along;
    v += count * row;
    uu += squares(last) - squares(first);
    uv += along * row;
    vv += count * row * row;
  }
  Sums& operator+=(const Sums& other) {
    n += other.n;
    u += other.u;
    v += other.v;
    uu += other.uu;
    uv += other.uv;
    vv += other.vv;
    at_rim = at_rim || other.at_rim;
    return *this;
  }
};

DarkBlob blob_of(const Sums& sums) {
  const auto n = static_cast<double>(sums.n);
  DarkBlob blob;
  blob.area_px2 = n;
  blob.center = {static_cast<double>(sums.u) / n, static_cast<double>(sums.v) / n};
  const auto moment = [&](std::int64_t sum, double a, double b) { return static_cast<double>(sum) / n - a * b; };
  const double uv = moment(sums.uv, blob.center.x(), blob.center.y());
  // A pixel is a square of its own: 1/12 more.
  blob.covariance_px2 << moment(sums.uu, blob.center.x(), blob.center.x()) + 1.0 / 12.0, uv, uv,
      moment(sums.vv, blob.center.y(), blob.center.y()) + 1.0 / 12.0;
  return blob;
}

/// Runs of dark pixels, put together from row to row.
class Labels {
 public:
  void begin_row(int rows_done) {
    above_.swap(present_);
    present_.clear();
    row_ = rows_done;
    next_above_ = 0;
  }

  void add_run(int first, int last, bool at_rim) {
    Sums sums;
    sums.add_run(first, last, row_);
    sums.at_rim = at_rim;
    int label = -1;
    while (next_above_ < above_.size() && above_[next_above_].last <= first) ++next_above_;
    for (std::size_t i = next_above_; i < above_.size() && above_[i].first < last; ++i) {
      const int other = root(above_[i].label);
      if (label < 0) label = other;
      if (other != label) {
        blobs_[static_cast<std::size_t>(label)] += blobs_[static_cast<std::size_t>(other)];
        parent_[static_cast<std::size_t>(other)] = label;
      }
    }
    if (label < 0) {
      label = static_cast<int>(blobs_.size());
      blobs_.push_back({});
      parent_.push_back(label);
    }
    blobs_[static_cast<std::size_t>(label)] += sums;
    present_.push_back({first, last, label});
  }

  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < blobs_.size(); ++i)
      if (parent_[i] == static_cast<int>(i)) visit(blobs_[i]);
  }

 private:
  struct Run {
    int first, last, label;
  };
  int root(int label) {
    while (parent_[static_cast<std::size_t>(label)] != label) {
      int& parent = parent_[static_cast<std::size_t>(label)];
      parent = parent_[static_cast<std::size_t>(parent)];
      label = parent;
    }
    return label;
  }

  std::vector<Run> above_, present_;
  std::vector<Sums> blobs_;
  std::vector<int> parent_;
  std::size_t next_above_ = 0;
  int row_ = 0;
};

/// Rows of a picture in order, each pixel compared with the mean of a square window about it.
class DarkPixels {
 public:
  DarkPixels(const GreyPicture& picture, int half_px)
      : picture_(picture),
        half_px_(half_px),
        columns_(static_cast<std::size_t>(picture.width), 0),
        sums_(static_cast<std::size_t>(picture.width) + 1, 0) {
    for (int v = 0; v < std::min(half_px, picture.height); ++v) add_row(v);
  }

  /// Goes to row v, the next one: marks[u] is 1 where the pixel is darker than its window's mean by the contrast.
  void mark_row(int v, float contrast, std::vector<std::uint8_t>& marks) {
    if (v + half_px_ < picture_.height) add_row(v + half_px_);
    if (v - half_px_ - 1 >= 0) remove_row(v - half_px_ - 1);
    sum_columns();
    const int rows = std::min(v + half_px_, picture_.height - 1) - std::max(v - half_px_, 0) + 1;
    const int width = picture_.width, inside = std::min(half_px_, width), last = std::max(inside, width - half_px_);
    const std::uint8_t* row = picture_.pixels.data() + picture_.index(0, v);
    const auto mark_near_rim = [&](int u) {
      const int left = std::max(u - half_px_, 0), right = std::min(u + half_px_ + 1, width);
      const float mean = static_cast<float>(sum(left, right)) / static_cast<float>(rows * (right - left));
      marks[static_cast<std::size_t>(u)] = static_cast<float>(row[u]) < mean - contrast;
    };
    for (int u = 0; u < inside; ++u) mark_near_rim(u);
    for (int u = last; u < width; ++u) mark_near_rim(u);
    const float of_whole = 1.0F / static_cast<float>(rows * (2 * half_px_ + 1));
    for (int u = inside; u < last; ++u)
      marks[static_cast<std::size_t>(u)] =
          static_cast<float>(row[u]) < static_cast<float>(sum(u - half_px_, u + half_px_ + 1)) * of_whole - contrast;
  }

 private:
  int sum(int left, int right) const {
    return sums_[static_cast<std::size_t>(right)] - sums_[static_cast<std::size_t>(left)];
  }
  void sum_columns() {
    constexpr std::size_t at_once = 8;
    const std::size_t count = columns_.size();
    const std::uint16_t* const columns = columns_.data();
    int* const sums = sums_.data() + 1;
    int sum = 0;
    std::size_t u = 0;
    for (; u + at_once <= count; u += at_once)
      for (std::size_t k = 0; k < at_once; ++k) sums[u + k] = sum += columns[u + k];
    for (; u < count; ++u) sums[u] = sum += columns[u];
  }
  void add_row(int row) {
    const std::uint8_t* pixels = picture_.pixels.data() + picture_.index(0, row);
    for (std::size_t u = 0; u < columns_.size(); ++u) columns_[u] = static_cast<std::uint16_t>(columns_[u] + pixels[u]);
  }
  void remove_row(int row) {
    const std::uint8_t* pixels = picture_.pixels.data() + picture_.index(0, row);
    for (std::size_t u = 0; u < columns_.size(); ++u) columns_[u] = static_cast<std::uint16_t>(columns_[u] - pixels[u]);
  }

  const GreyPicture& picture_;
  int half_px_;
  std::vector<std::uint16_t> columns_;  ///< over the rows of the window
  std::vector<int> sums_;               ///< of the columns before each
};

}  // namespace

GreyPicture half_size(const GreyPicture& picture) {
  GreyPicture half(picture.width / 2, picture.height / 2);
  for (int v = 0; v < half.height; ++v) {
    const std::uint8_t* row = picture.pixels.data() + picture.index(0, 2 * v);
    const std::uint8_t* next = row + picture.width;
    std::uint8_t* out = half.pixels.data() + half.index(0, v);
    for (int u = 0; u < half.width; ++u)
      out[u] = static_cast<std::uint8_t>((row[2 * u] + row[2 * u + 1] + next[2 * u] + next[2 * u + 1] + 2) / 4);
  }
  return half;
}

double noise_of(const GreyPicture& picture) {
  constexpr int every = 5;
  std::array<std::size_t, 256> counts{};
  std::size_t n = 0;
  for (int v = 0; v < picture.height; v += every)
    for (int u = 0; u + 1 < picture.width; u += every, ++n)
      ++counts[static_cast<std::size_t>(std::abs(picture.at(u, v) - picture.at(u + 1, v)))];
  // Whole grey levels: the median between them, of values spread evenly over each.
  std::size_t below = 0;
  for (std::size_t level = 0; level < counts.size(); ++level) {
    if (2 * (below + counts[level]) >= n && counts[level] > 0) {
      const double share =
          (0.5 * static_cast<double>(n) - static_cast<double>(below)) / static_cast<double>(counts[level]);
      const double median = level == 0 ? 0.5 * share : static_cast<double>(level) - 0.5 + share;
      return median / (0.6745 * std::sqrt(2.0));
    }
    below += counts[level];
  }
  return 0.0;
}

std::vector<DarkBlob> dark_blobs(const GreyPicture& picture, const DarkBlobOptions& options) {
  std::vector<DarkBlob> found;
  if (picture.width < 8 || picture.height < 8) return found;
  DarkPixels pixels(picture, options.window_px / 2);
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(picture.width));
  const std::uint8_t *const begin = marks.data(), *const end = begin + marks.size();
  Labels labels;
  for (int v = 0; v < picture.height; ++v) {
    pixels.mark_row(v, static_cast<float>(options.least_contrast), marks);
    labels.begin_row(v);
    const auto next = [&](const std::uint8_t* from, std::uint8_t mark) {
      const void* at = from < end ? std::memchr(from, mark, static_cast<std::size_t>(end - from)) : nullptr;
      return at ? static_cast<const std::uint8_t*>(at) : end;
    };
    for (const std::uint8_t* first = next(begin, 1); first < end;) {
      const std::uint8_t* const last = next(first, 0);
      labels.add_run(static_cast<int>(first - begin), static_cast<int>(last - begin),
                     first == begin || last == end || v == 0 || v == picture.height - 1);
      first = next(last, 1);
    }
  }
  labels.for_each([&](const Sums& sums) {
    const auto area = static_cast<double>(sums.n);
    if (!sums.at_rim && area >= options.least_area_px2 && area <= options.most_area_px2) found.push_back(blob_of(sums));
  });
  return found;
}

}  // namespace adit
