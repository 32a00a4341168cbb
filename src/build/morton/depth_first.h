#pragma once
#include <span>

#include "build/build_input.h"
#include "build/morton/clustering.h"
#include "build/morton/morton_order.h"
#include "tree/tree.h"

namespace boxwood {

/// Writes a cluster tree out: nodes depth first with siblings side by side, references leaf by leaf. Parallel; every
/// place follows from the sizes of the subtrees, so it does not depend on the threads. O(n).
Tree write_depth_first(const ClusterTree& clusters, std::span<const Reference> references, const MortonOrder& order);

}  // namespace boxwood
