#include "refine/reinsert/link_tree.h"

#include <algorithm>
#include <span>
#include <utility>

#include "tree/assemble.h"
#include "tree/child_axis.h"

namespace boxwood {
namespace {

class Linker {
 public:
  explicit Linker(const Tree& tree) : tree_(tree), number_(tree.nodes.size()) {}

  LinkTree run() {
    // Inner nodes are numbered in the order of the array; those that replace wide nodes follow.
    std::uint32_t leaves = 0;
    for (std::size_t i = 0; i < number_.size(); ++i) {
      const bool leaf = tree_.nodes[i].is_leaf();
      number_[i] = leaf ? 0 : next_inner_++;
      leaves += leaf ? 1 : 0;
    }
    links_.root_bounds = tree_.nodes.front().bounds;
    links_.inner.resize(leaves - 1);
    links_.inner.front().up = LinkTree::no_edge;
    for (std::size_t i = 0; i < number_.size(); ++i) {
      const Tree::Node& node = tree_.nodes[i];
      if (!node.is_leaf()) halve(number_[i], node.first, node.first + node.count);
    }
    return std::move(links_);
  }

 private:
  /// Hangs the nodes [first, last) below `inner`, at least two. Returns their common box. Recursion is logarithmic.
  Box halve(std::uint32_t inner, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t middle = first + (last - first + 1) / 2;
    return unite(hang(inner * 2, first, middle), hang(inner * 2 + 1, middle, last));
  }

  Box hang(Edge edge, std::uint32_t first, std::uint32_t last) {
    Child child{number_[first]};
    Box bounds = tree_.nodes[first].bounds;
    if (last - first > 1) {
      child.bits = next_inner_++;
      bounds = halve(child.bits, first, last);
    } else if (tree_.nodes[first].is_leaf()) {
      child.bits = first | Child::leaf_bit;
    }
    links_.parent(edge).bounds[edge & 1] = bounds;
    links_.parent(edge).children[edge & 1] = child;
    if (!child.is_leaf()) links_.inner[child.number()].up = edge;
    return bounds;
  }

  const Tree& tree_;
  LargeVector<std::uint32_t> number_;
  std::uint32_t next_inner_ = 0;
  LinkTree links_;
};

}  // namespace

bool is_binary(const Tree& tree) {
  return std::ranges::all_of(tree.nodes, [](const Tree::Node& node) { return node.is_leaf() || node.count == 2; });
}

LinkTree link(const Tree& tree) { return Linker(tree).run(); }

Tree relink(const LinkTree& links, const Tree& tree) {
  // Of the root, which has no edge, `no_edge`.
  const auto write = [&](Edge edge, Tree::Node& node, std::vector<Edge>& children,
                         std::vector<std::uint32_t>& references) {
    const bool root = edge == LinkTree::no_edge;
    const Child child = root ? Child{0} : links.child(edge);
    if (child.is_leaf()) {
      node = tree.nodes[child.number()];
      const auto leaf = std::span(tree.references).subspan(node.first, node.count);
      node.first = static_cast<std::uint32_t>(references.size());
      for (const std::uint32_t reference : leaf) references.push_back(reference);
      return;
    }
    const LinkTree::Inner& inner = links.inner[child.number()];
    const ChildAxis axis = child_axis(inner.bounds[0], inner.bounds[1]);
    const Edge first = child.number() * 2 + (axis.descending ? 1 : 0);
    node.bounds = root ? links.root_bounds : links.bounds(edge);
    node.axis = axis.axis & 3;
    children.push_back(first);
    children.push_back(LinkTree::sibling(first));
  };
  Tree out = assemble(LinkTree::no_edge, tree.nodes.size(), tree.references.size(), [&] { return write; });
  out.clipped_leaves = tree.clipped_leaves;
  return out;
}

}  // namespace boxwood
