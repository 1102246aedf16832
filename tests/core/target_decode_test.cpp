#include "core/georeference/target_decode.h"

#include <gtest/gtest.h>

namespace adit {
namespace {

SegmentDarkness shown_by(TargetCode code) {
  SegmentDarkness darkness;
  for (int k = 0; k < coded_pattern::segments; ++k) {
    darkness.value[static_cast<std::size_t>(k)] = is_black(code, k) ? 0.97 : 0.02;
    darkness.sigma[static_cast<std::size_t>(k)] = 0.01;
  }
  return darkness;
}

std::vector<TargetCode> first_codes(int count) {
  return {target_codes().begin(), target_codes().begin() + count};
}

TEST(NearestCode, AWholeTargetOfAnotherIdIsNoneOfTheList) {
  const auto codes = first_codes(40);
  for (int id = 41; id <= target_code_count; ++id) EXPECT_FALSE(nearest_code(shown_by(code_of_id(id)), codes)) << id;
  for (int id = 1; id <= 40; ++id) {
    const auto read = nearest_code(shown_by(code_of_id(id)), codes);
    ASSERT_TRUE(read) << id;
    EXPECT_EQ(read->code, code_of_id(id));
    EXPECT_FALSE(read->alone) << "all others of the list are far off";
  }
}

TEST(NearestCode, OfAListOfAllEachIsReadAsWithoutOne) {
  for (int id = 1; id <= target_code_count; id += 7) {
    const auto read = nearest_code(shown_by(code_of_id(id)), target_codes());
    ASSERT_TRUE(read) << id;
    EXPECT_EQ(read->code, code_of_id(id));
    EXPECT_TRUE(read->alone) << "the next one differs in a single segment";
  }
}

TEST(NearestCode, AHiddenSegmentIsMadeUpForByTheListAlone) {
  for (int id = 1; id <= 40; ++id) {
    SegmentDarkness darkness = shown_by(code_of_id(id));
    darkness.value[static_cast<std::size_t>(id % coded_pattern::segments)] = 0.5;
    const auto read = nearest_code(darkness, first_codes(40));
    ASSERT_TRUE(read) << id;
    EXPECT_EQ(read->code, code_of_id(id));
    EXPECT_FALSE(nearest_code(darkness, {}));
    EXPECT_FALSE(nearest_code(darkness, target_codes())) << "two codes lie as near";
  }
}

}  // namespace
}  // namespace adit
