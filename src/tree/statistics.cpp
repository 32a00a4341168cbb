#include "tree/statistics.h"

#include <algorithm>

namespace boxwood {
namespace {

constexpr std::size_t histogram_size = 33;  // sizes above 31 share the last entry

void count_in(std::vector<std::uint64_t>& histogram, std::size_t value) {
  const std::size_t entry = std::min(value, histogram_size - 1);
  if (histogram.size() <= entry) histogram.resize(entry + 1);
  ++histogram[entry];
}

/// Area of the pairwise intersections of `node`'s children. O(arity^2), for huge arities only neighbours in storage.
double overlap_of_children(const Tree& tree, const Tree::Node& node) {
  constexpr std::uint32_t reach = 256;
  double overlap = 0;
  for (std::uint32_t i = 0; i < node.count; ++i) {
    for (std::uint32_t j = i + 1; j < std::min<std::uint32_t>(node.count, i + reach); ++j) {
      overlap += box_area(intersect(tree.nodes[node.first + i].bounds, tree.nodes[node.first + j].bounds));
    }
  }
  return overlap;
}

std::vector<std::uint32_t> depths_of(const Tree& tree) {
  std::vector<std::uint32_t> depths(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    std::fill_n(depths.begin() + node.first, std::uint32_t{node.count}, depths[i] + 1);
  }
  return depths;
}

}  // namespace

double box_area(const Box& box) {
  if (box.empty()) return 0;
  const double x = static_cast<double>(box.upper.x) - box.lower.x;
  const double y = static_cast<double>(box.upper.y) - box.lower.y;
  const double z = static_cast<double>(box.upper.z) - box.lower.z;
  return 2 * (x * y + y * z + z * x);
}

double sah_cost(const Tree& tree, const SahConstants& constants) {
  if (tree.empty()) return 0;
  const double root_area = box_area(tree.nodes[0].bounds);
  double inner = 0, leaves = 0;
  for (const Tree::Node& node : tree.nodes) {
    const double weight = root_area > 0 ? box_area(node.bounds) : 1;
    if (node.is_leaf()) {
      leaves += weight * node.count;
    } else {
      inner += weight;
    }
  }
  return (constants.traversal * inner + constants.intersection * leaves) / (root_area > 0 ? root_area : 1);
}

double sibling_overlap(const Tree& tree) {
  double overlap = 0, parents = 0;
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) continue;
    overlap += overlap_of_children(tree, node);
    parents += box_area(node.bounds);
  }
  return parents > 0 ? overlap / parents : 0;
}

TreeStatistics statistics(const Tree& tree, const SahConstants& constants) {
  TreeStatistics result;
  result.references = tree.references.size();
  result.constants = constants;
  result.sah_cost = sah_cost(tree, constants);
  result.bytes = tree.bytes();

  const std::vector<std::uint32_t> depths = depths_of(tree);
  std::vector<double> parent_areas;
  std::uint64_t leaf_depths = 0, children = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      ++result.leaves;
      leaf_depths += depths[i];
      result.max_depth = std::max(result.max_depth, depths[i]);
      count_in(result.leaf_sizes, node.count);
      continue;
    }
    ++result.inner_nodes;
    children += node.count;
    result.max_arity = std::max<std::uint32_t>(result.max_arity, node.count);
    count_in(result.arities, node.count);
    if (result.sibling_overlap.size() <= depths[i]) {
      result.sibling_overlap.resize(depths[i] + 1);
      parent_areas.resize(depths[i] + 1);
    }
    result.sibling_overlap[depths[i]] += overlap_of_children(tree, node);
    parent_areas[depths[i]] += box_area(node.bounds);
  }
  if (result.leaves) result.mean_leaf_depth = static_cast<double>(leaf_depths) / static_cast<double>(result.leaves);
  if (result.inner_nodes) {
    result.mean_arity = static_cast<double>(children) / static_cast<double>(result.inner_nodes);
  }
  for (std::size_t d = 0; d < parent_areas.size(); ++d) {
    result.sibling_overlap[d] = parent_areas[d] > 0 ? result.sibling_overlap[d] / parent_areas[d] : 0;
  }
  return result;
}

}  // namespace boxwood
