#pragma once
#include <cstddef>
#include <cstdint>

#include "boxwood/box.h"
#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/link.h"
#include "layout/slab/leaf_ends.h"
#include "layout/slab/split_word.h"
#include "layout/trace_options.h"

namespace boxwood {

/// Single slab node, 8 bytes (12 with a 64-bit word):
///   0  plane   one side of the node's box: the one that cuts most from the region its parent guarantees
///   4  word    index, which side the plane is, split axis, leaf
template <class Word>
struct SlabNode {
  float plane = 0;
  Word word;
};
static_assert(sizeof(SlabNode<Word32>) == 8);
static_assert(sizeof(SlabNode<Word64>) == 12);

/// Its twin, the study's bounding volume node, 28 bytes (32 with a 64-bit word):
///    0  bounds  the whole box
///   24  word    as above; the side is always 0
template <class Word>
struct BoxNode {
  Box bounds;
  Word word;
};
static_assert(sizeof(BoxNode<Word32>) == 28);
static_assert(sizeof(BoxNode<Word64>) == 32);

/// The nodes of a binary tree in pairs of siblings, depth first. All 2n - 1 nodes of a tree with n leaves are stored,
/// the root apart, so that pairs start on even places.
template <class NodeType>
struct SplitNodes {
  using Node = NodeType;
  Box root_box;
  Node root;
  AlignedVector<Node> pairs;  ///< pair i is pairs[2 i] and pairs[2 i + 1]
  LeafEnds leaf_ends;
  std::uint32_t stack_need = 0;  ///< entries that a walk may have to remember

  bool empty() const { return root_box.empty(); }
  std::size_t node_count() const { return empty() ? 0 : pairs.size() + 1; }
  std::size_t bytes() const { return node_count() * sizeof(Node) + leaf_ends.bytes(); }

  Link link_of(const Node& node) const {
    const SplitFlags flags = node.word.flags();
    Link link;
    link.first = node.word.index();
    link.leaf = flags.is_leaf();
    link.fixed_order = flags.fixed_order();
    link.axis = flags.axis() & 3;
    link.count = (flags.is_leaf() ? leaf_ends.count_from(link.first) : 2u) & Tree::max_count;
    return link;
  }
};

using SlabNodes32 = SplitNodes<SlabNode<Word32>>;
using SlabNodes64 = SplitNodes<SlabNode<Word64>>;
using BoxNodes32 = SplitNodes<BoxNode<Word32>>;
using BoxNodes64 = SplitNodes<BoxNode<Word64>>;

/// Deeper trees are walked ray by ray: what a packet remembers is too long to be kept in thousands.
inline constexpr std::uint32_t most_packet_entries = 512;

/// The kernels for rays one at a time and, in batches over triangles, for packets of `packet` rays (1, 4, 8 or 16).
template <class Nodes>
Kernels<Nodes, TriangleLeaves> split_triangle_kernels(const TraceOptions& options, std::uint32_t packet);
template <class Nodes>
Kernels<Nodes, InstanceLeaves> split_instance_kernels(const TraceOptions& options);

}  // namespace boxwood
