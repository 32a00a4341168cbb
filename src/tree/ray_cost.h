#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "math/segment.h"
#include "tree/statistics.h"
#include "tree/tree.h"

namespace boxwood {

/// What rays that end where they are told to cost in a tree: every node they meet up to there is visited, as by a
/// traversal that goes from near to far without a miss. Means over rays.
struct RayCost {
  std::uint64_t rays = 0;
  double inner_nodes = 0, leaves = 0, references = 0;
  double cost = 0;  ///< the traversal constant times inner nodes plus the intersection constant times references
  /// Leaf count variability: the standard deviation of the leaves that a ray meets. Aila, Karras, Laine 2013.
  double lcv = 0;
};

/// All 0 without rays or nodes. In parallel; the same for any number of threads. O(rays * nodes met).
RayCost ray_cost(const Tree& tree, std::span<const Segment> rays, const SahConstants& constants = {});

/// Sight lines for judging a tree as the surface area model does: between pairs of uniform points on the sphere around
/// `box`, which makes lines uniform; nothing ends them. The same for the same arguments.
std::vector<Segment> uniform_lines(const Box& box, std::uint32_t count, std::uint64_t seed = 1);

}  // namespace boxwood
