#pragma once
// Output for a library that does not survive a disk that is full.

#include <cstdint>
#include <filesystem>
#include <streambuf>
#include <vector>

namespace adit::io {

/// A file for a std::ostream that takes every byte: the first error of the system is kept, and what follows it goes
/// nowhere. Whoever writes asks for error() before the file is believed.
class DeferredOutput : public std::streambuf {
 public:
  /// Opens an existing file.
  explicit DeferredOutput(const std::filesystem::path& file);
  ~DeferredOutput() override;
  DeferredOutput(const DeferredOutput&) = delete;
  DeferredOutput& operator=(const DeferredOutput&) = delete;

  /// Of the system, for what was written so far; 0: none.
  int error() const { return error_; }
  /// The same after everything was handed to the system.
  int flushed_error();

 protected:
  int_type overflow(int_type character) override;
  int sync() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode which) override;

 private:
  std::uint64_t waiting() const { return static_cast<std::uint64_t>(pptr() - pbase()); }

  int descriptor_ = -1;
  int error_ = 0;
  std::uint64_t at_ = 0;   ///< where the first waiting byte goes
  std::uint64_t end_ = 0;  ///< of the file
  std::vector<char> buffer_;
};

}  // namespace adit::io
