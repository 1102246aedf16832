#include "core/georeference/coded_pattern.h"

#include <array>
#include <bit>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"

namespace adit {
namespace {

constexpr int least_black = 3;
constexpr unsigned all_codes = 1U << coded_pattern::segments;

struct CodeBook {
  std::vector<TargetCode> codes;
  std::array<int, 5> differing{};  ///< how many of the first differ in so many segments
  std::vector<int> ids = std::vector<int>(all_codes, 0);

  CodeBook() {
    for (int apart = 4; apart >= 1; --apart) {
      std::vector<bool> too_like(all_codes, false);
      for (const TargetCode code : codes) mark_near(code, apart, too_like);
      for (unsigned code = 0; code < all_codes; ++code) {
        if (std::popcount(code) < least_black || too_like[code]) continue;
        codes.push_back(static_cast<TargetCode>(code));
        ids[code] = static_cast<int>(codes.size());
        mark_near(code, apart, too_like);
      }
      differing[static_cast<std::size_t>(apart)] = static_cast<int>(codes.size());
    }
  }

 private:
  /// What differs from a code in fewer than `apart` segments, itself too.
  static void mark_near(unsigned code, int apart, std::vector<bool>& marks, int from_segment = 0) {
    marks[code] = true;
    for (int k = from_segment; apart > 1 && k < coded_pattern::segments; ++k)
      mark_near(code ^ (1U << k), apart - 1, marks, k + 1);
  }
};

const CodeBook& code_book() {
  static const CodeBook book;
  return book;
}

}  // namespace

bool is_black_at(TargetCode code, double x, double y) {
  const double radius = std::hypot(x, y);
  if (radius > 1.0) return false;
  if (radius <= coded_pattern::disc_radius) return x < 0.0 || y < 0.0;
  if (radius < coded_pattern::ring_radius) return false;
  const double turn_deg = std::fmod(deg_from_rad(std::atan2(y, x)) + 360.0, 360.0);
  return is_black(code, static_cast<int>(turn_deg / (360.0 / coded_pattern::segments)) % coded_pattern::segments);
}

const std::vector<TargetCode>& target_codes() {
  return code_book().codes;
}

int codes_differing_in(int segments) {
  return code_book().differing.at(static_cast<std::size_t>(segments));
}

int id_of_code(TargetCode code) {
  return code < all_codes ? code_book().ids[code] : 0;
}

TargetCode code_of_id(int id) {
  if (id < 1 || id > target_code_count)
    throw Error("there is no target " + std::to_string(id), {},
                "ids run from 1 to " + std::to_string(target_code_count));
  return target_codes()[static_cast<std::size_t>(id - 1)];
}

}  // namespace adit
