#pragma once
#include "tree/tree.h"

namespace boxwood {

/// Puts the children of each node into an order in which kernels that take the last child first, and do not look at
/// distances, soon find what blocks a ray: by the chance that something in a child does, over what it costs to find
/// out. Leaves are taken to block a quarter of the rays that meet their boxes and to cost as much as a node; rays to
/// meet children by surface area. Children then ascend along no axis, and nodes have no cells; those whose order is
/// fixed are left alone. After Ize and Hansen 2011, "RTSAH Traversal Order for Occlusion Rays", whose two children are
/// any number here. O(nodes * log(arity)).
void order_for_any_hits(Tree& tree);

}  // namespace boxwood
