#include "tree/any_hit_order.h"

#include <algorithm>
#include <vector>

namespace boxwood {
namespace {

constexpr float leaf_blocks = 0.25f;

/// Of the any-hit rays that meet a node's box: the chance to be blocked inside, and the nodes and leaves they visit.
struct Prospect {
  float blocked = leaf_blocks, cost = 1;

  float worth() const { return blocked / cost; }
};

struct Child {
  Tree::Node node;
  Prospect prospect;
};

/// Of a node whose children are visited from the last to the first.
Prospect prospect_of(const Tree::Node& node, const std::vector<Child>& children) {
  const float area = half_area(node.bounds);
  float open = 1, cost = 1;
  for (std::size_t c = children.size(); c-- > 0;) {
    const float met = area > 0 ? std::min(half_area(children[c].node.bounds) / area, 1.0f) : 1.0f;
    cost += open * met * children[c].prospect.cost;
    open *= 1 - met * children[c].prospect.blocked;
  }
  return {1 - open, cost};
}

}  // namespace

void order_for_any_hits(Tree& tree) {
  std::vector<Prospect> prospects(tree.nodes.size());
  std::vector<Child> children;
  tree.cells = {};                                     // of the nodes as they were
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children come after their parents
    Tree::Node& node = tree.nodes[n];
    if (node.is_leaf()) continue;
    children.resize(node.count);
    for (std::uint32_t c = 0; c < node.count; ++c)
      children[c] = {tree.nodes[node.first + c], prospects[node.first + c]};
    if (node.fixed_order == 0) {
      std::ranges::stable_sort(children, {}, [](const Child& child) { return child.prospect.worth(); });
      for (std::uint32_t c = 0; c < node.count; ++c) tree.nodes[node.first + c] = children[c].node;
      node.axis = Tree::mixed_axis;
    }
    prospects[n] = prospect_of(node, children);
  }
}

}  // namespace boxwood
