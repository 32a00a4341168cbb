#pragma once
#include <vector>

namespace boxwood::html {

/// Maps values to [0, 1], with round values to write beside it.
struct Axis {
  double low = 0, high = 1;
  bool logarithmic = false;
  std::vector<double> ticks;

  /// Clamped; values that a logarithm has no place for are at 0.
  double at(double value) const;
};

/// An axis that shows all from `low` to `high`, which must be finite. `logarithmic` needs low > 0 and is ignored
/// otherwise.
Axis axis_over(double low, double high, bool logarithmic);

}  // namespace boxwood::html
