#include "core/foundation/progress.h"

#include <algorithm>

namespace adit {

void ProgressTarget::report(double fraction, const std::string& message) {
  if (sink_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  highest_ = std::max(highest_, std::clamp(fraction, 0.0, 1.0));
  sink_->report(highest_, message);
}

Progress Progress::part(double share, std::string_view message) {
  check();
  Progress child;
  child.target_ = target_;
  child.begin_ = begin_ + (end_ - begin_) * std::min(used_, 1.0);
  used_ += share;
  child.end_ = begin_ + (end_ - begin_) * std::min(used_, 1.0);
  child.message_ = message.empty() ? message_ : std::string(message);
  if (target_ != nullptr) target_->report(child.begin_, child.message_);
  return child;
}

void Progress::step(std::size_t i, std::size_t n) const {
  check();
  if (target_ == nullptr || n == 0) return;
  target_->report(begin_ + (end_ - begin_) * static_cast<double>(i) / static_cast<double>(n), message_);
}

void Progress::check() const {
  if (target_ != nullptr && target_->cancelled()) throw Cancelled{};
}

}  // namespace adit
