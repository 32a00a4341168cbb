#pragma once
#include <cstdint>
#include <span>

namespace boxwood {

/// A measured figure: the median of `n` samples and an interval that holds the true median with the confidence asked
/// for.
struct Estimate {
  double median = 0, low = 0, high = 0;
  std::uint64_t n = 0;
};

inline constexpr double default_confidence = 0.95;

// All of these take at least one finite sample and throw UsageError on none. O(n log n).

double mean(std::span<const double> samples);
double median(std::span<const double> samples);
/// Linear interpolation between order statistics (Hyndman and Fan 1996, type 7); `fraction` in [0, 1].
double quantile(std::span<const double> samples, double fraction);

/// Median with a distribution-free interval between two order statistics, symmetric in rank: the narrowest whose
/// binomial(n, 1/2) coverage reaches `confidence`. Fewer than six samples can not reach 95 %; then the interval is
/// their whole range, with coverage 1 - 2^(1 - n). David and Nagaraja, "Order Statistics", section 7.1.
Estimate estimate_median(std::span<const double> samples, double confidence = default_confidence);

/// Median of the ratios numerator[i] / denominator[i] of paired samples, with the interval of estimate_median. Pairs
/// that were measured one after the other share the machine's mood, so their ratio does not. Throws UsageError when the
/// lengths differ or a denominator is not positive.
Estimate estimate_ratio(std::span<const double> numerator, std::span<const double> denominator,
                        double confidence = default_confidence);

/// Two-sided p-value of the Wilcoxon signed-rank test that `differences` are symmetric around zero. Zeros are left out,
/// ties share their mean rank; exact distribution up to 200 differences, normal approximation with tie correction
/// beyond. 1 when nothing is left.
double signed_rank_p_value(std::span<const double> differences);

}  // namespace boxwood
