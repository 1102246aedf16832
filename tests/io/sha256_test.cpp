#include "io/sha256.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

// Examples of FIPS 180-4.
TEST(Sha256, KnownHashes) {
  EXPECT_EQ(sha256_of_bytes(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_bytes("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_bytes(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, FileIsHashedInBlocks) {
  const tests::TemporaryFolder folder;
  const std::string bytes(9'000'001, 'q');
  Progress progress;
  EXPECT_EQ(sha256_of_file(folder.write("a", bytes), progress), sha256_of_bytes(bytes));
  EXPECT_EQ(sha256_of_file(folder.write("b", ""), progress), sha256_of_bytes(""));
}

TEST(Sha256, CanBeCancelled) {
  const tests::TemporaryFolder folder;
  const std::atomic<bool> cancelled{true};
  ProgressTarget target(nullptr, &cancelled);
  Progress progress(target);
  EXPECT_THROW(sha256_of_file(folder.write("a", "abc"), progress), Cancelled);
}

}  // namespace
}  // namespace adit::io
