#pragma once
#include "tree/tree.h"

namespace boxwood {

/// The sum, over all inner nodes, of what their split cost when it was made: 1 plus, for each child, its references
/// times its area over the node's. Not weighted by how likely a ray gets there, so it grows like n log n; the PCA study
/// counts so (its section 3.1). A node without area counts every probability as 1. In double; O(nodes).
double split_cost_sum(const Tree& tree);

}  // namespace boxwood
