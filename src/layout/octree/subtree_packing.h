#pragma once
#include <cstdint>
#include <unordered_set>

#include "layout/octree/octree_topology.h"

namespace boxwood {

/// Cuts an octree into the fewest subtrees of at most `groups` inner nodes each: from the bottom up, the largest parts
/// of a node's children are cut off until the rest fits. Kundu, Misra 1977, "A Linear Tree Partitioning Algorithm".
/// Returns the cells where a subtree begins, the root's excepted.
std::unordered_set<OctreeCode> pack_subtrees(const OctreeTopology& topology, std::uint32_t groups);

}  // namespace boxwood
