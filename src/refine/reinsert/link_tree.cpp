#include "refine/reinsert/link_tree.h"

#include <algorithm>

#include "boxwood/error.h"
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

}  // namespace

LinkTree link(const Tree& tree) {
  LinkTree links;
  links.root_bounds = tree.nodes.front().bounds;
  // Inner nodes are numbered in the order of the array, so parents come before children.
  std::vector<std::uint32_t> number(tree.nodes.size());
  std::uint32_t inner = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) number[i] = tree.nodes[i].is_leaf() ? 0 : inner++;
  links.inner.reserve(inner);
  prefer_huge_pages(links.inner.data(), inner * sizeof(LinkTree::Inner));
  links.inner.resize(inner);
  links.inner.front().up = LinkTree::no_edge;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    if (node.count != 2) {
      throw UsageError("'reinsert' takes binary trees only; put it before stages that make nodes wider");
    }
    LinkTree::Inner& to = links.inner[number[i]];
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t child = node.first + side;
      to.bounds[side] = tree.nodes[child].bounds;
      if (tree.nodes[child].is_leaf()) {
        to.children[side].bits = child | Child::leaf_bit;
      } else {
        to.children[side].bits = number[child];
        links.inner[number[child]].up = number[i] * 2 + side;
      }
    }
  }
  return links;
}

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
