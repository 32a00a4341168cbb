#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/box.h"
#include "math/large_memory.h"
#include "tree/octree_cells.h"

namespace boxwood {

/// The waist of the hourglass: what every builder makes, every refinement rewrites and every layout encodes. Any arity
/// (children are contiguous), any splitting scheme (references may repeat), any leaf size.
///
/// Invariants, checked by validate():
///  * no nodes at all when there are no references; else node 0 is the root and every other node has one parent;
///  * an inner node has `count` >= 2 children at nodes[first … first + count), each after its parent in the array;
///  * a leaf holds `count` >= 1 entries references[first … first + count); every reference belongs to one leaf;
///  * a child's box lies inside its parent's; a leaf's box holds its primitives' boxes, or, when `clipped_leaves` is
///    set (spatial splits, octrees), all leaves of a primitive together hold the parts of it that lie in the scene;
///  * `cells` is empty, or has the cell of every node: a child's lies in an octant of its parent's, siblings' in
///    different ones, and a node's box lies inside its cell.
struct Tree {
  struct Node {
    Box bounds;
    std::uint32_t first = 0;       ///< first child, or first reference of a leaf
    std::uint32_t count : 27 = 0;  ///< children, or references of a leaf
    std::uint32_t leaf : 1 = 0;
    std::uint32_t axis : 2 = mixed_axis;  ///< children ascend along this axis (0…2); mixed_axis: no such order
    std::uint32_t fixed_order : 1 = 0;    ///< children are to be visited as stored, whatever the ray's direction
    std::uint32_t unused : 1 = 0;

    bool is_leaf() const { return leaf != 0; }
  };
  static constexpr std::uint32_t mixed_axis = 3;
  static constexpr std::uint32_t max_count = (1u << 27) - 1;

  /// Large ones come from blocks that stages hand on to each other.
  using Nodes = LargeVector<Node>;
  using References = LargeVector<std::uint32_t>;
  Nodes nodes;
  References references;  ///< primitive numbers, leaf by leaf
  bool clipped_leaves = false;
  OctreeCells cells;  ///< only of trees that divide space into octants

  bool empty() const { return nodes.empty(); }
  std::size_t bytes() const {
    return nodes.capacity() * sizeof(Node) + references.capacity() * sizeof(std::uint32_t) +
           cells.codes.capacity() * sizeof(OctreeCode);
  }
};
static_assert(sizeof(Tree::Node) == 32, "two nodes per cache line");

}  // namespace boxwood
