#include "measure/interleave.h"

#include <gtest/gtest.h>

#include <string>

#include "measure/clock.h"

namespace boxwood {
namespace {

TEST(Interleave, RunsContestantsInTurnAndDropsWarmup) {
  std::string order;
  std::vector<Contestant> contestants;
  for (const char name : {'A', 'B', 'C'}) {
    contestants.push_back([&order, name] {
      order += name;
      return static_cast<double>(order.size());
    });
  }
  const auto seconds = interleave(contestants, {.repeats = 2, .warmup = 1});
  EXPECT_EQ(order, "ABCABCABC");
  EXPECT_EQ(seconds, (std::vector<std::vector<double>>{{4, 7}, {5, 8}, {6, 9}}));
}

TEST(Interleave, NeedsARepeat) { EXPECT_THROW(interleave({}, {.repeats = 0, .warmup = 3}), UsageError); }

TEST(Interleave, StopsWhenAskedTo) {
  class Impatient : public ProgressSink {
    bool report(double fraction, std::string_view) override { return fraction < 0.5; }
  } impatient;
  int runs = 0;
  const std::vector<Contestant> contestants = {[&] {
    ++runs;
    return 1.0;
  }};
  EXPECT_THROW(interleave(contestants, {.repeats = 10, .warmup = 0}, &impatient), Cancelled);
  EXPECT_EQ(runs, 5);
}

TEST(Clock, CpuTimeGrowsWithWork) {
  for (const Clock clock : {Clock::thread_cpu, Clock::wall}) {
    const double begin = now(clock);
    volatile double sum = 0;
    for (int i = 0; i < 1000000; ++i) sum = sum + i;
    EXPECT_GT(now(clock), begin);
    EXPECT_LT(now(clock) - begin, 60);
  }
}

}  // namespace
}  // namespace boxwood
