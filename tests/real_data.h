#pragma once
// Real scans and designs made by others; they lie beside the project and are never part of it.

#include <gtest/gtest.h>

#include <filesystem>

namespace adit::tests {

inline std::filesystem::path real_data() {
  return "../shared/data";
}

}  // namespace adit::tests

/// Skips the test, and says so, where the real data are absent.
#define ADIT_NEED_REAL_DATA()                               \
  if (!std::filesystem::exists(adit::tests::real_data())) { \
    GTEST_SKIP() << "real data absent: ../shared/data";     \
  }                                                         \
  static_assert(true, "")
