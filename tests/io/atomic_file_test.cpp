#include "io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "core/foundation/error.h"
#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::HasSubstr;

template <typename Call>
std::string words_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(AtomicFile, AppearsWithItsContentAtCommit) {
  const tests::TemporaryFolder folder;
  const auto path = folder.write("out.csv", "old");
  {
    AtomicFile file(path);
    for (int i = 0; i < 1'000'000; ++i) file.append("abc");
    file.append(std::string(2'000'000, 'd'));
    EXPECT_EQ(tests::bytes_of(path), "old");
    file.commit();
  }
  EXPECT_EQ(std::filesystem::file_size(path), 5'000'000U);
  EXPECT_EQ(tests::bytes_of(path).substr(2'999'997, 5), "abcdd");
  EXPECT_EQ(tests::files_in(folder.path()), 1U);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const tests::TemporaryFolder folder;
  const auto path = folder.write("out.csv", "old");
  EXPECT_THROW(
      {
        AtomicFile file(path);
        file.append(std::string(3'000'000, 'x'));
        throw Cancelled{};
      },
      Cancelled);
  EXPECT_EQ(tests::bytes_of(path), "old");
  EXPECT_EQ(tests::files_in(folder.path()), 1U);
}

TEST(AtomicFile, ReplacesTheFileBehindALink) {
  const tests::TemporaryFolder folder;
  const auto real = folder.write("real.csv", "old");
  std::filesystem::create_symlink("real.csv", folder / "link.csv");
  write_file_atomically(folder / "link.csv", "new");
  EXPECT_EQ(tests::bytes_of(real), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.csv"));
}

TEST(AtomicFile, RefusesFoldersByName) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(words_of([&] { AtomicFile{folder.path()}; }), HasSubstr("this is a folder"));
  EXPECT_THAT(words_of([&] { write_file_atomically(folder / "none/out.csv", ""); }),
              testing::AllOf(HasSubstr("none/out.csv: there is no folder"), HasSubstr("make the folder first")));
}

/// A limit on the size of files meets the same failing write as a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_before_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_before_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_before_)(int) = nullptr;
};

TEST(AtomicFile, FullDiskNamesFileAndMendAndLeavesNothing) {
  const tests::TemporaryFolder folder;
  const auto path = folder.write("out.ply", "old");
  std::string words;
  {
    const FileSizeLimit limit(100'000);
    words = words_of([&] { write_file_atomically(path, std::string(300'000, 'x')); });
  }
  EXPECT_THAT(words, testing::AllOf(HasSubstr("out.ply: the file cannot be written"), HasSubstr("free some space")));
  EXPECT_EQ(tests::bytes_of(path), "old");
  EXPECT_EQ(tests::files_in(folder.path()), 1U);
}

TEST(AtomicFile, WritersOfScansPassAFullDiskOn) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan(20'000);
  for (const std::string& ending : writable_endings()) {
    const FileSizeLimit limit(100'000);
    EXPECT_THAT(words_of([&] { tests::write_one(folder / ("out" + ending), scan); }), HasSubstr("free some space"));
  }
  EXPECT_EQ(tests::files_in(folder.path()), 0U);
}

}  // namespace
}  // namespace adit::io
