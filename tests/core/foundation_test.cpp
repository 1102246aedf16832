#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <vector>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "core/foundation/progress.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

TEST(Error, SaysPlaceWrongAndMendInOneLine) {
  const Error error = Error("a number is needed", "7:12", "write metres").at("control.csv");
  EXPECT_STREQ(error.what(), "control.csv: 7:12: a number is needed; write metres");
}

struct LastReport : ProgressSink {
  void report(double fraction, const std::string& words) override {
    fractions.push_back(fraction);
    message = words;
  }
  std::vector<double> fractions;
  std::string message;
};

TEST(Progress, PartsFollowEachOtherAndNeverGoBack) {
  LastReport sink;
  ProgressTarget target(&sink);
  Progress whole(target);
  Progress first = whole.part(0.25, "first");
  first.step(1, 2);
  EXPECT_DOUBLE_EQ(sink.fractions.back(), 0.125);
  Progress second = whole.part(0.75, "second");
  EXPECT_EQ(sink.message, "second");
  second.step(1, 3);
  EXPECT_DOUBLE_EQ(sink.fractions.back(), 0.5);
  first.step(2, 2);
  EXPECT_DOUBLE_EQ(sink.fractions.back(), 0.5);
}

TEST(Progress, CancelPassesThroughAParallelLoop) {
  std::atomic<bool> stop{false};
  ProgressTarget target(nullptr, &stop);
  Progress progress(target);
  std::atomic<int> done{0};
  EXPECT_THROW(parallel_for_each_index(
                   100000,
                   [&](std::size_t) {
                     if (++done == 1000) stop = true;
                     progress.check();
                   },
                   1),
               Cancelled);
  EXPECT_LT(done.load(), 100000);
}

TEST(Parallel, OrderedSumIsTheSameOnAnyNumberOfThreads) {
  std::vector<float> values(300001);
  const Random random(7);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(random.uniform(i, -1, 1));
  const auto sum = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    return parallel_ordered_sum(values.size(), 1000, 0.0F, [&](std::size_t begin, std::size_t end) {
      float s = 0;
      for (std::size_t i = begin; i < end; ++i) s += values[i];
      return s;
    });
  };
  const float one = sum(1);
  for (int threads = 2; threads <= 4; ++threads) EXPECT_EQ(one, sum(threads));
}

TEST(Random, UniformAndNormalHaveTheirMoments) {
  const Random random(3, 5);
  double mean = 0, square = 0, normal_mean = 0, normal_square = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(static_cast<std::uint64_t>(i));
    const double g = random.normal(static_cast<std::uint64_t>(i));
    mean += u / n;
    square += u * u / n;
    normal_mean += g / n;
    normal_square += g * g / n;
  }
  EXPECT_NEAR(mean, 0.5, 0.003);
  EXPECT_NEAR(square - mean * mean, 1.0 / 12.0, 0.002);
  EXPECT_NEAR(normal_mean, 0.0, 0.01);
  EXPECT_NEAR(normal_square, 1.0, 0.02);
}

TEST(Angle, WrapsIntoOneTurn) {
  EXPECT_NEAR(wrapped_rad(3 * pi), pi, 1e-12);
  EXPECT_NEAR(wrapped_rad(-pi - 0.1), pi - 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(gon_from_rad(rad_from_deg(90)), 100.0);
}

}  // namespace
}  // namespace adit
