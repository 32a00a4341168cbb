#pragma once
#include <span>

#include "build/build_input.h"
#include "build/morton/cluster_tree.h"
#include "build/morton/morton_order.h"
#include "tree/tree.h"

namespace boxwood {

/// Joins references bottom-up, each time with the neighbour along the curve whose common box is smallest: PLOC (Meister
/// and Bittner 2018), done hierarchically along the Morton tree as in H-PLOC (Benthin et al. 2024) so that all work
/// happens in the cache. Leaves are chosen by surface area cost as the tree grows. Parallel, O(n radius); the tree does
/// not depend on the number of threads. The nodes near the root come first, then the rest part by part of the curve,
/// each part depth first. Fewer than 2^30 references.
Tree cluster(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options);

}  // namespace boxwood
