#pragma once
#include <cstdint>
#include <vector>

#include "refine/reinsert/link_tree.h"
#include "tree/tree.h"

namespace boxwood {

inline constexpr std::uint32_t max_collapse_width = 16;

/// What the collapse minimises: one visit of an inner node costs as much as one block of references tested in a leaf.
struct CollapseOptions {
  std::uint32_t k = 8;      ///< most children of a node, 2…max_collapse_width
  std::uint32_t leaf = 4;   ///< most references in a leaf that is made by merging
  std::uint32_t block = 4;  ///< references tested at the price of one
};

/// For every subtree of a binary tree: the least cost at which it can be written as up to i nodes that hang side by
/// side. Wald, Benthin and Boulos 2008; Ylitie, Karras and Laine 2017, section 3. O(n k^2) time, 4 k bytes per inner
/// node.
class CollapseCosts {
 public:
  CollapseCosts(const Tree& tree, const LinkTree& links, const CollapseOptions& options);

  /// Least cost of what hangs at `edge` as at most `count` >= 1 nodes. Area times visits and blocks.
  float cost(Edge edge, std::uint32_t count) const;
  std::uint32_t references(Child child) const;
  /// Of a subtree that is one node: whether it is cheapest, and allowed, as a leaf.
  bool is_leaf(Edge edge) const { return is_leaf(links_.child(edge), links_.bounds(edge)); }
  /// The same of the whole tree.
  bool is_root_leaf() const { return is_leaf({0}, links_.root_bounds); }
  /// How many of `count` nodes, at least two, the first child of `inner` should get.
  std::uint32_t share_of_first(std::uint32_t inner, std::uint32_t count) const;

 private:
  bool is_leaf(Child child, const Box& bounds) const;
  float leaf_cost(const Box& bounds, std::uint32_t references) const;
  float inner_cost(std::uint32_t inner, const Box& bounds) const;
  void solve(std::uint32_t inner, const Box& bounds);

  const Tree& tree_;
  const LinkTree& links_;
  CollapseOptions options_;
  std::vector<float> costs_;  ///< of inner node i, `stride_` of them: as one node, as up to two, …
  std::uint32_t stride_;
  std::vector<std::uint32_t> references_;  ///< below each inner node
};

}  // namespace boxwood
