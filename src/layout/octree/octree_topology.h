#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// A node of an octree with all eight children of every inner node, empty leaves included, which a Tree leaves out:
/// `code` is its cell, `node` the tree's node in it or below it, or none.
struct OctreeItem {
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::uint32_t node = none;
  OctreeCode code = octree_root;

  bool empty() const { return node == none; }
};

/// Reads the full octree out of a tree's cells. Refers to the tree.
class OctreeTopology {
 public:
  /// Throws UsageError when the tree has nodes but no cells.
  explicit OctreeTopology(const Tree& tree);

  OctreeItem root() const { return {tree_.empty() ? OctreeItem::none : 0, octree_root}; }
  bool is_inner(const OctreeItem& item) const {
    return !item.empty() && (tree_.cells.codes[item.node] != item.code || !tree_.nodes[item.node].is_leaf());
  }
  /// Of an inner node, in octant order.
  void children(const OctreeItem& item, OctreeItem (&out)[8]) const;
  const Tree::Node& leaf(const OctreeItem& item) const { return tree_.nodes[item.node]; }

 private:
  const Tree& tree_;
};

/// Primitives at the leaves of an octree, each kept once however many leaves refer to it.
struct OctreeReferences {
  std::vector<std::uint32_t> references;  ///< leaf by leaf; numbers in `primitives`, not in the mesh
  std::vector<std::uint32_t> primitives;  ///< in the order in which leaves first need them

  /// Appends a leaf's references.
  void append(std::span<const std::uint32_t> leaf);

 private:
  std::vector<std::uint32_t> place_of_;  ///< [primitive] = place + 1, 0: not yet
};

}  // namespace boxwood
