// Known values of the tests, and how often intervals hold the truth.
#include "measure/significance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "boxwood/error.h"
#include "math/random.h"

namespace boxwood::testing {
namespace {

using Samples = std::vector<double>;

TEST(WelchTest, GivesTheTextbookValue) {
  // Two series of Welch's own kind: unequal sizes and variances. Reference: scipy.stats.ttest_ind(equal_var=False).
  const Samples a = {27.5, 21.0, 19.0, 23.6, 17.0, 17.9, 16.9, 20.1, 21.9, 22.6, 23.1, 19.6, 19.0, 21.7, 21.4};
  const Samples b = {27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0, 24.8, 20.2, 21.9, 22.1, 22.9, 30.5, 24.4};
  EXPECT_NEAR(welch_p_value(a, b), 0.00857, 0.0005);
  EXPECT_EQ(welch_p_value(a, b), welch_p_value(b, a));
}

TEST(WelchTest, WithoutSpreadOrSamples_SaysWhatCanBeSaid) {
  EXPECT_EQ(welch_p_value(Samples{1}, Samples{2, 3}), 1);
  EXPECT_EQ(welch_p_value(Samples{2, 2}, Samples{2, 2}), 1);
  EXPECT_EQ(welch_p_value(Samples{2, 2}, Samples{3, 3}), 0);
}

TEST(PairedTest, IsStudentsTestOfTheDifferences) {
  // Student 1908, the sleep data: t = 4.0621 with 9 degrees of freedom.
  const Samples differences = {1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  EXPECT_NEAR(paired_t_p_value(differences), 0.002833, 1e-6);
  EXPECT_EQ(paired_t_p_value(Samples{5}), 1);
  EXPECT_EQ(paired_t_p_value(Samples{0, 0}), 1);
}

TEST(Holm, MultipliesTheSmallestByTheCountAndNeverFalls) {
  const std::vector<double> adjusted = holm(Samples{0.01, 0.04, 0.03, 0.005});
  const Samples expected = {0.03, 0.06, 0.06, 0.02};
  ASSERT_EQ(adjusted.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-12);
  EXPECT_TRUE(holm(Samples{}).empty());
  EXPECT_EQ(holm(Samples{0.9, 0.8})[0], 1);
}

TEST(Outliers, AreFarBeyondTheQuartiles) {
  EXPECT_EQ(outliers(Samples{1, 2, 3, 4, 5}), 0u);
  EXPECT_EQ(outliers(Samples{1, 2, 3, 4, 5, 100}), 1u);
}

TEST(BootstrapRatio, HoldsTheTrueRatioAboutAsOftenAsItSays) {
  Random random(7);
  constexpr int rounds = 200;
  int held = 0;
  for (int round = 0; round < rounds; ++round) {
    Samples a, b;
    for (int i = 0; i < 20; ++i) {
      const double mood = 1 + 0.3 * random.uniform();  // shared by the pair
      a.push_back(2 * mood * (1 + 0.02 * (random.uniform() - 0.5f)));
      b.push_back(mood * (1 + 0.02 * (random.uniform() - 0.5f)));
    }
    const Estimate ratio = bootstrap_ratio(a, b, true, {.centre = Centre::mean, .resamples = 400});
    held += ratio.low <= 2 && 2 <= ratio.high;
    EXPECT_LT(ratio.high - ratio.low, 0.05);  // the shared mood has no part in it
  }
  EXPECT_GE(held, rounds * 86 / 100);
}

TEST(BootstrapRatio, IsTheSameEveryTimeAndContainsTheRatio) {
  const Samples a = {1, 2, 3, 4, 9}, b = {2, 2, 3, 3, 3};
  const Estimate one = bootstrap_ratio(a, b, false), two = bootstrap_ratio(a, b, false);
  EXPECT_EQ(one.low, two.low);
  EXPECT_EQ(one.high, two.high);
  EXPECT_DOUBLE_EQ(one.median, 1);
  EXPECT_LE(one.low, one.median);
  EXPECT_GE(one.high, one.median);
}

TEST(BootstrapRatio, OfWhatIsNoTime_IsRefused) {
  EXPECT_THROW(bootstrap_ratio(Samples{}, Samples{1}, false), UsageError);
  EXPECT_THROW(bootstrap_ratio(Samples{1}, Samples{0}, false), UsageError);
  EXPECT_THROW(bootstrap_ratio(Samples{1, 2}, Samples{1}, true), UsageError);
  EXPECT_THROW(bootstrap_ratio(Samples{1}, Samples{std::nan("")}, true), UsageError);
}

}  // namespace
}  // namespace boxwood::testing
