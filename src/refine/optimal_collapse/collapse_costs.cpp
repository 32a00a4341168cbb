#include "refine/optimal_collapse/collapse_costs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "build/float4.h"

namespace boxwood {
namespace {

constexpr std::uint32_t narrow = 8;
/// Subtrees that tasks solve, about.
constexpr std::size_t jobs = 256;
/// Nodes that one of them takes at a time.
constexpr std::size_t job_nodes = 4096;

/// pairs[i]: least cost of two children as i + 2 nodes, where first[j] and second[j] are the costs of either as up to
/// j + 1; the last of pairs is arbitrary.
template <std::uint32_t Width>
std::array<float, Width> least_of_pairs(const float* first, const float* second) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr std::uint32_t most = Width - 1, registers = Width / 4;
  // The second child's costs moved up by j are what stands j places before them.
  std::array<float, 2 * Width> padded;
  padded.fill(infinity);
  std::copy_n(second, most, padded.begin() + most);
  Float4 least[registers];
  for (Float4& some : least) some = Float4{infinity, infinity, infinity, infinity};
  for (std::uint32_t j = 0; j < most; ++j) {
    for (std::uint32_t r = 0; r < registers; ++r) {
      Float4 moved;
      std::memcpy(&moved, &padded[most - j + 4 * r], sizeof(moved));
      const Float4 both = first[j] + moved;
      least[r] = min4(both, least[r]);
    }
  }
  std::array<float, Width> pairs;
  std::memcpy(pairs.data(), least, sizeof(pairs));
  return pairs;
}

}  // namespace

CollapseCosts::CollapseCosts(const Tree& tree, const OptimalCollapseOptions& options)
    : tree_(tree),
      options_(options),
      stride_(options.k <= narrow ? narrow : max_collapse_width),
      costs_(tree.nodes.size() * stride_),
      references_(tree.nodes.size()) {
  if (stride_ == narrow) {
    solve_all<narrow>();
  } else {
    solve_all<max_collapse_width>();
  }
}

bool CollapseCosts::is_leaf(std::uint32_t node) const {
  if (tree_.nodes[node].is_leaf()) return true;
  const Box& bounds = tree_.nodes[node].bounds;
  return references_[node] <= options_.leaf &&
         leaf_cost(bounds, references_[node]) <= half_area(bounds) + costs_of(node)[stride_ - 1];
}

std::uint32_t CollapseCosts::share_of_first(std::uint32_t node, std::uint32_t count) const {
  const std::uint32_t first_child = tree_.nodes[node].first;
  std::uint32_t best = 1;
  float least = std::numeric_limits<float>::infinity();
  for (std::uint32_t first = 1; first < count; ++first) {
    const float both = cost(first_child, first) + cost(first_child + 1, count - first);
    if (both < least) {
      least = both;
      best = first;
    }
  }
  return best;
}

float CollapseCosts::leaf_cost(const Box& bounds, std::uint32_t references) const {
  return half_area(bounds) * static_cast<float>(options_.blocks(references));
}

template <std::uint32_t Width>
void CollapseCosts::solve_all() {
  // The nodes near the root, level by level, until enough subtrees hang below them.
  std::vector<std::uint32_t> top, open{0};
  while (!open.empty() && open.size() < jobs) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t node : open) {
      top.push_back(node);
      if (tree_.nodes[node].is_leaf()) continue;
      next.push_back(tree_.nodes[node].first);
      next.push_back(tree_.nodes[node].first + 1);
    }
    open = std::move(next);
  }
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t j) { solve_below<Width>(open[j]); });
  for (std::size_t i = top.size(); i-- > 0;) solve<Width>(top[i]);
}

/// Children before parents: the reverse of an order that visits parents first. What a large subtree has left after
/// job_nodes of them is for other tasks: it can be most of the tree.
template <std::uint32_t Width>
void CollapseCosts::solve_below(std::uint32_t root) {
  std::vector<std::uint32_t> order, open{root};
  while (!open.empty() && order.size() < job_nodes) {
    order.push_back(open.back());
    open.pop_back();
    const Tree::Node& node = tree_.nodes[order.back()];
    if (node.is_leaf()) continue;
    open.push_back(node.first + 1);
    open.push_back(node.first);
  }
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t j) { solve_below<Width>(open[j]); });
  for (std::size_t i = order.size(); i-- > 0;) solve<Width>(order[i]);
}

template <std::uint32_t Width>
void CollapseCosts::solve(std::uint32_t number) {
  const Tree::Node& node = tree_.nodes[number];
  float* costs = &costs_[std::size_t{number} * Width];
  if (node.is_leaf()) {
    references_[number] = node.count;
    std::fill_n(costs, Width, leaf_cost(node.bounds, node.count));
    return;
  }
  const std::uint32_t references = references_[node.first] + references_[node.first + 1];
  references_[number] = references;
  const float* first = costs_of(node.first);
  const float* second = costs_of(node.first + 1);
  const std::array<float, Width> pairs = least_of_pairs<Width>(first, second);
  const float below = pairs[options_.k - 2];
  costs[Width - 1] = below;
  costs[0] = half_area(node.bounds) + below;
  if (references <= options_.leaf) costs[0] = std::min(costs[0], leaf_cost(node.bounds, references));
  for (std::uint32_t i = 1; i < Width - 1; ++i) costs[i] = std::min(costs[i - 1], pairs[i - 1]);
}

}  // namespace boxwood
