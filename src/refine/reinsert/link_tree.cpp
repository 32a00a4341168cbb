#include "refine/reinsert/link_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "tree/assemble.h"
#include "tree/child_axis.h"

namespace boxwood {
namespace {

/// Takes chunks of the array of nodes side by side.
class Linker {
 public:
  explicit Linker(const Tree& tree)
      : tree_(tree), number_(tree.nodes.size()), before_((tree.nodes.size() + chunk - 1) / chunk + 1) {}

  LinkTree run() {
    for_each_chunk([&](std::size_t c) { before_[c + 1] = count(c); });
    for (std::size_t c = 1; c < before_.size(); ++c) {
      before_[c].inner += before_[c - 1].inner;
      before_[c].halves += before_[c - 1].halves;
    }
    for_each_chunk([&](std::size_t c) { number(c); });
    links_.root_bounds = tree_.nodes.front().bounds;
    links_.inner.resize(before_.back().inner + before_.back().halves);
    links_.inner.front().up = LinkTree::no_edge;
    for_each_chunk([&](std::size_t c) { hang_children(c); });
    return std::move(links_);
  }

 private:
  static constexpr std::size_t chunk = std::size_t{1} << 13;
  /// Inner nodes, numbered in the order of the array, and those that replace wide nodes, which follow.
  struct Counts {
    std::uint32_t inner = 0, halves = 0;
  };

  template <class Function>
  void for_each_chunk(const Function& function) const {
    tbb::parallel_for(std::size_t{0}, before_.size() - 1, function);
  }
  std::size_t end_of(std::size_t c) const { return std::min((c + 1) * chunk, number_.size()); }

  Counts count(std::size_t c) const {
    Counts out;
    for (std::size_t i = c * chunk; i < end_of(c); ++i) {
      if (tree_.nodes[i].is_leaf()) continue;
      ++out.inner;
      out.halves += tree_.nodes[i].count - 2;
    }
    return out;
  }

  void number(std::size_t c) {
    std::uint32_t next = before_[c].inner;
    for (std::size_t i = c * chunk; i < end_of(c); ++i) number_[i] = tree_.nodes[i].is_leaf() ? 0 : next++;
  }

  void hang_children(std::size_t c) {
    std::uint32_t next = before_.back().inner + before_[c].halves;
    for (std::size_t i = c * chunk; i < end_of(c); ++i) {
      const Tree::Node& node = tree_.nodes[i];
      if (!node.is_leaf()) halve(number_[i], node.first, node.first + node.count, next);
    }
  }

  /// Hangs the nodes [first, last) below `inner`, at least two. Returns their common box. Takes numbers from `next` on.
  /// Recursion is logarithmic.
  Box halve(std::uint32_t inner, std::uint32_t first, std::uint32_t last, std::uint32_t& next) {
    const std::uint32_t middle = first + (last - first + 1) / 2;
    const Box left = hang(inner * 2, first, middle, next);
    return unite(left, hang(inner * 2 + 1, middle, last, next));
  }

  Box hang(Edge edge, std::uint32_t first, std::uint32_t last, std::uint32_t& next) {
    Child child{number_[first]};
    Box bounds = tree_.nodes[first].bounds;
    if (last - first > 1) {
      child.bits = next++;
      bounds = halve(child.bits, first, last, next);
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
  std::vector<Counts> before_;  ///< of each chunk, and of all
  LinkTree links_;
};

}  // namespace

bool is_binary(const Tree& tree) {
  using Range = tbb::blocked_range<const Tree::Node*>;
  const Tree::Node* const begin = tree.nodes.data();
  return tbb::parallel_reduce(
      Range(begin, begin + tree.nodes.size(), 1 << 13), true,
      [](const Range& range, bool binary) {
        return binary && std::all_of(range.begin(), range.end(),
                                     [](const Tree::Node& node) { return node.is_leaf() || node.count == 2; });
      },
      std::logical_and<>());
}

LinkTree link(const Tree& tree) { return Linker(tree).run(); }

Tree relink(const LinkTree& links, const Tree& tree) {
  // Of the root, which has no edge, `no_edge`.
  const auto write = [&](Edge edge, Tree::Node& node, std::vector<Edge>& children, Tree::References& references) {
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
