#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "boxwood/box.h"
#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/link.h"
#include "layout/slab/split_word.h"
#include "layout/trace_options.h"

namespace boxwood {

/// One node, 12 bytes:
///   0  planes  of an inner node: where its first child ends and where its second begins, along the split axis;
///              of a leaf: how many references it has, in the bits of the first
///   8  word    pair of children or first reference; split axis; leaf
struct BihNode {
  float planes[2] = {};
  Word32 word;
};
static_assert(sizeof(BihNode) == 12);

/// The root, then pairs of siblings, depth first: the children of pair i are nodes[2 i + 1] and nodes[2 i + 2].
struct BihNodes {
  Box root_box;
  AlignedVector<BihNode> nodes;

  bool empty() const { return nodes.empty(); }
  std::size_t bytes() const { return nodes.size() * sizeof(BihNode); }

  Link link_of(const BihNode& node) const {
    const SplitFlags flags = node.word.flags();
    Link link;
    link.first = node.word.index();
    link.leaf = flags.is_leaf();
    link.fixed_order = flags.fixed_order();
    link.axis = flags.axis() & 3;
    link.count = (flags.is_leaf() ? std::bit_cast<std::uint32_t>(node.planes[0]) : 2u) & Tree::max_count;
    return link;
  }
};

/// The fastest kernels this machine can run.
Kernels<BihNodes, TriangleLeaves> bih_triangle_kernels(const TraceOptions& options);
Kernels<BihNodes, InstanceLeaves> bih_instance_kernels(const TraceOptions& options);

}  // namespace boxwood
