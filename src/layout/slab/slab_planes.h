#pragma once
#include <cstddef>

#include "boxwood/box.h"
#include "layout/slab/split_word.h"
#include "tree/tree.h"

namespace boxwood {

inline float& side_of(Box& box, BoxSide side) { return (side & 1 ? box.upper : box.lower)[side >> 1]; }
inline float side_of(const Box& box, BoxSide side) { return (side & 1 ? box.upper : box.lower)[side >> 1]; }

/// Cuts `region`, which holds `box`, by the side of `box` that leaves the smallest surface, and says which that is. Of
/// equal ones the last, in the order lower x, upper x, lower y, … (spec 003, 2.3).
BoxSide cut_by_best_side(const Box& box, Box& region);

/// How well single slabs stand for the boxes of a tree.
struct SlabFit {
  /// Mean over all nodes of the surface of the region that the slabs along the path guarantee, in parts of the surface
  /// of the node's own box; at least 1. Nodes whose box has no surface are left out. 0 for an empty tree.
  double surface_ratio = 0;
  double rounding = 0;          ///< relative difference to the same computed and summed with 64 bits of mantissa
  std::size_t idle_planes = 0;  ///< planes that cut nothing from their region, the root's, which never does, aside
};
/// O(nodes).
SlabFit slab_fit(const Tree& tree);

}  // namespace boxwood
