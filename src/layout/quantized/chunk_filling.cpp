#include "layout/quantized/chunk_filling.h"

#include <algorithm>
#include <deque>
#include <queue>
#include <utility>

namespace boxwood {
namespace {

std::vector<std::uint8_t> fill_by_visits(const Tree& tree, std::uint32_t groups) {
  std::vector<std::uint8_t> begins(tree.nodes.size(), 0);
  using Candidate = std::pair<float, std::uint32_t>;  // surface, node
  std::deque<std::uint32_t> roots{0};
  for (; !roots.empty(); roots.pop_front()) {
    std::priority_queue<Candidate> candidates;
    const auto open = [&](std::uint32_t node) {
      for (std::uint32_t c = tree.nodes[node].first; c < tree.nodes[node].first + tree.nodes[node].count; ++c) {
        if (!tree.nodes[c].is_leaf()) candidates.emplace(half_area(tree.nodes[c].bounds), c);
      }
    };
    open(roots.front());
    for (std::uint32_t taken = 1; taken < groups && !candidates.empty(); ++taken) {
      const std::uint32_t node = candidates.top().second;
      candidates.pop();
      open(node);
    }
    for (; !candidates.empty(); candidates.pop()) {
      begins[candidates.top().second] = 1;
      roots.push_back(candidates.top().second);
    }
  }
  return begins;
}

std::vector<std::uint8_t> fill_as_full_as_can_be(const Tree& tree, std::uint32_t groups) {
  std::vector<std::uint8_t> begins(tree.nodes.size(), 0);
  std::vector<std::uint32_t> sizes(tree.nodes.size(), 0);  // inner nodes that stay joined to each
  std::vector<std::uint32_t> parts;
  // Children follow their parents in the array.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    parts.clear();
    sizes[i] = 1;
    for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
      if (tree.nodes[c].is_leaf()) continue;
      parts.push_back(c);
      sizes[i] += sizes[c];
    }
    std::ranges::stable_sort(parts, {}, [&](std::uint32_t c) { return sizes[c]; });
    for (; sizes[i] > groups; parts.pop_back()) {
      begins[parts.back()] = 1;
      sizes[i] -= sizes[parts.back()];
    }
  }
  return begins;
}

}  // namespace

std::vector<std::uint8_t> chunk_beginnings(const Tree& tree, std::uint32_t groups, QuantizedFill fill) {
  if (tree.empty() || tree.nodes[0].is_leaf()) return std::vector<std::uint8_t>(tree.nodes.size(), 0);
  return fill == QuantizedFill::visits ? fill_by_visits(tree, groups) : fill_as_full_as_can_be(tree, groups);
}

}  // namespace boxwood
