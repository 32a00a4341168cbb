#pragma once
#include <cstdint>
#include <vector>

#include "layout/quantized/quantized_nodes.h"
#include "tree/tree.h"

namespace boxwood {

/// Which inner nodes begin a chunk of their own, when a chunk has room for the children of `groups` inner nodes and any
/// of them may be left out: one entry per node, the root's is 0.
///   visits   a chunk takes the node next whose surface is largest, which is the one that a ray that enters the chunk
///            enters most likely: what is visited together lies together. O(n log n).
///   packed   the fewest chunks: from the bottom up, the largest parts of a node's children are cut off until the rest
///            fits. Kundu, Misra 1977, "A Linear Tree Partitioning Algorithm". O(n).
std::vector<std::uint8_t> chunk_beginnings(const Tree& tree, std::uint32_t groups, QuantizedFill fill);

}  // namespace boxwood
