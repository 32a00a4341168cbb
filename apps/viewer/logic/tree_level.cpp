#include "logic/tree_level.h"

#include <algorithm>

namespace boxwood::viewer {
namespace {

std::vector<std::uint32_t> depths_of(const Tree& tree) {
  std::vector<std::uint32_t> depths(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    for (std::uint32_t c = 0; c < node.count && !node.is_leaf(); ++c) depths[node.first + c] = depths[i] + 1;
  }
  return depths;
}

/// Surface times tests, of every node with all below it. Every node stands after its parent.
std::vector<double> costs_of(const Tree& tree) {
  std::vector<double> costs(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    costs[i] = double{half_area(node.bounds)} * (node.is_leaf() ? node.count : 1);
    for (std::uint32_t c = 0; c < node.count && !node.is_leaf(); ++c) costs[i] += costs[node.first + c];
  }
  return costs;
}

}  // namespace

std::uint32_t height_of(const Tree& tree) {
  const std::vector<std::uint32_t> depths = depths_of(tree);
  return depths.empty() ? 0 : *std::ranges::max_element(depths);
}

std::vector<LevelBox> boxes_of_level(const Tree& tree, std::uint32_t level, std::size_t most) {
  const std::vector<std::uint32_t> depths = depths_of(tree);
  const std::vector<double> costs = costs_of(tree);
  std::vector<LevelBox> out;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (depths[i] == level || (node.is_leaf() && depths[i] < level)) {
      out.push_back({node.bounds, i, node.is_leaf(), static_cast<float>(costs[i])});
    }
  }
  std::ranges::stable_sort(out,
                           [](const LevelBox& a, const LevelBox& b) { return half_area(a.box) > half_area(b.box); });
  if (out.size() > most) out.resize(most);
  float highest = 0;
  for (const LevelBox& box : out) highest = std::max(highest, box.heat);
  for (LevelBox& box : out) box.heat = highest > 0 ? box.heat / highest : 0;
  return out;
}

}  // namespace boxwood::viewer
