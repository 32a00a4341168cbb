#pragma once
#include <cstdint>

#include "boxwood/box.h"
#include "math/large_memory.h"
#include "tree/tree.h"

namespace boxwood {

/// A place for a node below its parent: 2 * inner node + side. Everything but the root has one.
using Edge = std::uint32_t;

/// What hangs at an edge: an inner node of the LinkTree, or a leaf of the tree it was made from.
struct Child {
  static constexpr std::uint32_t leaf_bit = 1u << 31;
  std::uint32_t bits = 0;

  bool is_leaf() const { return (bits & leaf_bit) != 0; }
  std::uint32_t number() const { return bits & ~leaf_bit; }
  friend bool operator==(Child, Child) = default;
};

/// A binary tree whose subtrees can be moved in O(depth): links instead of contiguous children, and the boxes of both
/// children in their parent, so that a search reads one cache line per inner node.
struct LinkTree {
  struct alignas(64) Inner {
    Box bounds[2];
    Child children[2];
    Edge up = 0;  ///< where this node hangs; of the root, `no_edge`
  };
  static_assert(sizeof(Inner) == 64);
  static constexpr Edge no_edge = ~0u;

  LargeVector<Inner> inner;  ///< the root first
  Box root_bounds;

  Inner& parent(Edge edge) { return inner[edge >> 1]; }
  const Inner& parent(Edge edge) const { return inner[edge >> 1]; }
  const Box& bounds(Edge edge) const { return parent(edge).bounds[edge & 1]; }
  Child child(Edge edge) const { return parent(edge).children[edge & 1]; }
  static Edge sibling(Edge edge) { return edge ^ 1; }
};

/// Whether every inner node has two children.
bool is_binary(const Tree& tree);

/// Takes a tree of at least two leaves apart. Of a node with more than two children it makes a small binary tree,
/// halving them in the order in which they are stored. O(n).
LinkTree link(const Tree& tree);

/// Puts the leaves of `tree` together again as `links` say: depth first, siblings side by side and in the order of the
/// axis that separates them. O(n).
Tree relink(const LinkTree& links, const Tree& tree);

}  // namespace boxwood
