#include <algorithm>

#include "refine/order/rules.h"
#include "tree/ray_cost.h"

namespace boxwood {
namespace {

/// Shares of the rays through a node that meet its children.
struct Shares {
  double left = 0, right = 0, both = 0;
  double neither() const { return std::max(0.0, 1 - (left + right - both)); }
};

Shares shares_of(const Box& parent, const Box& left, const Box& right, std::uint32_t lines) {
  const double area = half_area(parent);
  Shares shares{1, 1, 1};
  if (!(area > 0)) return shares;
  shares.left = half_area(left) / area;
  shares.right = half_area(right) / area;
  shares.both = std::max(0.0, shares.left + shares.right - 1);
  if (lines == 0) return shares;
  // Lines through the sphere around the parent; of those that meet it, how many meet both.
  double entering = 0, both = 0;
  for (const Segment& line : uniform_lines(parent, lines)) {
    if (!line.meets(parent)) continue;
    ++entering;
    if (line.meets(left) && line.meets(right)) ++both;
  }
  if (entering > 0) shares.both = std::clamp(both / entering, shares.both, std::min(shares.left, shares.right));
  return shares;
}

}  // namespace

Orders order_by_rtsah(const Tree& tree, double traversal_cost, std::uint32_t lines) {
  Orders orders(tree.nodes.size(), ChildOrderChoice::as_it_is);
  std::vector<double> costs(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parents
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      costs[i] = node.count;
      continue;
    }
    const double left = costs[node.first], right = costs[node.first + 1];
    const Shares p = shares_of(node.bounds, tree.nodes[node.first].bounds, tree.nodes[node.first + 1].bounds, lines);
    // A ray that meets the first child is taken to end there; one that misses it pays for the second.
    const double only_left = p.left - p.both, only_right = p.right - p.both, nothing = p.neither() * traversal_cost;
    const double left_first = traversal_cost + p.left * left + only_right * (traversal_cost + right) + nothing;
    const double right_first = traversal_cost + p.right * right + only_left * (traversal_cost + left) + nothing;
    costs[i] = std::min(left_first, right_first);
    orders[i] = left_first <= right_first ? ChildOrderChoice::as_stored : ChildOrderChoice::swapped;
  }
  return orders;
}

}  // namespace boxwood
