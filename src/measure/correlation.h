#pragma once
#include <span>

namespace boxwood {

// How well a metric of trees goes with the time their rays take. Both take pairs x[i], y[i] and throw UsageError when
// the lengths differ.

/// Pearson's correlation in [-1, 1]; 0 when either does not vary or there are fewer than two pairs.
double pearson(std::span<const double> x, std::span<const double> y);
/// Spearman's: Pearson's of the ranks, ties sharing their mean rank.
double spearman(std::span<const double> x, std::span<const double> y);

/// (1 - alpha - beta) sah + alpha epo + beta lcv. Aila, Karras, Laine 2013.
struct MetricBlend {
  double alpha = 0, beta = 0;
  double operator()(double sah, double epo, double lcv) const {
    return (1 - alpha - beta) * sah + alpha * epo + beta * lcv;
  }
};

/// The blend, in steps of 0.01, that goes best with `time` by Pearson's correlation; the smallest weights of equals.
/// `lcv` may be empty: then beta stays 0. Few trees fit anything: read it with their number in mind. O(n) or 5000 n.
struct FittedBlend {
  MetricBlend blend;
  double correlation = 0;
};
FittedBlend fit_blend(std::span<const double> sah, std::span<const double> epo, std::span<const double> lcv,
                      std::span<const double> time);

}  // namespace boxwood
