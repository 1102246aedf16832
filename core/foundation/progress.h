#pragma once
// Fraction and message handed down the calls; the way a run is cancelled.

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace adit {

/// Thrown by Progress when the user has cancelled. Deliberately not an Error.
struct Cancelled {};

/// Receives progress; the terminal, the window and tests implement it. Called from any thread, never concurrently.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// fraction of the whole job in [0, 1], never going back; message names what is being done.
  virtual void report(double fraction, const std::string& message) = 0;
};

/// What a whole run shares: the sink and the wish to stop. Owned by the caller, outlives every Progress made of it.
class ProgressTarget {
 public:
  explicit ProgressTarget(ProgressSink* sink = nullptr, const std::atomic<bool>* cancelled = nullptr)
      : sink_(sink), cancelled_(cancelled) {}
  bool cancelled() const { return cancelled_ != nullptr && cancelled_->load(std::memory_order_relaxed); }
  void report(double fraction, const std::string& message);

 private:
  ProgressSink* sink_;
  const std::atomic<bool>* cancelled_;
  std::mutex mutex_;
  double highest_ = 0.0;
};

/// A share of the run's progress bar. Pass it down by reference; hand parts of it to callees with part().
class Progress {
 public:
  /// Silent and never cancelled: for tests and small calls.
  Progress() = default;
  explicit Progress(ProgressTarget& target) : target_(&target) {}

  /// The next `share` (of this Progress, 0..1) as a child with its own message. Parts follow each other.
  Progress part(double share, std::string_view message);

  /// Reports that i of n are done and throws Cancelled when asked to stop. May be called from any thread.
  void step(std::size_t i, std::size_t n) const;

  /// Throws Cancelled when asked to stop.
  void check() const;

 private:
  ProgressTarget* target_ = nullptr;
  double begin_ = 0.0;
  double end_ = 1.0;
  double used_ = 0.0;
  std::string message_;
};

}  // namespace adit
