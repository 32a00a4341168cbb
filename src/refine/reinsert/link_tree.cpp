#include "refine/reinsert/link_tree.h"

#include <utility>

#include "math/huge_pages.h"
#include "tree/child_axis.h"

namespace boxwood {
namespace {

/// Appends a leaf's references to `out` and sets the leaf in `to`.
void copy_leaf(const Tree& from, const Tree::Node& leaf, Tree::Node& to, std::vector<std::uint32_t>& out) {
  to = leaf;
  to.first = static_cast<std::uint32_t>(out.size());
  const auto first = from.references.begin() + leaf.first;
  out.insert(out.end(), first, first + leaf.count);
}

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
    links_.inner.reserve(leaves - 1);
    prefer_huge_pages(links_.inner.data(), (leaves - 1) * sizeof(LinkTree::Inner));
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
  std::vector<std::uint32_t> number_;
  std::uint32_t next_inner_ = 0;
  LinkTree links_;
};

}  // namespace

LinkTree link(const Tree& tree) { return Linker(tree).run(); }

Tree relink(const LinkTree& links, const Tree& tree) {
  Tree out;
  out.clipped_leaves = tree.clipped_leaves;
  out.nodes.reserve(tree.nodes.size());
  prefer_huge_pages(out.nodes.data(), out.nodes.capacity() * sizeof(Tree::Node));
  out.references.reserve(tree.references.size());
  out.nodes.emplace_back().bounds = links.root_bounds;
  struct Pending {
    std::uint32_t inner, node;
  };
  std::vector<Pending> pending{{0, 0}};
  while (!pending.empty()) {
    const auto [inner, node] = pending.back();
    pending.pop_back();
    const LinkTree::Inner& from = links.inner[inner];
    const ChildAxis axis = child_axis(from.bounds[0], from.bounds[1]);
    const auto first = static_cast<std::uint32_t>(out.nodes.size());
    out.nodes[node].first = first;
    out.nodes[node].count = 2;
    out.nodes[node].axis = axis.axis & 3;
    for (std::uint32_t place = 0; place < 2; ++place) {
      const std::uint32_t side = axis.descending ? 1 - place : place;
      Tree::Node& to = out.nodes.emplace_back();
      to.bounds = from.bounds[side];
      const Child child = from.children[side];
      if (child.is_leaf()) {
        copy_leaf(tree, tree.nodes[child.number()], to, out.references);
      } else {
        pending.push_back({child.number(), first + place});
      }
    }
    // Two inner children: the first is to be written next.
    const std::size_t size = pending.size();
    if (size >= 2 && pending[size - 2].node == first) std::swap(pending[size - 2], pending[size - 1]);
  }
  return out;
}

}  // namespace boxwood
