#pragma once
#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// A part of a tree for one task: an inner node near the root alone, or one further down with all that is below it.
struct TreePiece {
  std::uint32_t node = 0;
  bool whole = false;        ///< with all that is below it
  std::uint32_t parent = 0;  ///< the piece that is the node's parent
  std::uint32_t rank = 0;    ///< which of the parent's inner children it is
  std::uint32_t open = 1;    ///< entries that a depth-first walk's stack can have when it comes here
};

/// Cuts the inner nodes of a tree into pieces, depth first. Where depends on the tree alone. Empty for a tree without
/// inner nodes.
std::vector<TreePiece> cut_into_pieces(const Tree& tree);

/// Visits the inner nodes of a piece, depth first. visit(node, carried, push) calls push(child, carried) for the inner
/// children, the last one first.
template <class Carried, class Visit>
void walk_piece(const Tree& tree, const TreePiece& piece, Carried carried, Visit&& visit) {
  struct Pending {
    std::uint32_t node;
    Carried carried;
  };
  std::vector<Pending> pending{{piece.node, carried}};
  while (!pending.empty()) {
    const Pending at = pending.back();
    pending.pop_back();
    visit(tree.nodes[at.node], at.carried, [&](std::uint32_t child, Carried below) {
      if (piece.whole) pending.push_back({child, below});
    });
  }
}

/// What kernels must bring along to trace a tree.
struct WalkNeeds {
  std::uint32_t stack = 1;   ///< most entries of a depth-first walk's stack
  std::uint32_t widest = 0;  ///< most children of a node
  bool fixed_order = false;  ///< some node's children are to be visited as stored

  /// Looks at an inner node. Returns how many entries the stack can have when a walk comes to a child.
  std::uint32_t enter(const Tree::Node& node, std::uint32_t open);
  WalkNeeds& operator+=(const WalkNeeds& other);
};

/// Parallel, O(nodes).
WalkNeeds needs_of(const Tree& tree);

}  // namespace boxwood
