#pragma once
#include <string_view>

#include "layout/slab/split_nodes.h"
#include "tree/tree.h"

namespace boxwood {

/// Encodes a binary tree with one plane per node, or with whole boxes. Throws UsageError for a tree that is not binary,
/// Error when indices do not fit the word. O(nodes).
template <class Nodes>
Nodes encode_split_nodes(const Tree& tree, std::string_view layout);

extern template SlabNodes32 encode_split_nodes(const Tree&, std::string_view);
extern template SlabNodes64 encode_split_nodes(const Tree&, std::string_view);
extern template BoxNodes32 encode_split_nodes(const Tree&, std::string_view);
extern template BoxNodes64 encode_split_nodes(const Tree&, std::string_view);

/// The axis along which a binary node's children ascend; where the tree knows none, the one on which they lie farthest
/// apart, `swapped` when they descend along it.
struct AscendingAxis {
  std::uint32_t axis;
  bool swapped;
};
AscendingAxis ascending_axis(const Tree& tree, const Tree::Node& node);

}  // namespace boxwood
