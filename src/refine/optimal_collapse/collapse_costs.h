#pragma once
#include <cstdint>

#include "math/large_memory.h"
#include "tree/tree.h"

namespace boxwood {

inline constexpr std::uint32_t max_collapse_width = 16;

/// What the collapse minimises: one visit of an inner node costs as much as one block of references tested in a leaf.
struct OptimalCollapseOptions {
  std::uint32_t k = 8;      ///< most children of a node, 2…max_collapse_width
  std::uint32_t leaf = 4;   ///< most references in a leaf that is made by merging
  std::uint32_t block = 4;  ///< references tested at the price of one
  bool pack = true;         ///< join leaves of one node where that costs nothing

  std::uint32_t blocks(std::uint32_t references) const { return (references + block - 1) / block; }
};

/// For every subtree of a binary tree: the least cost at which it can be written as up to i nodes that hang side by
/// side. Wald, Benthin and Boulos 2008; Ylitie, Karras and Laine 2017, section 3. O(n k^2) time, parallel; 36 bytes per
/// node, 68 for k above 8.
class CollapseCosts {
 public:
  CollapseCosts(const Tree& tree, const OptimalCollapseOptions& options);

  /// Least cost of a node's subtree as at most `count` in 1…k - 1 nodes. Area times visits and blocks.
  float cost(std::uint32_t node, std::uint32_t count) const { return costs_of(node)[count - 1]; }
  std::uint32_t references(std::uint32_t node) const { return references_[node]; }
  /// Of a subtree that is one node: whether it is cheapest, and allowed, as a leaf.
  bool is_leaf(std::uint32_t node) const;
  /// How many of `count` nodes, at least two, the first child of a node should get.
  std::uint32_t share_of_first(std::uint32_t node, std::uint32_t count) const;

 private:
  template <std::uint32_t Width>
  void solve_all();
  template <std::uint32_t Width>
  void solve(std::uint32_t node);
  template <std::uint32_t Width>
  void solve_below(std::uint32_t root);
  const float* costs_of(std::uint32_t node) const { return &costs_[std::size_t{node} * stride_]; }
  float leaf_cost(const Box& bounds, std::uint32_t references) const;

  const Tree& tree_;
  OptimalCollapseOptions options_;
  std::uint32_t stride_;
  /// Of each node `stride_` of them: as one node, as up to two, …, as up to k - 1; then, where k would follow, what its
  /// children cost when they are at most k.
  RawArray<float> costs_;
  RawArray<std::uint32_t> references_;  ///< below each node
};

}  // namespace boxwood
