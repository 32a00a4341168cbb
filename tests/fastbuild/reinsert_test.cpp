#include <gtest/gtest.h>

#include <map>

#include "fastbuild/trees.h"
#include "refine/reinsert/apply_reinsertion.h"
#include "refine/reinsert/find_reinsertion.h"

namespace boxwood {
namespace {

/// How often each set of references is a leaf.
std::map<std::vector<std::uint32_t>, int> leaves_of(const Tree& tree) {
  std::map<std::vector<std::uint32_t>, int> leaves;
  for (const Tree::Node& node : tree.nodes) {
    const auto first = tree.references.begin() + node.first;
    if (node.is_leaf()) ++leaves[{first, first + node.count}];
  }
  return leaves;
}

TEST(Reinsert, AnyTree_NeverWorseAndLeavesIntact) {
  for (const Triangles& triangles : troubling_triangles()) {
    for (const std::string builder : {"ploc", "median", "binned"}) {
      const Tree before = build_tree(builder, triangles);
      for (const std::string refinement : {" > reinsert", " > reinsert(batch=1, rounds=3)"}) {
        const Tree after = build_tree(builder + refinement, triangles);
        EXPECT_LE(sah_cost(after), sah_cost(before) * (1 + 1e-9)) << triangles.name();
        EXPECT_EQ(leaves_of(after), leaves_of(before)) << triangles.name();
      }
    }
  }
}

TEST(Reinsert, PoorTree_MuchBetter) {
  const Triangles triangles("scattered", scattered(2000, 0.05f));
  const double before = sah_cost(build_tree("median(leaf=1)", triangles));
  EXPECT_LT(sah_cost(build_tree("median(leaf=1) > reinsert(batch=1, rounds=8)", triangles)), 0.9 * before);
}

/// Area of all inner nodes, what reinsertion decreases.
double inner_area(const LinkTree& tree) {
  double sum = half_area(tree.root_bounds);
  for (Edge edge = 0; edge < tree.inner.size() * 2; ++edge) {
    if (!tree.child(edge).is_leaf()) sum += half_area(tree.bounds(edge));
  }
  return sum;
}

TEST(Reinsert, SmallTree_FindsWhatTryingEveryPlaceFinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LinkTree tree = link(build_tree("median(leaf=1)", Triangles("few", scattered(12, 0.3f, seed))));
    const double before = inner_area(tree);
    for (Edge from = 2; from < tree.inner.size() * 2; ++from) {
      double best = 0;
      for (Edge to = 0; to < tree.inner.size() * 2; ++to) {
        const std::uint32_t parent = from >> 1;
        if (to == from || to == LinkTree::sibling(from) || to == tree.inner[parent].up) continue;
        LinkTree moved = tree;
        ReinsertionApplier applier(moved);
        applier.begin_batch();
        if (applier.apply({from, to, 0})) best = std::max(best, before - inner_area(moved));
      }
      const Reinsertion found = ReinsertionFinder(tree).find(from);
      EXPECT_NEAR(found.gain, best, 1e-4 * before) << "seed " << seed << ", edge " << from;
    }
  }
}

}  // namespace
}  // namespace boxwood
