#pragma once
// What an Error says, for tests of refusals.

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "core/foundation/error.h"

namespace adit::tests {

/// The message of the Error that `call` throws; empty when it throws none.
template <typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline void expect_words(const std::string& words, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(words.find(part), std::string::npos) << "\"" << words << "\" lacks: " << part;
}

}  // namespace adit::tests
