#pragma once
#include <cstdint>
#include <span>

#include "boxwood/box.h"
#include "build/build_input.h"
#include "build/morton/morton_order.h"
#include "build/morton/radix_sort.h"

namespace boxwood {

/// How clusters are joined and when a subtree becomes a leaf.
struct ClusteringOptions {
  std::uint32_t radius = 16;     ///< how far along the curve a cluster looks for its partner, 1…max_radius
  std::uint32_t leaf_size = 4;   ///< most references in a leaf
  std::uint32_t leaf_block = 1;  ///< references tested at the price of one
};

/// One reference (its place along the curve), or one node of the binary tree (its slot).
struct ClusterId {
  static constexpr std::uint32_t reference_bit = 1u << 31;
  std::uint32_t bits = 0;

  static ClusterId reference(std::uint32_t place) { return {place | reference_bit}; }
  bool is_reference() const { return (bits & reference_bit) != 0; }
  std::uint32_t place() const { return bits & ~reference_bit; }
};

/// A binary tree over references along a curve, before it is written out as a Tree. 40 bytes per reference.
struct ClusterTree {
  struct Node {
    Box bounds;
    ClusterId left, right;
  };
  /// Of the subtree as it will be written out: `nodes` is 1 where it becomes a leaf.
  struct Size {
    std::uint32_t references = 1, nodes = 1;
  };
  RawArray<Node> nodes;  ///< as many slots as references; not all are used
  RawArray<Size> sizes;  ///< of the same slots
  ClusterId root;

  Size size_of(ClusterId id) const { return id.is_reference() ? Size{} : sizes[id.bits]; }
};

/// Joins references bottom-up, each time with the neighbour along the curve whose common box is smallest: PLOC (Meister
/// and Bittner 2018), done hierarchically along the Morton tree as in H-PLOC (Benthin et al. 2024) so that all work
/// happens in the first-level cache. Leaves are chosen by surface area cost as the tree grows. Parallel, O(n radius);
/// the tree does not depend on the number of threads. At least one reference.
ClusterTree cluster(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options);

}  // namespace boxwood
