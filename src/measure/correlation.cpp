#include "measure/correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "boxwood/error.h"

namespace boxwood {
namespace {

void check_pairs(std::size_t x, std::size_t y) {
  if (x != y) throw UsageError(fmt::format("a correlation takes pairs, not {} and {} numbers", x, y));
}

std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double shared = static_cast<double>(begin + end - 1) / 2;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = shared;
  }
  return ranks;
}

}  // namespace

double pearson(std::span<const double> x, std::span<const double> y) {
  check_pairs(x.size(), y.size());
  if (x.size() < 2) return 0;
  const auto count = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / count;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - mean_x, dy = y[i] - mean_y;
    xx += dx * dx, yy += dy * dy, xy += dx * dy;
  }
  if (!(xx > 0) || !(yy > 0)) return 0;
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
}

double spearman(std::span<const double> x, std::span<const double> y) {
  check_pairs(x.size(), y.size());
  return pearson(ranks_of(x), ranks_of(y));
}

FittedBlend fit_blend(std::span<const double> sah, std::span<const double> epo, std::span<const double> lcv,
                      std::span<const double> time) {
  check_pairs(sah.size(), time.size());
  check_pairs(epo.size(), time.size());
  if (!lcv.empty()) check_pairs(lcv.size(), time.size());
  FittedBlend best;
  best.correlation = -2;
  std::vector<double> values(sah.size());
  for (int b = 0; b <= (lcv.empty() ? 0 : 100); ++b) {
    for (int a = 0; a + b <= 100; ++a) {
      const MetricBlend blend{a / 100.0, b / 100.0};
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = blend(sah[i], epo[i], lcv.empty() ? 0 : lcv[i]);
      const double correlation = pearson(values, time);
      if (correlation > best.correlation + 1e-12) best = {blend, correlation};
    }
  }
  return best;
}

}  // namespace boxwood
