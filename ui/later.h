#pragma once
// A value that is made beside the window's thread, so that the window never waits for it.

#include <tbb/task_arena.h>

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace adit::ui {

/// Made by one of oneTBB's threads: the window starts none of its own.
template <typename Value>
class Later {
 public:
  /// What came out: a value or, in words, why there is none.
  struct Result {
    std::optional<Value> value;
    std::string error;
  };

  Later() = default;
  /// Waits for what is still being made.
  ~Later() {
    if (future_.valid()) future_.wait();
  }
  Later(const Later&) = delete;
  Later& operator=(const Later&) = delete;

  bool busy() const { return future_.valid(); }

  /// Begins; nothing may be under way. `make` must own what it reads.
  void begin(std::function<Value()> make) {
    auto task = std::make_shared<std::packaged_task<Result()>>([make = std::move(make)] { return result_of(make); });
    future_ = task->get_future();
    arena_.enqueue([task] { (*task)(); });
  }

  /// The result, once, as soon as it is there.
  std::optional<Result> take() {
    if (!future_.valid() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    return future_.get();
  }

 private:
  // Nothing may escape into oneTBB's thread; the panel shows the words.
  static Result result_of(const std::function<Value()>& make) {
    try {
      return {make(), {}};
    } catch (const std::exception& failure) {
      return {std::nullopt, failure.what()};
    }
  }

  tbb::task_arena arena_{1, 0};
  std::future<Result> future_;
};

}  // namespace adit::ui
