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

/// What an inner node knows of one child, 32 bits. Of a leaf: bit 0 set, 31 bits of first reference. Of an inner child:
/// bits 1-2 axis, 3 fixed_order, 4-7 children - 1, 24 bits of its number among the nodes.
struct WideSlabChild {
  static constexpr std::uint64_t most_nodes = std::uint64_t{1} << 24, most_references = std::uint64_t{1} << 31;
  std::uint32_t word;

  static WideSlabChild leaf(std::uint32_t first) { return {first << 1 | 1}; }
  static WideSlabChild inner(const Tree::Node& node, std::uint32_t number) {
    return {number << 8 | (node.count - 1) << 4 | std::uint32_t{node.fixed_order} << 3 | std::uint32_t{node.axis} << 1};
  }
};

/// Inner nodes of k children, depth first; `planes` planes per child, each the side of its box that cuts most from the
/// region known so far. A node is 4 k (planes + 1) bytes: with k = 8 and one plane a single cache line.
///   0               planes[planes][k]   which side a plane is stands in its three lowest mantissa bits: it is moved
///                                       outward to the next float that has them right. Lanes without a child hold
///                                       side 6, which nothing meets.
///   4 * k * planes  children[k]         WideSlabChild
struct WideSlabNodes {
  std::uint32_t k = 0, planes = 0;
  Box root_box;
  Link root;
  AlignedVector<std::uint32_t> memory;  ///< planes are stored as their bits
  LeafEnds leaf_ends;

  bool empty() const { return root.count == 0; }
  std::size_t bytes() const { return memory.size() * sizeof(std::uint32_t) + leaf_ends.bytes(); }
  std::uint32_t stride() const { return k * (planes + 1); }

  Link link_of(WideSlabChild child) const {
    Link link;
    if (child.word & 1) {
      link.leaf = 1;
      link.first = child.word >> 1;
      link.count = leaf_ends.count_from(link.first) & Tree::max_count;
    } else {
      link.first = child.word >> 8;
      link.count = (child.word >> 4 & 15) + 1;
      link.fixed_order = child.word >> 3 & 1;
      link.axis = child.word >> 1 & 3;
    }
    return link;
  }
};

/// The nearest float that is not inside `value` as seen from within and carries `side` in its lowest three bits.
float plane_with_side(float value, BoxSide side);

/// The fastest kernels this machine can run.
Kernels<WideSlabNodes, TriangleLeaves> wide_slab_triangle_kernels(const TraceOptions& options, std::uint32_t k);
Kernels<WideSlabNodes, InstanceLeaves> wide_slab_instance_kernels(const TraceOptions& options, std::uint32_t k);

}  // namespace boxwood
