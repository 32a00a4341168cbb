// Makes wide nodes and larger leaves of a binary tree at the least surface area cost there is for that tree. Wald,
// Benthin and Boulos 2008, "Getting Rid of Packets"; Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal
// on GPUs Through Compressed Wide BVHs".
#include <algorithm>
#include <vector>

#include "refine/optimal_collapse/collapse_costs.h"
#include "refine/optimal_collapse/stages.h"

namespace boxwood {
namespace {

class Collapser {
 public:
  Collapser(const Tree& tree, const CollapseOptions& options)
      : tree_(tree), links_(link(tree)), costs_(tree, links_, options), k_(options.k) {}

  Tree run() {
    out_.clipped_leaves = tree_.clipped_leaves;
    out_.nodes.reserve(tree_.nodes.size());
    out_.references.reserve(tree_.references.size());
    out_.nodes.emplace_back().bounds = links_.root_bounds;
    // Pending inner nodes, the next on top; depth first.
    std::vector<Pending> pending;
    if (costs_.is_root_leaf()) {
      write_leaf(0, {0});
    } else {
      pending.push_back({0, 0});
    }
    while (!pending.empty()) {
      const auto [inner, node] = pending.back();
      pending.pop_back();
      write_inner(inner, node, pending);
    }
    return std::move(out_);
  }

 private:
  struct Pending {
    std::uint32_t inner, node;
  };

  /// Lists what hangs side by side when what is at `edge` is written as at most `count` nodes. Recursion is less than k
  /// deep.
  void choose(Edge edge, std::uint32_t count) {
    const Child child = links_.child(edge);
    while (count > 1 && costs_.cost(edge, count - 1) <= costs_.cost(edge, count)) --count;
    if (count == 1 || child.is_leaf()) {
      chosen_.push_back(edge);
    } else {
      choose_below(child.number(), count);
    }
  }

  void choose_below(std::uint32_t inner, std::uint32_t count) {
    const std::uint32_t first = costs_.share_of_first(inner, count);
    choose(inner * 2, first);
    choose(inner * 2 + 1, count - first);
  }

  void write_inner(std::uint32_t inner, std::uint32_t node, std::vector<Pending>& pending) {
    chosen_.clear();
    choose_below(inner, k_);
    const std::uint32_t axis = sort_chosen();
    const auto first = static_cast<std::uint32_t>(out_.nodes.size());
    out_.nodes[node].first = first;
    out_.nodes[node].count = static_cast<std::uint32_t>(chosen_.size()) & Tree::max_count;
    out_.nodes[node].axis = axis & 3;
    for (const Edge edge : chosen_) out_.nodes.emplace_back().bounds = links_.bounds(edge);
    for (std::size_t i = chosen_.size(); i-- > 0;) {
      const auto place = first + static_cast<std::uint32_t>(i);
      if (!costs_.is_leaf(chosen_[i])) pending.push_back({links_.child(chosen_[i]).number(), place});
    }
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const auto place = first + static_cast<std::uint32_t>(i);
      if (costs_.is_leaf(chosen_[i])) write_leaf(place, links_.child(chosen_[i]));
    }
  }

  /// Orders the chosen ones along the axis on which their centres lie furthest apart, and returns it.
  std::uint32_t sort_chosen() {
    Box centers;
    for (const Edge edge : chosen_) centers.grow(links_.bounds(edge).center());
    const auto axis = static_cast<std::size_t>(longest_axis(centers.extent()));
    std::stable_sort(chosen_.begin(), chosen_.end(),
                     [&](Edge a, Edge b) { return links_.bounds(a).center()[axis] < links_.bounds(b).center()[axis]; });
    return static_cast<std::uint32_t>(axis);
  }

  void write_leaf(std::uint32_t place, Child child) {
    Tree::Node& node = out_.nodes[place];
    node.leaf = 1;
    node.first = static_cast<std::uint32_t>(out_.references.size());
    append_references(child, node.first);
    node.count = (static_cast<std::uint32_t>(out_.references.size()) - node.first) & Tree::max_count;
  }

  /// Parts of one primitive that meet in a leaf become one. Recursion is no deeper than a leaf has references.
  void append_references(Child child, std::size_t leaf_begin) {
    if (!child.is_leaf()) {
      append_references(links_.child(child.number() * 2), leaf_begin);
      append_references(links_.child(child.number() * 2 + 1), leaf_begin);
      return;
    }
    const Tree::Node& leaf = tree_.nodes[child.number()];
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const auto begin = out_.references.begin() + static_cast<std::ptrdiff_t>(leaf_begin);
      const bool known =
          tree_.clipped_leaves && std::find(begin, out_.references.end(), tree_.references[i]) != out_.references.end();
      if (!known) out_.references.push_back(tree_.references[i]);
    }
  }

  const Tree& tree_;
  LinkTree links_;
  CollapseCosts costs_;
  std::uint32_t k_;
  std::vector<Edge> chosen_;
  Tree out_;
};

Tree optimal_collapse(const CollapseOptions& options, Tree tree) {
  if (tree.nodes.size() < 2) return tree;
  return Collapser(tree, options).run();
}

}  // namespace

Stage optimal_collapse_stage() {
  OptionsOf<CollapseOptions> options;
  options.integer("k", &CollapseOptions::k, 2, max_collapse_width, "most children per node")
      .positional()
      .integer("leaf", &CollapseOptions::leaf, 1, 64, "most references in a leaf made of smaller ones")
      .integer("block", &CollapseOptions::block, 1, 16, "references tested at the price of one node");
  return refinement_stage<CollapseOptions>("optimal-collapse", "k-wide nodes and leaves at the least cost there is",
                                           "Wald et al. 2008; Ylitie et al. 2017", options, optimal_collapse,
                                           [](const CollapseOptions& o) { return o.k; });
}

}  // namespace boxwood
