#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "fastbuild/trees.h"
#include "refine/optimal_collapse/collapse_costs.h"
#include "support/lopsided_tree.h"

namespace boxwood {
namespace {

struct Limits {
  std::uint32_t k, leaf, block;
};

double block_cost(std::uint32_t references, const Limits& limits) {
  const std::uint32_t blocks = (references + limits.block - 1) / limits.block;
  return blocks;
}

/// What the collapse minimises, of a tree as it is.
double collapse_cost(const Tree& tree, const Limits& limits) {
  double sum = 0;
  for (const Tree::Node& node : tree.nodes) {
    sum += half_area(node.bounds) * (node.is_leaf() ? block_cost(node.count, limits) : 1);
  }
  return sum;
}

std::uint32_t references_below(const Tree& tree, std::uint32_t node) {
  const Tree::Node& at = tree.nodes[node];
  if (at.is_leaf()) return at.count;
  return references_below(tree, at.first) + references_below(tree, at.first + 1);
}

double least_as_node(const Tree& tree, std::uint32_t node, const Limits& limits);

/// Tries every way to make the children of one wide node: each of `open` stays, or is replaced by its two children.
double least_as_children(const Tree& tree, std::vector<std::uint32_t> open, std::size_t decided, const Limits& limits) {
  if (decided == open.size()) {
    double sum = 0;
    for (const std::uint32_t node : open) sum += least_as_node(tree, node, limits);
    return sum;
  }
  double least = least_as_children(tree, open, decided + 1, limits);
  const Tree::Node& at = tree.nodes[open[decided]];
  if (!at.is_leaf() && open.size() < limits.k) {
    open[decided] = at.first;
    open.push_back(at.first + 1);
    least = std::min(least, least_as_children(tree, open, decided, limits));
  }
  return least;
}

double least_as_node(const Tree& tree, std::uint32_t node, const Limits& limits) {
  const Tree::Node& at = tree.nodes[node];
  const std::uint32_t references = references_below(tree, node);
  double least = std::numeric_limits<double>::infinity();
  if (at.is_leaf() || references <= limits.leaf) least = half_area(at.bounds) * block_cost(references, limits);
  if (at.is_leaf()) return least;
  return std::min(least, half_area(at.bounds) + least_as_children(tree, {at.first, at.first + 1}, 0, limits));
}

std::string call(const Limits& limits, bool pack = true) {
  return "optimal-collapse(" + std::to_string(limits.k) + ", leaf=" + std::to_string(limits.leaf) +
         ", block=" + std::to_string(limits.block) + (pack ? ")" : ", pack=off)");
}

TEST(OptimalCollapse, SmallTree_CostsWhatTryingEverythingFinds) {
  for (const Limits& limits : {Limits{2, 1, 1}, Limits{3, 2, 1}, Limits{4, 4, 4}, Limits{8, 2, 2}, Limits{4, 3, 1}}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Triangles triangles("few", scattered(1 + seed, 0.4f, seed));
      const Tree binary = build_tree("median(leaf=1)", triangles);
      const Tree wide = build_tree("median(leaf=1) > " + call(limits, false), triangles);
      EXPECT_EQ(validate(wide, triangles.boxes(), limits.k), "");
      const double least = least_as_node(binary, 0, limits);
      EXPECT_NEAR(collapse_cost(wide, limits), least, 1e-5 * least) << call(limits) << ", " << triangles.size();
    }
  }
}

TEST(OptimalCollapse, LopsidedLargeTree_CostsOfEachNodeFollowFromItsChildren) {
  constexpr std::uint32_t leaves = 100000;
  const Tree tree = test::lopsided_tree(leaves);
  const CollapseCosts costs(tree, {.k = 8, .leaf = 4, .block = 4});
  EXPECT_EQ(costs.references(0), leaves);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    for (std::uint32_t count = 2; count < 8; ++count) {
      float least = costs.cost(i, count - 1);
      for (std::uint32_t first = 1; first < count; ++first) {
        least = std::min(least, costs.cost(node.first, first) + costs.cost(node.first + 1, count - first));
      }
      ASSERT_EQ(costs.cost(i, count), least) << i << ", " << count;
    }
  }
}

TEST(OptimalCollapse, AnyTree_NoDearerThanGreedyCollapse) {
  for (const Triangles& triangles : troubling_triangles()) {
    for (const std::uint32_t k : {2u, 4u, 8u, 16u}) {
      const Limits limits{k, 4, 4};
      for (const std::string builder : {"ploc(leaf=1)", "median(leaf=1)"}) {
        const Tree optimal = build_tree(builder + " > " + call(limits), triangles);
        EXPECT_EQ(validate(optimal, triangles.boxes(), k), "") << triangles.name();
        const Tree greedy = build_tree(builder + " > collapse(" + std::to_string(k) + ")", triangles);
        EXPECT_LE(collapse_cost(optimal, limits), collapse_cost(greedy, limits) * (1 + 1e-5))
            << triangles.name() << ", k = " << k;
      }
    }
  }
}

std::size_t count_of_leaves(const Tree& tree) {
  return static_cast<std::size_t>(std::ranges::count_if(tree.nodes, &Tree::Node::is_leaf));
}

TEST(OptimalCollapse, Packing_NeverDearerAndFewerLeaves) {
  std::size_t packed_leaves = 0, loose_leaves = 0;
  for (const Triangles& triangles : troubling_triangles()) {
    for (const Limits limits : {Limits{8, 4, 4}, Limits{4, 8, 8}, Limits{16, 4, 1}}) {
      const Tree packed = build_tree("ploc > " + call(limits), triangles);
      const Tree loose = build_tree("ploc > " + call(limits, false), triangles);
      EXPECT_EQ(validate(packed, triangles.boxes(), limits.k), "") << triangles.name();
      EXPECT_LE(collapse_cost(packed, limits), collapse_cost(loose, limits) * (1 + 1e-5)) << triangles.name();
      packed_leaves += count_of_leaves(packed);
      loose_leaves += count_of_leaves(loose);
    }
  }
  EXPECT_LT(packed_leaves, loose_leaves);
}

TEST(OptimalCollapse, LeafLimit_HoldsUnlessLeavesWereLarger) {
  const Triangles triangles("surface", surface(40));
  const Tree tree = build_tree("ploc(leaf=1) > optimal-collapse(8, leaf=8, block=8)", triangles);
  std::uint32_t largest = 0;
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) largest = std::max<std::uint32_t>(largest, node.count);
  }
  EXPECT_EQ(largest, 8u);
}

}  // namespace
}  // namespace boxwood
