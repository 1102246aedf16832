#pragma once
// The one exception of the program: what is wrong, where, and how to mend it.

#include <stdexcept>
#include <string>

namespace adit {

/// Bad input or a request that cannot be met. `where` is "file", "file:line:column" or a key; empty when core throws
/// it, filled in by io or by the step. The command line ends with exit code 2 on it.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string what_is_wrong, std::string where = {}, std::string mend = {});

  const std::string& what_is_wrong() const { return what_is_wrong_; }
  const std::string& where() const { return where_; }
  const std::string& mend() const { return mend_; }

  /// The same error with a place put in front of the place it already has.
  Error at(const std::string& place) const;

 private:
  std::string what_is_wrong_;
  std::string where_;
  std::string mend_;
};

}  // namespace adit
