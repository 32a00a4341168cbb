#include "tree/parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "tree/statistics.h"

namespace boxwood {
namespace {

/// Appends all that is below a node to `order`, level by level.
void append_subtree(const Tree& tree, std::uint32_t root, std::vector<std::uint32_t>& order) {
  std::size_t next = order.size();
  order.push_back(root);
  for (; next < order.size(); ++next) {
    const Tree::Node& node = tree.nodes[order[next]];
    if (node.is_leaf()) continue;
    for (std::uint32_t c = 0; c < node.count; ++c) order.push_back(node.first + c);
  }
}

}  // namespace

double node_cost(const Tree::Node& node) { return box_area(node.bounds) * (node.is_leaf() ? node.count : 1); }

TreeParts cut_tree(const Tree& tree, const IsPart& is_part) {
  TreeParts out;
  if (tree.empty()) return out;
  // Children follow their parents, so going backwards meets them first.
  std::vector<std::uint32_t> references(tree.nodes.size()), first(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      references[i] = node.count;
      first[i] = tree.references[node.first];
      continue;
    }
    first[i] = first[node.first];
    for (std::uint32_t c = 0; c < node.count; ++c) references[i] += references[node.first + c];
  }
  std::vector<std::uint32_t> roots;
  out.order.reserve(tree.nodes.size());
  std::vector<std::uint32_t> open{0};
  for (std::size_t next = 0; next < open.size(); ++next) {
    const std::uint32_t i = open[next];
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf() || is_part(references[i], first[i])) {
      roots.push_back(i);
      continue;
    }
    out.order.push_back(i);
    for (std::uint32_t c = 0; c < node.count; ++c) open.push_back(node.first + c);
  }
  out.above = static_cast<std::uint32_t>(out.order.size());
  for (const std::uint32_t root : roots) {
    TreeParts::Part part{root, static_cast<std::uint32_t>(out.order.size()), 0, references[root]};
    append_subtree(tree, root, out.order);
    part.end = static_cast<std::uint32_t>(out.order.size());
    out.parts.push_back(part);
  }
  return out;
}

PartCosts refit(Tree& tree, const TreeParts& parts,
                const std::function<void(std::span<const std::uint32_t> primitives, Box& box)>& grow) {
  const auto fit = [&](std::uint32_t begin, std::uint32_t end) {
    double cost = 0;
    for (std::uint32_t i = end; i-- > begin;) {
      Tree::Node& node = tree.nodes[parts.order[i]];
      Box box;
      if (node.is_leaf()) {
        grow({tree.references.data() + node.first, node.count}, box);
      } else {
        for (std::uint32_t c = 0; c < node.count; ++c) box.grow(tree.nodes[node.first + c].bounds);
      }
      node.bounds = box;
      cost += node_cost(node);
    }
    return cost;
  };
  PartCosts costs(parts.parts.size() + 1);
  tbb::parallel_for(std::size_t{0}, parts.parts.size(),
                    [&](std::size_t p) { costs[p] = fit(parts.parts[p].begin, parts.parts[p].end); });
  costs.back() = fit(0, parts.above);
  return costs;
}

PartCosts part_costs(const Tree& tree, const TreeParts& parts) {
  const auto cost = [&](std::uint32_t begin, std::uint32_t end) {
    double sum = 0;
    for (std::uint32_t i = end; i-- > begin;) sum += node_cost(tree.nodes[parts.order[i]]);
    return sum;
  };
  PartCosts costs(parts.parts.size() + 1);
  tbb::parallel_for(std::size_t{0}, parts.parts.size(),
                    [&](std::size_t p) { costs[p] = cost(parts.parts[p].begin, parts.parts[p].end); });
  costs.back() = cost(0, parts.above);
  return costs;
}

}  // namespace boxwood
