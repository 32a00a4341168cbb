#include "refine/reinsert/link_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fastbuild/trees.h"

namespace boxwood {
namespace {

/// More nodes than are linked at a time, with two children each or with up to eight.
std::vector<Tree> large_trees() {
  const Triangles triangles("many", scattered(30000, 0.02f));
  std::vector<Tree> trees;
  for (const char* const builder : {"ploc(leaf=1)", "ploc(leaf=1, group=8, run=1, width=8)"}) {
    trees.push_back(build_tree(builder, triangles));
    EXPECT_GT(trees.back().nodes.size(), 25000u);
  }
  EXPECT_FALSE(is_binary(trees.back()));
  return trees;
}

Box bounds_below(const LinkTree& links, Child child) {
  const LinkTree::Inner& inner = links.inner[child.number()];
  return unite(inner.bounds[0], inner.bounds[1]);
}

TEST(LinkTree, LargeTree_EveryNodeHangsAtOneEdgeThatKnowsItsBox) {
  for (const Tree& tree : large_trees()) {
    const LinkTree links = link(tree);
    std::vector<int> inner(links.inner.size()), leaves(tree.nodes.size());
    EXPECT_EQ(links.inner.front().up, LinkTree::no_edge);
    for (Edge edge = 0; edge < links.inner.size() * 2; ++edge) {
      const Child child = links.child(edge);
      ++(child.is_leaf() ? leaves : inner)[child.number()];
      if (child.is_leaf()) {
        EXPECT_EQ(links.bounds(edge), tree.nodes[child.number()].bounds);
      } else {
        EXPECT_EQ(links.inner[child.number()].up, edge);
        EXPECT_EQ(links.bounds(edge), bounds_below(links, child));
      }
    }
    EXPECT_EQ(inner.front(), 0);
    for (std::size_t i = 1; i < inner.size(); ++i) EXPECT_EQ(inner[i], 1) << i;
    for (std::size_t i = 0; i < leaves.size(); ++i) EXPECT_EQ(leaves[i], tree.nodes[i].is_leaf() ? 1 : 0) << i;
  }
}

TEST(LinkTree, LargeTree_TakenApartAndPutTogetherIsBinaryAndHasAllReferences) {
  for (const Tree& tree : large_trees()) {
    Tree again = relink(link(tree), tree);
    EXPECT_TRUE(is_binary(again));
    std::ranges::sort(again.references);
    EXPECT_EQ(again.references.size(), 30000u);
    for (std::uint32_t i = 0; i < again.references.size(); ++i) EXPECT_EQ(again.references[i], i);
  }
}

}  // namespace
}  // namespace boxwood
