#include "measure/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "boxwood/error.h"

namespace boxwood {
namespace {

std::vector<double> sorted(std::span<const double> samples) {
  if (samples.empty()) throw UsageError("statistics need at least one sample");
  if (!std::ranges::all_of(samples, [](double x) { return std::isfinite(x); })) {
    throw UsageError("statistics need finite samples");
  }
  std::vector<double> out(samples.begin(), samples.end());
  std::ranges::sort(out);
  return out;
}

double quantile_of_sorted(std::span<const double> ascending, double fraction) {
  const double rank = fraction * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return std::lerp(ascending[below], ascending[above], rank - static_cast<double>(below));
}

/// How many samples may be cut off at either end so that the rest still covers the median: the largest d with
/// 2 P(B <= d) <= 1 - confidence for B ~ binomial(n, 1/2), or 0.
std::size_t ranks_to_cut(std::size_t n, double confidence) {
  const boost::math::binomial_distribution<double> below_median(static_cast<double>(n), 0.5);
  std::size_t cut = 0;
  while (cut < (n - 1) / 2 && 2 * boost::math::cdf(below_median, static_cast<double>(cut + 1)) <= 1 - confidence) ++cut;
  return cut;
}

/// Twice the rank of every |difference|, ascending; ties share the mean of their ranks, which doubling keeps whole.
struct SignedRanks {
  std::vector<std::uint32_t> doubled;
  std::uint64_t doubled_positive_sum = 0;  // over the positive differences
  double tie_correction = 0;               // sum of t^3 - t over groups of t ties
};

SignedRanks signed_ranks(std::span<const double> differences) {
  std::vector<double> nonzero;
  std::ranges::copy_if(differences, std::back_inserter(nonzero), [](double d) { return d != 0; });
  std::ranges::sort(nonzero, {}, [](double d) { return std::fabs(d); });
  SignedRanks ranks;
  for (std::size_t begin = 0, end; begin < nonzero.size(); begin = end) {
    end = begin + 1;
    while (end < nonzero.size() && std::fabs(nonzero[end]) == std::fabs(nonzero[begin])) ++end;
    const auto doubled = static_cast<std::uint32_t>(begin + 1 + end);
    for (std::size_t i = begin; i < end; ++i) {
      ranks.doubled.push_back(doubled);
      if (nonzero[i] > 0) ranks.doubled_positive_sum += doubled;
    }
    const auto ties = static_cast<double>(end - begin);
    ranks.tie_correction += ties * ties * ties - ties;
  }
  return ranks;
}

/// P(sum of a random half of the ranks <= `sum`), by adding one rank after the other.
double exact_probability_up_to(const SignedRanks& ranks, std::uint64_t sum) {
  const std::uint64_t total = std::accumulate(ranks.doubled.begin(), ranks.doubled.end(), std::uint64_t{0});
  std::vector<double> probability(total + 1, 0.0);  // [s] = of reaching sum s with the ranks so far
  probability[0] = 1;
  std::uint64_t reached = 0;
  for (const std::uint32_t rank : ranks.doubled) {
    reached += rank;
    for (std::uint64_t s = reached + 1; s-- > 0;) {
      probability[s] = 0.5 * probability[s] + (s >= rank ? 0.5 * probability[s - rank] : 0);
    }
  }
  return std::accumulate(probability.begin(), probability.begin() + static_cast<std::ptrdiff_t>(sum) + 1, 0.0);
}

}  // namespace

double mean(std::span<const double> samples) {
  const std::vector<double> ascending = sorted(samples);
  return std::accumulate(ascending.begin(), ascending.end(), 0.0) / static_cast<double>(ascending.size());
}

double median(std::span<const double> samples) { return quantile(samples, 0.5); }

double quantile(std::span<const double> samples, double fraction) {
  if (!(fraction >= 0 && fraction <= 1)) throw UsageError(fmt::format("there is no quantile {}; use 0 to 1", fraction));
  return quantile_of_sorted(sorted(samples), fraction);
}

Estimate estimate_median(std::span<const double> samples, double confidence) {
  if (!(confidence > 0 && confidence < 1)) {
    throw UsageError(fmt::format("there is no confidence {}; use more than 0 and less than 1", confidence));
  }
  const std::vector<double> ascending = sorted(samples);
  const std::size_t cut = ranks_to_cut(ascending.size(), confidence);
  return {quantile_of_sorted(ascending, 0.5), ascending[cut], ascending[ascending.size() - 1 - cut], ascending.size()};
}

Estimate estimate_ratio(std::span<const double> numerator, std::span<const double> denominator, double confidence) {
  if (numerator.size() != denominator.size()) {
    throw UsageError(fmt::format("{} samples can not be paired with {}", numerator.size(), denominator.size()));
  }
  std::vector<double> ratios;
  for (std::size_t i = 0; i < numerator.size(); ++i) {
    if (!(denominator[i] > 0)) throw UsageError(fmt::format("ratios need positive samples, not {}", denominator[i]));
    ratios.push_back(numerator[i] / denominator[i]);
  }
  return estimate_median(ratios, confidence);
}

double signed_rank_p_value(std::span<const double> differences) {
  constexpr std::size_t most_exact = 200;
  const SignedRanks ranks = signed_ranks(differences);
  const std::size_t n = ranks.doubled.size();
  if (n == 0) return 1;
  const std::uint64_t total = std::uint64_t{n} * (n + 1);  // of the doubled ranks
  const std::uint64_t smaller = std::min(ranks.doubled_positive_sum, total - ranks.doubled_positive_sum);
  if (n <= most_exact) return std::min(1.0, 2 * exact_probability_up_to(ranks, smaller));

  const auto count = static_cast<double>(n);
  const double expected = count * (count + 1) / 4;
  const double variance = count * (count + 1) * (2 * count + 1) / 24 - ranks.tie_correction / 48;
  const double continuity = 0.5;
  const double z = (static_cast<double>(smaller) / 2 + continuity - expected) / std::sqrt(variance);
  return std::min(1.0, 2 * boost::math::cdf(boost::math::normal_distribution<double>(), z));
}

}  // namespace boxwood
