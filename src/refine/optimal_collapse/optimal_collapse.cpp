// Makes wide nodes and larger leaves of a binary tree at the least surface area cost there is for that tree. Wald,
// Benthin and Boulos 2008, "Getting Rid of Packets"; Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal
// on GPUs Through Compressed Wide BVHs".
#include <algorithm>
#include <vector>

#include "refine/optimal_collapse/chosen_children.h"
#include "refine/optimal_collapse/stages.h"
#include "refine/reinsert/link_tree.h"
#include "tree/assemble.h"

namespace boxwood {
namespace {

/// Writes one node of the collapsed tree. One per thread.
class CollapsedWriter {
 public:
  CollapsedWriter(const Tree& tree, const CollapseCosts& costs, const OptimalCollapseOptions& options)
      : tree_(tree), costs_(costs), chooser_(tree, costs, options) {}

  void operator()(const CollapsedNode& item, Tree::Node& node, std::vector<CollapsedNode>& children,
                  Tree::References& references) {
    node.bounds = tree_.nodes[item.node].bounds;
    if (!costs_.is_leaf(item.node)) {
      node.axis = chooser_.choose(item.node, children) & 3;
      return;
    }
    node.leaf = 1;
    node.first = static_cast<std::uint32_t>(references.size());
    append_references(item.node, node.first, references);
    if (item.joined != CollapsedNode::nothing) {
      node.bounds.grow(tree_.nodes[item.joined].bounds);
      append_references(item.joined, node.first, references);
    }
    node.count = (static_cast<std::uint32_t>(references.size()) - node.first) & Tree::max_count;
  }

 private:
  /// Parts of one primitive that meet in a leaf become one. Recursion is no deeper than a leaf has references.
  void append_references(std::uint32_t number, std::size_t leaf_begin, Tree::References& references) const {
    const Tree::Node& node = tree_.nodes[number];
    if (!node.is_leaf()) {
      append_references(node.first, leaf_begin, references);
      append_references(node.first + 1, leaf_begin, references);
      return;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto begin = references.begin() + static_cast<std::ptrdiff_t>(leaf_begin);
      const bool known =
          tree_.clipped_leaves && std::find(begin, references.end(), tree_.references[i]) != references.end();
      if (!known) references.push_back(tree_.references[i]);
    }
  }

  const Tree& tree_;
  const CollapseCosts& costs_;
  ChildChooser chooser_;
};

Tree optimal_collapse(const OptimalCollapseOptions& options, Tree tree) {
  if (tree.nodes.size() < 2) return tree;
  if (!is_binary(tree)) tree = relink(link(tree), tree);
  const CollapseCosts costs(tree, options);
  Tree out = assemble(CollapsedNode{0}, tree.nodes.size(), tree.references.size(),
                      [&] { return CollapsedWriter(tree, costs, options); });
  out.clipped_leaves = tree.clipped_leaves;
  return out;
}

}  // namespace

Stage optimal_collapse_stage() {
  OptionsOf<OptimalCollapseOptions> options;
  options.integer("k", &OptimalCollapseOptions::k, 2, max_collapse_width, "most children per node")
      .positional()
      .integer("leaf", &OptimalCollapseOptions::leaf, 1, 64, "most references in a leaf made of smaller ones")
      .integer("block", &OptimalCollapseOptions::block, 1, 16, "references tested at the price of one node")
      .flag("pack", &OptimalCollapseOptions::pack,
            "join leaves of one node, also distant ones, where the cost does not grow");
  return refinement_stage<OptimalCollapseOptions>(
      "optimal-collapse", "k-wide nodes and leaves at the least cost there is", "Wald et al. 2008; Ylitie et al. 2017",
      options, optimal_collapse, [](const OptimalCollapseOptions& o) { return o.k; });
}

}  // namespace boxwood
