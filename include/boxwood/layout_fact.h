#pragma once
#include <string>
#include <vector>

namespace boxwood {

/// One figure that a layout tells about itself, such as its topology's bytes. Facts of several levels add up: sums by
/// `value`, ratios by `value` and `per` apart.
struct LayoutFact {
  std::string name;  ///< field name in JSON, unit included
  double value = 0;
  double per = 0;  ///< above 0: the fact is the ratio value / per

  double figure() const { return per > 0 ? value / per : value; }
};

}  // namespace boxwood
