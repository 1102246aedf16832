#include "app/job_runner.h"

#include <exception>

#include "core/foundation/error.h"

namespace adit::app {

class JobRunner::Sink : public ProgressSink {
 public:
  explicit Sink(JobRunner& runner) : runner_(runner) {}
  void report(double fraction, const std::string& message) override {
    const std::lock_guard lock(runner_.mutex_);
    runner_.snapshot_.fraction = fraction;
    runner_.snapshot_.message = message;
  }

 private:
  JobRunner& runner_;
};

JobRunner::~JobRunner() {
  cancel();
  wait();
}

void JobRunner::start(const std::filesystem::path& job_file, const RunOptions& options) {
  if (poll().running) return;
  wait();
  cancelled_ = false;
  {
    const std::lock_guard lock(mutex_);
    snapshot_.running = true;
    snapshot_.fraction = 0.0;
    snapshot_.message = "starting";
    snapshot_.error.clear();
    snapshot_.outcome = Outcome::none;
  }
  thread_ = std::thread([this, job_file, options] { run(job_file, options); });
}

void JobRunner::run(const std::filesystem::path& job_file, const RunOptions& options) {
  Sink sink(*this);
  ProgressTarget target(&sink, &cancelled_);
  Progress progress(target);
  std::shared_ptr<JobState> state;
  Outcome outcome = Outcome::done;
  std::string error;
  try {
    state = run_job(job_file, options, progress);
  } catch (const Cancelled&) {
    outcome = Outcome::cancelled;
  } catch (const std::exception& failure) {
    outcome = Outcome::failed;
    error = failure.what();
  }
  const std::lock_guard lock(mutex_);
  snapshot_.running = false;
  snapshot_.outcome = outcome;
  snapshot_.error = error;
  if (state) snapshot_.state = state;
}

JobRunner::Snapshot JobRunner::poll() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

void JobRunner::wait() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace adit::app
