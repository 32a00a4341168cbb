#include "report/html/axis.h"

#include <algorithm>
#include <cmath>

namespace boxwood::html {
namespace {

/// 1, 2 or 5 times a power of ten, for about five steps.
double round_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (range / (factor * power) <= 6) return factor * power;
  }
  return 10 * power;
}

/// Multiples of a round number, over at least `low` to `high`.
Axis even_axis(double low, double high) {
  const double step = round_step(high - low);
  Axis axis{.low = std::floor(low / step) * step, .high = std::ceil(high / step) * step, .ticks = {}};
  const auto steps = std::lround((axis.high - axis.low) / step);
  for (long i = 0; i <= steps; ++i) axis.ticks.push_back(axis.low + static_cast<double>(i) * step);
  return axis;
}

Axis logarithmic_axis(double low, double high) {
  Axis axis{.low = low / 1.1, .high = high * 1.1, .logarithmic = true, .ticks = {}};
  const bool few = std::log10(axis.high / axis.low) < 1.5;
  double power = std::pow(10.0, std::floor(std::log10(axis.low)));
  while (power <= axis.high) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * power;
      if ((few || factor == 1) && tick >= axis.low && tick <= axis.high) axis.ticks.push_back(tick);
    }
    power *= 10;
  }
  if (axis.ticks.size() < 2) {  // less than a decade: even steps look the same
    axis = even_axis(axis.low, axis.high);
    axis.logarithmic = axis.low > 0;
  }
  return axis;
}

}  // namespace

double Axis::at(double value) const {
  if (logarithmic && !(value > 0)) return 0;
  const double t = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::clamp(t, 0.0, 1.0);
}

Axis axis_over(double low, double high, bool logarithmic) {
  if (logarithmic && low > 0) return logarithmic_axis(low, high);
  if (!(high > low)) {
    const double room = low == 0 ? 1 : std::fabs(low) / 10;
    low -= room;
    high += room;
  }
  return even_axis(low, high);
}

}  // namespace boxwood::html
