#include "measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "boxwood/error.h"
#include "math/random.h"

namespace boxwood {
namespace {

std::vector<double> counting_down(std::size_t n) {
  std::vector<double> samples(n);
  std::iota(samples.rbegin(), samples.rend(), 1.0);
  return samples;
}

TEST(Statistics, CentresAndQuantilesMatchHandComputedValues) {
  const std::vector<double> samples = {4, 1, 3, 2};
  EXPECT_EQ(mean(samples), 2.5);
  EXPECT_EQ(median(samples), 2.5);
  EXPECT_EQ(quantile(samples, 0), 1);
  EXPECT_EQ(quantile(samples, 1), 4);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.25), 1.75);
  EXPECT_EQ(median(std::vector<double>{7}), 7);
}

TEST(Statistics, SamplesThatMeanNothingAreRefused) {
  EXPECT_THROW(median({}), UsageError);
  EXPECT_THROW(mean(std::vector<double>{1, std::numeric_limits<double>::infinity()}), UsageError);
  EXPECT_THROW(quantile(std::vector<double>{1}, 1.5), UsageError);
  EXPECT_THROW(estimate_median(std::vector<double>{1}, 1), UsageError);
}

// Ranks from the tables of the sign test at 5 % (two-sided).
TEST(EstimateMedian, TakesTheTabulatedRanks) {
  struct Line {
    std::size_t n;
    double low, high;
  };
  for (const Line& line : {Line{1, 1, 1},
                           {5, 1, 5},
                           {6, 1, 6},
                           {8, 1, 8},
                           {9, 2, 8},
                           {10, 2, 9},
                           {11, 2, 10},
                           {12, 3, 10},
                           {15, 4, 12},
                           {20, 6, 15},
                           {25, 8, 18},
                           {50, 18, 33}}) {
    const Estimate estimate = estimate_median(counting_down(line.n));
    EXPECT_EQ(estimate.low, line.low) << line.n;
    EXPECT_EQ(estimate.high, line.high) << line.n;
    EXPECT_EQ(estimate.median, static_cast<double>(line.n + 1) / 2);
    EXPECT_EQ(estimate.n, line.n);
  }
}

TEST(EstimateMedian, HigherConfidenceWidensTheInterval) {
  const Estimate estimate = estimate_median(counting_down(20), 0.99);
  EXPECT_EQ(estimate.low, 4);
  EXPECT_EQ(estimate.high, 17);
}

TEST(EstimateMedian, IntervalCoversASkewedMedianAsOftenAsPromised) {
  constexpr int experiments = 4000;
  for (const auto& [n, coverage] : {std::pair<std::size_t, double>{11, 0.9883}, {20, 0.9586}, {60, 0.9480 + 0.0132}}) {
    Random random(3, n);
    int covered = 0;
    for (int experiment = 0; experiment < experiments; ++experiment) {
      std::vector<double> samples(n);
      for (double& sample : samples) sample = -std::log(1 - static_cast<double>(random.uniform()));
      const Estimate estimate = estimate_median(samples);
      if (estimate.low <= std::numbers::ln2 && std::numbers::ln2 <= estimate.high) ++covered;
    }
    EXPECT_NEAR(static_cast<double>(covered) / experiments, coverage, 0.012) << n;
  }
}

TEST(EstimateRatio, SeesASmallDifferenceUnderLargeCommonNoise) {
  Random random(5);
  std::vector<double> slow, fast;
  for (int i = 0; i < 15; ++i) {
    const double mood = 1 + 3 * static_cast<double>(random.uniform());
    slow.push_back(1.02 * mood * (1 + 0.002 * static_cast<double>(random.uniform())));
    fast.push_back(mood * (1 + 0.002 * static_cast<double>(random.uniform())));
  }
  const Estimate ratio = estimate_ratio(slow, fast);
  EXPECT_GT(ratio.low, 1.015);
  EXPECT_LT(ratio.high, 1.025);
}

TEST(EstimateRatio, OfASampleWithItselfIsOne) {
  const Estimate ratio = estimate_ratio(counting_down(7), counting_down(7));
  EXPECT_EQ(ratio.low, 1);
  EXPECT_EQ(ratio.median, 1);
  EXPECT_EQ(ratio.high, 1);
}

TEST(EstimateRatio, RefusesSamplesThatAreNoPairs) {
  EXPECT_THROW(estimate_ratio(counting_down(3), counting_down(4)), UsageError);
  EXPECT_THROW(estimate_ratio(counting_down(2), std::vector<double>{1, 0}), UsageError);
}

TEST(SignedRank, MatchesHandCountedDistributions) {
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{1, 2, 3, 4, 5}), 2.0 / 32);
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{-1, -2, -3, -4, -5}), 2.0 / 32);
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{1, 2, 3, 4, -5}), 20.0 / 32);
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), 2.0 / 1024);
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{0, 2, -2, 0, 2}), 1) << "ties: 2 (1 + 3) / 8";
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{2, 2, 2, 3}), 2.0 / 16);
  EXPECT_DOUBLE_EQ(signed_rank_p_value(std::vector<double>{0, 0}), 1);
  EXPECT_DOUBLE_EQ(signed_rank_p_value({}), 1);
}

TEST(SignedRank, NormalApproximationContinuesTheExactDistribution) {
  const auto p_value = [](int n) {
    std::vector<double> differences;
    for (int i = 1; i <= n; ++i) differences.push_back(i % 5 < 2 ? -i : i);
    return signed_rank_p_value(differences);
  };
  EXPECT_GT(p_value(200), 1e-4);
  EXPECT_NEAR(std::log(p_value(205) / p_value(200)), std::log(p_value(200) / p_value(195)), 0.05);
}

TEST(SignedRank, RejectsATrueHypothesisAsOftenAsItSays) {
  Random random(11);
  constexpr int experiments = 4000;
  int rejected = 0;
  for (int experiment = 0; experiment < experiments; ++experiment) {
    std::vector<double> differences(15);
    for (double& difference : differences) difference = static_cast<double>(random.uniform(-1, 1));
    if (signed_rank_p_value(differences) <= 0.05) ++rejected;
  }
  EXPECT_NEAR(static_cast<double>(rejected) / experiments, 0.048, 0.012);
}

}  // namespace
}  // namespace boxwood
