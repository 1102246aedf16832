#pragma once
// Progress on a terminal: one line with a bar, the message and the remaining time.

#include <chrono>
#include <string>

#include "core/foundation/progress.h"

namespace adit::app {

/// Draws on stderr when it is a terminal; elsewhere writes a line at most every second. Silent when quiet.
class TerminalProgress : public ProgressSink {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  void report(double fraction, const std::string& message) override;
  /// Removes the bar before other words are written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point last_;
  std::string last_message_;
};

}  // namespace adit::app
