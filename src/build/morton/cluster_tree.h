#pragma once
#include <cstdint>

#include "boxwood/box.h"
#include "build/large_leaf.h"

namespace boxwood {

/// Most children of a node.
inline constexpr std::uint32_t max_cluster_width = 16;

/// How clusters are joined and when a subtree becomes a leaf.
struct ClusteringOptions {
  std::uint32_t radius = 8;      ///< how far along the curve a cluster looks for its partner, 1…max_radius
  std::uint32_t leaf_size = 4;   ///< most references in a leaf
  std::uint32_t leaf_block = 1;  ///< references tested at the price of one
  std::uint32_t run = 1;    ///< most references next to each other on the curve that are one cluster from the start
  float slack = 1;          ///< how much dearer than apart their references may be
  std::uint32_t group = 1;  ///< most such clusters next to each other that are one node from the start
  std::uint32_t width = 2;  ///< most children of a node, 2…max_cluster_width
  LargeLeaf large_leaf;     ///< which leaves of one block are better in two
};

/// What a cluster is: a leaf or a node of leaves that was there before clustering (by the place of its first
/// reference), an inner node (by its slot), or a node whose references are cheaper tested together.
struct ClusterId {
  static constexpr std::uint32_t given_bit = 1u << 31, leaf_bit = 1u << 30;
  std::uint32_t bits = 0;

  static ClusterId inner(std::uint32_t slot) { return {slot}; }
  static ClusterId given(std::uint32_t place) { return {place | given_bit}; }
  static ClusterId group(std::uint32_t place) { return {place | given_bit | leaf_bit}; }
  static ClusterId node(std::uint32_t slot, bool leaf) { return {slot | (leaf ? leaf_bit : 0)}; }
  bool is_given() const { return (bits & given_bit) != 0; }
  bool is_group() const { return (bits & (given_bit | leaf_bit)) == (given_bit | leaf_bit); }
  bool is_inner() const { return (bits & (given_bit | leaf_bit)) == 0; }
  bool is_leaf() const { return !is_inner() && !is_group(); }
  std::uint32_t number() const { return bits & ~(given_bit | leaf_bit); }
};

/// A join of two clusters: all that is asked when it is written out, in one cache line.
struct alignas(64) ClusterNode {
  Box left_bounds, right_bounds;
  ClusterId left, right;
};
static_assert(sizeof(ClusterNode) == 64);

struct Cluster {
  Box bounds;
  ClusterId id;
  /// A cluster of m given ones owns m node slots and uses m - 1; this is the free one. Two clusters join into the left
  /// one's free slot and keep the right one's: no counter is shared, and slots follow the curve.
  std::uint32_t free_slot = 0;
  std::uint32_t leaf_references = 1;  ///< of a leaf; 0 for an inner node
  float cost = 0;                     ///< surface area cost of the subtree, times area
};

}  // namespace boxwood
