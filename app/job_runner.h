#pragma once
// A job on a thread of its own: start, cancel, poll. What the window and its tests use.

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "app/run_job.h"

namespace adit::app {

class JobRunner {
 public:
  enum class Outcome { none, done, cancelled, failed };

  /// What is known at this moment; a value.
  struct Snapshot {
    bool running = false;
    double fraction = 0.0;
    std::string message;
    Outcome outcome = Outcome::none;        ///< of the last run
    std::string error;                      ///< of the last run, one line
    std::shared_ptr<const JobState> state;  ///< of the last run that ended well
  };

  JobRunner() = default;
  ~JobRunner();  ///< cancels and waits
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  /// Begins a run; does nothing while one is running.
  void start(const std::filesystem::path& job_file, const RunOptions& options);
  void cancel() { cancelled_ = true; }
  Snapshot poll() const;
  /// Waits for the end of the run.
  void wait();

 private:
  class Sink;
  void run(const std::filesystem::path& job_file, const RunOptions& options);

  std::atomic<bool> cancelled_{false};
  mutable std::mutex mutex_;
  Snapshot snapshot_;
  std::thread thread_;
};

}  // namespace adit::app
