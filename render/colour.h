#pragma once
// A colour.

namespace adit::render {

/// Red, green, blue and opacity, each in [0, 1], not premultiplied (sRGB values as files hold them).
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
  bool operator==(const Colour&) const = default;
};

/// Between a (share 0) and b (share 1).
constexpr Colour mixed(const Colour& a, const Colour& b, double share) {
  const double rest = 1.0 - share;
  return {a.red * rest + b.red * share, a.green * rest + b.green * share, a.blue * rest + b.blue * share,
          a.alpha * rest + b.alpha * share};
}

namespace colours {
inline constexpr Colour black{0.0, 0.0, 0.0};
inline constexpr Colour white{1.0, 1.0, 1.0};
inline constexpr Colour grey{0.45, 0.45, 0.45};
inline constexpr Colour light_grey{0.78, 0.78, 0.78};
inline constexpr Colour pale_grey{0.93, 0.93, 0.93};
inline constexpr Colour red{0.75, 0.05, 0.08};
inline constexpr Colour green{0.05, 0.45, 0.18};
inline constexpr Colour ink_blue{0.08, 0.22, 0.45};
inline constexpr Colour overbreak{0.90, 0.33, 0.26};
inline constexpr Colour overbreak_pale{0.98, 0.80, 0.76};
inline constexpr Colour underbreak{0.16, 0.42, 0.75};
inline constexpr Colour underbreak_pale{0.72, 0.84, 0.96};
}  // namespace colours

}  // namespace adit::render
