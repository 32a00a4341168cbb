#pragma once
#include <cstdint>
#include <span>

#include "boxwood/box.h"

namespace boxwood {

/// One side of a candidate split.
struct Side {
  Box box;
  std::uint32_t count = 0;  ///< references on this side
};

/// Answers the one question a top-down builder asks: how likely does a ray that enters a node enter a given part of it?
/// Asked for whole batches of candidates so that the virtual call is paid once per node and axis.
class CostModel {
 public:
  virtual ~CostModel() = default;
  /// out[i] = probability in [0, 1] that a ray that enters `parent` also enters sides[i].box. A parent of measure zero
  /// (a point, an axis-parallel line) gives 1 everywhere. Thread safe. sides.size() == out.size().
  virtual void probabilities(const Box& parent, std::span<const Side> sides, std::span<float> out) const = 0;
};

}  // namespace boxwood
