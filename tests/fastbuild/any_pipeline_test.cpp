// What holds for every fast builder and every refinement here, on any input.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "fastbuild/trees.h"

namespace boxwood {
namespace {

class TreeOf : public testing::TestWithParam<std::string> {};

TEST_P(TreeOf, TroublingTriangles_IsValid) {
  for (const Triangles& triangles : troubling_triangles()) {
    const Tree tree = build_tree(GetParam(), triangles);
    EXPECT_EQ(validate(tree, triangles.boxes()), "") << triangles.name();
    if (!tree.clipped_leaves) {
      EXPECT_EQ(tree.references.size(), triangles.size()) << triangles.name();
    }
  }
}

TEST_P(TreeOf, TroublingTriangles_NotTooDeep) {
  for (const Triangles& triangles : troubling_triangles()) {
    EXPECT_LE(statistics(build_tree(GetParam(), triangles)).max_depth, 100u) << triangles.name();
  }
}

TEST_P(TreeOf, AnyNumberOfThreads_IsTheSame) {
  const tbb::global_control more_threads_than_cores(tbb::global_control::max_allowed_parallelism, 4);
  for (const Triangles& triangles : {Triangles("surface", surface(120)), Triangles("needles", needles(3000))}) {
    const Tree one = build_with_threads(GetParam(), triangles, 1);
    for (const int threads : {2, 4}) {
      const Tree more = build_with_threads(GetParam(), triangles, threads);
      ASSERT_EQ(one.nodes.size(), more.nodes.size()) << triangles.name();
      EXPECT_EQ(one.references, more.references) << triangles.name();
      for (std::size_t i = 0; i < one.nodes.size(); ++i) {
        ASSERT_TRUE(one.nodes[i].bounds == more.nodes[i].bounds && one.nodes[i].first == more.nodes[i].first &&
                    one.nodes[i].count == more.nodes[i].count && one.nodes[i].leaf == more.nodes[i].leaf &&
                    one.nodes[i].axis == more.nodes[i].axis)
            << triangles.name() << ", node " << i;
      }
    }
  }
}

TEST_P(TreeOf, AnyTriangles_ChildrenAscendAlongTheirAxis) {
  const Triangles triangles("scattered", scattered(3000, 0.05f));
  const Tree tree = build_tree(GetParam(), triangles);
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf() || node.axis == Tree::mixed_axis) continue;
    for (std::uint32_t c = 1; c < node.count; ++c) {
      const Vec3 below = tree.nodes[node.first + c - 1].bounds.center(),
                 above = tree.nodes[node.first + c].bounds.center();
      EXPECT_LE(below[node.axis], above[node.axis]);
    }
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name;
  for (const char c : info.param) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
    if (c == '>' || c == ',') name += '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Fast, TreeOf,
    testing::Values("ploc", "ploc(radius=1, leaf=1)", "ploc(radius=31, morton=60, leaf=8, block=4)", "ploc(morton=3)",
                    "ploc(block=4, run=4)", "ploc(width=8)", "ploc(leaf=1, group=2)",
                    "ploc(radius=4, block=4, run=4, slack=1.5, group=8, width=8)",
                    "ploc(run=3, slack=4, group=16, width=16, presplit=1)",
                    "ploc(block=4, run=4, leaf=8) > reinsert > optimal-collapse(8)", "ploc > reinsert",
                    "median > reinsert(batch=1, rounds=2)", "median(k=8) > reinsert", "spatial",
                    "spatial(alpha=0, budget=2, bins=8, leaf=1)", "spatial(unsplit=off, block=4, leaf=8) > reinsert",
                    "ploc > optimal-collapse(8)", "ploc(presplit=0.5)", "ploc(presplit=2, leaf=1) > reinsert",
                    "spatial > reinsert > optimal-collapse(4, leaf=8)", "median(k=16) > optimal-collapse(3)"),
    test_name);

}  // namespace
}  // namespace boxwood
