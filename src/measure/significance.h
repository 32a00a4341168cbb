#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "measure/statistics.h"

namespace boxwood {

// Are two series of timings different, and by how much? No sample is ever left out: the times are CPU times of one
// thread, and where a median is asked for, a few disturbed samples do not move it. outliers() says how many there were.

/// Two-sided p-value of Welch's t-test that two independent series have the same mean. 1 when a series has fewer than
/// two samples; 0 when both are constant and differ.
double welch_p_value(std::span<const double> a, std::span<const double> b);

/// Two-sided p-value of the t-test that `differences` of pairs have mean 0. 1 for fewer than two; 0 when they are all
/// alike and not 0.
double paired_t_p_value(std::span<const double> differences);

/// Holm's correction for asking many questions at once: adjusted p-values in the order given, each at least as large as
/// before and at most 1. Holm 1979. O(n log n).
std::vector<double> holm(std::span<const double> p_values);

/// Samples beyond three interquartile ranges from the quartiles (Tukey's outer fences).
std::uint64_t outliers(std::span<const double> samples);

enum class Centre { median, mean };

struct BootstrapSettings {
  Centre centre = Centre::median;
  std::uint32_t resamples = 2000;
  double confidence = default_confidence;
  std::uint64_t seed = 1;
};

/// centre(numerator) / centre(denominator) with a percentile bootstrap interval; `median` holds the ratio itself.
/// Samples are pairs and are drawn as pairs when `paired`, else each series is drawn by itself. Efron and Tibshirani
/// 1993. Throws UsageError on empty series, pairs of different lengths, or a sample that is not positive.
Estimate bootstrap_ratio(std::span<const double> numerator, std::span<const double> denominator, bool paired,
                         const BootstrapSettings& settings = {});

/// centre(samples) with a percentile bootstrap interval.
Estimate bootstrap_centre(std::span<const double> samples, const BootstrapSettings& settings = {});

double centre_of(std::span<const double> samples, Centre centre);

}  // namespace boxwood
