#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "refine/optimal_collapse/collapse_costs.h"
#include "tree/tree.h"

namespace boxwood {

/// A node of the collapsed tree: a node of the binary tree, or a leaf of what two of its leaves hold.
struct CollapsedNode {
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t node = 0;
  std::uint32_t joined = nothing;  ///< the second leaf, if there is one
};

/// Chooses what hangs below a node of the collapsed tree. One per thread.
class ChildChooser {
 public:
  ChildChooser(const Tree& tree, const CollapseCosts& costs, const OptimalCollapseOptions& options)
      : tree_(tree), costs_(costs), options_(options) {}

  /// The at most k children of `node` at the least cost; then, with options.pack, leaves are joined and nodes opened in
  /// the place that this makes, as long as the cost does not grow. In ascending order along the axis on which their
  /// centres lie furthest apart, which is returned.
  std::uint32_t choose(std::uint32_t node, std::vector<CollapsedNode>& children);

 private:
  struct Candidate {
    CollapsedNode item;
    Box bounds;
    std::uint32_t references;  ///< of a leaf; 0 for an inner node
  };
  void choose_least(std::uint32_t node, std::uint32_t count);
  void choose_below(std::uint32_t node, std::uint32_t count);
  void append(std::uint32_t node);
  bool join_leaves();
  bool open_node();

  const Tree& tree_;
  const CollapseCosts& costs_;
  OptimalCollapseOptions options_;
  std::vector<Candidate> chosen_;
};

}  // namespace boxwood
