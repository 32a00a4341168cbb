#include "refine/optimal_collapse/collapse_costs.h"

#include <algorithm>

namespace boxwood {

CollapseCosts::CollapseCosts(const Tree& tree, const LinkTree& links, const CollapseOptions& options)
    : tree_(tree),
      links_(links),
      options_(options),
      costs_(links.inner.size() * (options.k - 1)),
      stride_(options.k - 1),
      references_(links.inner.size()) {
  // Children before parents: the reverse of any order that visits parents first.
  struct Visit {
    std::uint32_t inner;
    Edge edge;
  };
  std::vector<Visit> order{{0, LinkTree::no_edge}};
  order.reserve(links.inner.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (Edge edge = order[i].inner * 2; edge < order[i].inner * 2 + 2; ++edge) {
      if (!links.child(edge).is_leaf()) order.push_back({links.child(edge).number(), edge});
    }
  }
  for (std::size_t i = order.size(); i-- > 0;) {
    const auto [inner, edge] = order[i];
    solve(inner, edge == LinkTree::no_edge ? links.root_bounds : links.bounds(edge));
  }
}

float CollapseCosts::cost(Edge edge, std::uint32_t count) const {
  const Child child = links_.child(edge);
  if (child.is_leaf()) return leaf_cost(links_.bounds(edge), references(child));
  return costs_[std::size_t{child.number()} * stride_ + std::min(count, stride_) - 1];
}

std::uint32_t CollapseCosts::references(Child child) const {
  return child.is_leaf() ? tree_.nodes[child.number()].count : references_[child.number()];
}

bool CollapseCosts::is_leaf(Child child, const Box& bounds) const {
  if (child.is_leaf()) return true;
  const std::uint32_t count = references(child);
  return count <= options_.leaf && leaf_cost(bounds, count) <= inner_cost(child.number(), bounds);
}

std::uint32_t CollapseCosts::share_of_first(std::uint32_t inner, std::uint32_t count) const {
  std::uint32_t best = 1;
  float least = 0;
  for (std::uint32_t first = 1; first < count; ++first) {
    const float both = cost(inner * 2, first) + cost(inner * 2 + 1, count - first);
    if (first == 1 || both < least) {
      least = both;
      best = first;
    }
  }
  return best;
}

float CollapseCosts::leaf_cost(const Box& bounds, std::uint32_t references) const {
  return half_area(bounds) * static_cast<float>((references + options_.block - 1) / options_.block);
}

float CollapseCosts::inner_cost(std::uint32_t inner, const Box& bounds) const {
  const std::uint32_t first = share_of_first(inner, options_.k);
  return half_area(bounds) + cost(inner * 2, first) + cost(inner * 2 + 1, options_.k - first);
}

void CollapseCosts::solve(std::uint32_t inner, const Box& bounds) {
  const std::uint32_t count = references(links_.child(inner * 2)) + references(links_.child(inner * 2 + 1));
  references_[inner] = count;
  float* costs = &costs_[std::size_t{inner} * stride_];
  costs[0] = inner_cost(inner, bounds);
  if (count <= options_.leaf) costs[0] = std::min(costs[0], leaf_cost(bounds, count));
  for (std::uint32_t nodes = 2; nodes <= stride_; ++nodes) {
    const std::uint32_t first = share_of_first(inner, nodes);
    costs[nodes - 1] = std::min(costs[nodes - 2], cost(inner * 2, first) + cost(inner * 2 + 1, nodes - first));
  }
}

}  // namespace boxwood
