#include "tree/assemble.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <numeric>
#include <vector>

#include "support/lopsided_tree.h"

namespace boxwood {
namespace {

Tree lopsided(std::uint32_t references, int threads) {
  tbb::task_arena arena(threads);
  return arena.execute([&] { return test::lopsided_tree(references); });
}

TEST(Assemble, LopsidedTree_HasEveryNodeOnceBelowItsParent) {
  constexpr std::uint32_t references = 200000;
  const Tree tree = lopsided(references, 4);
  ASSERT_EQ(tree.nodes.size(), 2 * references - 1);
  std::vector<int> children_of(tree.nodes.size()), leaves_of(references);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      const std::uint32_t reference = tree.references[node.first];
      ++leaves_of[reference];
      EXPECT_EQ(node.bounds.lower.x, static_cast<float>(reference));
      continue;
    }
    ASSERT_GT(node.first, i);
    const Tree::Node &left = tree.nodes[node.first], &right = tree.nodes[node.first + 1];
    ++children_of[node.first], ++children_of[node.first + 1];
    EXPECT_EQ(left.bounds.lower.x, node.bounds.lower.x);
    EXPECT_EQ(left.bounds.upper.x, right.bounds.lower.x);
    EXPECT_EQ(right.bounds.upper.x, node.bounds.upper.x);
  }
  EXPECT_EQ(children_of[0], 0);
  EXPECT_EQ(std::accumulate(children_of.begin(), children_of.end(), 0), 2 * static_cast<int>(references) - 2);
  for (std::size_t i = 1; i < children_of.size(); ++i) ASSERT_EQ(children_of[i], 1) << i;
  for (std::size_t i = 0; i < leaves_of.size(); ++i) ASSERT_EQ(leaves_of[i], 1) << i;
}

TEST(Assemble, AnyNumberOfThreads_TheSameTree) {
  const Tree one = lopsided(100000, 1);
  for (const int threads : {2, 4}) {
    const Tree many = lopsided(100000, threads);
    EXPECT_EQ(many.references, one.references);
    ASSERT_EQ(many.nodes.size(), one.nodes.size());
    for (std::size_t i = 0; i < one.nodes.size(); ++i) {
      ASSERT_EQ(many.nodes[i].bounds, one.nodes[i].bounds) << i;
      ASSERT_EQ(many.nodes[i].first, one.nodes[i].first) << i;
    }
  }
}

}  // namespace
}  // namespace boxwood
