#include "measure/significance.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "boxwood/error.h"
#include "math/random.h"

namespace boxwood {
namespace {

/// Unbiased sample variance; at least two samples.
double variance(std::span<const double> samples, double mean) {
  double sum = 0;
  for (const double x : samples) sum += (x - mean) * (x - mean);
  return sum / static_cast<double>(samples.size() - 1);
}

double two_sided(double t, double degrees_of_freedom) {
  const boost::math::students_t_distribution<double> distribution(degrees_of_freedom);
  return std::min(1.0, 2 * boost::math::cdf(boost::math::complement(distribution, std::fabs(t))));
}

/// Numbers below `count`, drawn with replacement.
void draw(Random& random, std::uint32_t count, std::vector<std::uint32_t>& out) {
  out.resize(count);
  for (std::uint32_t& index : out) index = random.below(count);
}

/// The centre of samples[indices]; `scratch` saves an allocation per resample.
double resampled_centre(std::span<const double> samples, std::span<const std::uint32_t> indices, Centre centre,
                        std::vector<double>& scratch) {
  scratch.clear();
  for (const std::uint32_t index : indices) scratch.push_back(samples[index]);
  if (centre == Centre::mean) {
    return std::accumulate(scratch.begin(), scratch.end(), 0.0) / static_cast<double>(scratch.size());
  }
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::ranges::nth_element(scratch, middle);
  if (scratch.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(scratch.begin(), middle)) / 2;
}

/// The interval between the percentiles of `resampled`, around the figure itself.
Estimate percentile_interval(double figure, std::span<const double> resampled, std::size_t samples, double confidence) {
  const double tail = (1 - confidence) / 2;
  return {figure, std::min(figure, quantile(resampled, tail)), std::max(figure, quantile(resampled, 1 - tail)),
          samples};
}

void check_ratio(std::span<const double> numerator, std::span<const double> denominator, bool paired) {
  if (numerator.empty() || denominator.empty()) throw UsageError("a ratio needs at least one sample of each series");
  if (paired && numerator.size() != denominator.size()) {
    throw UsageError(fmt::format("{} samples can not be paired with {}", numerator.size(), denominator.size()));
  }
  for (const std::span<const double> series : {numerator, denominator}) {
    for (const double x : series) {
      if (!(x > 0) || !std::isfinite(x)) throw UsageError(fmt::format("ratios need positive samples, not {}", x));
    }
  }
}

}  // namespace

double welch_p_value(std::span<const double> a, std::span<const double> b) {
  if (a.size() < 2 || b.size() < 2) return 1;
  const double mean_a = mean(a), mean_b = mean(b);
  const double share_a = variance(a, mean_a) / static_cast<double>(a.size());
  const double share_b = variance(b, mean_b) / static_cast<double>(b.size());
  const double both = share_a + share_b;
  if (both == 0) return mean_a == mean_b ? 1 : 0;
  const double freedom =
      both * both /
      (share_a * share_a / static_cast<double>(a.size() - 1) + share_b * share_b / static_cast<double>(b.size() - 1));
  return two_sided((mean_a - mean_b) / std::sqrt(both), freedom);
}

double paired_t_p_value(std::span<const double> differences) {
  if (differences.size() < 2) return 1;
  const auto count = static_cast<double>(differences.size());
  const double centre = mean(differences);
  const double spread = variance(differences, centre);
  if (spread == 0) return centre == 0 ? 1 : 0;
  return two_sided(centre / std::sqrt(spread / count), count - 1);
}

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto questions = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, questions * p_values[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

std::uint64_t outliers(std::span<const double> samples) {
  const double low = quantile(samples, 0.25), high = quantile(samples, 0.75);
  const double reach = 3 * (high - low);
  return static_cast<std::uint64_t>(
      std::ranges::count_if(samples, [&](double x) { return x < low - reach || x > high + reach; }));
}

double centre_of(std::span<const double> samples, Centre centre) {
  return centre == Centre::median ? median(samples) : mean(samples);
}

Estimate bootstrap_ratio(std::span<const double> numerator, std::span<const double> denominator, bool paired,
                         const BootstrapSettings& settings) {
  check_ratio(numerator, denominator, paired);
  Random random(settings.seed);
  std::vector<std::uint32_t> above, below;
  std::vector<double> ratios, scratch;
  for (std::uint32_t i = 0; i < settings.resamples; ++i) {
    draw(random, static_cast<std::uint32_t>(numerator.size()), above);
    if (!paired) draw(random, static_cast<std::uint32_t>(denominator.size()), below);
    ratios.push_back(resampled_centre(numerator, above, settings.centre, scratch) /
                     resampled_centre(denominator, paired ? above : below, settings.centre, scratch));
  }
  const double ratio = centre_of(numerator, settings.centre) / centre_of(denominator, settings.centre);
  return percentile_interval(ratio, ratios, std::min(numerator.size(), denominator.size()), settings.confidence);
}

Estimate bootstrap_centre(std::span<const double> samples, const BootstrapSettings& settings) {
  const double figure = centre_of(samples, settings.centre);
  Random random(settings.seed);
  std::vector<std::uint32_t> indices;
  std::vector<double> figures, scratch;
  for (std::uint32_t i = 0; i < settings.resamples; ++i) {
    draw(random, static_cast<std::uint32_t>(samples.size()), indices);
    figures.push_back(resampled_centre(samples, indices, settings.centre, scratch));
  }
  return percentile_interval(figure, figures, samples.size(), settings.confidence);
}

}  // namespace boxwood
