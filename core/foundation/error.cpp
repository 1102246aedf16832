#include "core/foundation/error.h"

#include <utility>

namespace adit {
namespace {

std::string one_line(const std::string& what_is_wrong, const std::string& where, const std::string& mend) {
  std::string line = where.empty() ? what_is_wrong : where + ": " + what_is_wrong;
  if (!mend.empty()) line += "; " + mend;
  return line;
}

}  // namespace

Error::Error(std::string what_is_wrong, std::string where, std::string mend)
    : std::runtime_error(one_line(what_is_wrong, where, mend)),
      what_is_wrong_(std::move(what_is_wrong)),
      where_(std::move(where)),
      mend_(std::move(mend)) {}

Error Error::at(const std::string& place) const {
  return Error(what_is_wrong_, where_.empty() ? place : place + ": " + where_, mend_);
}

}  // namespace adit
