// Node counts that the wide BVH study fixes: they depend on the number of triangles and on k alone (its annex A.5).
#include <gtest/gtest.h>

#include <algorithm>

#include "inputs.h"
#include "refine/stages.h"
#include "tree/statistics.h"
#include "tree/validate.h"

namespace boxwood {
namespace {

Tree collapsed(const std::string& call, Tree tree) {
  static const std::vector<Stage> stages = {collapse_stage()};
  const StageCall collapse = stage_call(stages, call);
  return collapse.stage->refine(collapse.options, std::move(tree));
}

struct Shape {
  std::uint32_t triangles, k;
  std::uint64_t inner, leaves;
  std::uint32_t largest_leaf, depth;
};

class MedianShape : public testing::TestWithParam<Shape> {};

TEST_P(MedianShape, WideBvhStudy_ExactCounts) {
  const Shape& shape = GetParam();
  const Tree tree = build_tree("median(k=" + std::to_string(shape.k) + ")", random_boxes(shape.triangles));
  const TreeStatistics found = statistics(tree);
  EXPECT_EQ(found.inner_nodes, shape.inner);
  EXPECT_EQ(found.leaves, shape.leaves);
  EXPECT_EQ(found.leaf_sizes.size() - 1, shape.largest_leaf);
  EXPECT_EQ(found.max_depth, shape.depth);
  EXPECT_EQ(found.max_arity, shape.k);
}

INSTANTIATE_TEST_SUITE_P(Suzanne, MedianShape,
                         testing::Values(Shape{968, 2, 511, 512, 2, 9}, Shape{968, 4, 85, 256, 4, 4},
                                         Shape{968, 8, 73, 512, 2, 3}, Shape{968, 16, 17, 256, 4, 2}));
INSTANTIATE_TEST_SUITE_P(Teapot, MedianShape,
                         testing::Values(Shape{6320, 2, 4095, 4096, 2, 12}, Shape{6320, 4, 1365, 4096, 2, 6},
                                         Shape{6320, 8, 585, 4096, 2, 4}, Shape{6320, 16, 273, 4096, 2, 3}));
INSTANTIATE_TEST_SUITE_P(Bunny, MedianShape,
                         testing::Values(Shape{69451, 2, 36682, 36683, 2, 16}, Shape{69451, 4, 9376, 28129, 4, 8},
                                         Shape{69451, 8, 4681, 32768, 3, 5}, Shape{69451, 16, 4188, 62821, 16, 4}));

struct CollapseShape {
  std::string call;
  std::uint64_t suzanne, teapot, bunny;  // inner nodes
  std::uint32_t arity;
};

class CollapsedMedianShape : public testing::TestWithParam<CollapseShape> {};

TEST_P(CollapsedMedianShape, WideBvhStudy_ExactCounts) {
  const std::pair<std::uint32_t, std::uint64_t> scenes[] = {
      {968, GetParam().suzanne}, {6320, GetParam().teapot}, {69451, GetParam().bunny}};
  for (const auto& [triangles, inner] : scenes) {
    const TreeStatistics found = statistics(collapsed(GetParam().call, build_tree("median", random_boxes(triangles))));
    EXPECT_EQ(found.inner_nodes, inner) << triangles;
    EXPECT_EQ(found.max_arity, GetParam().arity) << triangles;
  }
}

INSTANTIATE_TEST_SUITE_P(Published, CollapsedMedianShape,
                         testing::Values(CollapseShape{"collapse(4, method=squaring)", 341, 1365, 21845, 4},
                                         CollapseShape{"collapse(8, method=squaring)", 273, 273, 4369, 16},
                                         CollapseShape{"collapse(16, method=squaring)", 257, 257, 257, 256},
                                         CollapseShape{"collapse(4, method=levels)", 341, 1365, 21845, 4},
                                         CollapseShape{"collapse(8, method=levels)", 73, 585, 8596, 8},
                                         CollapseShape{"collapse(16, method=levels)", 273, 273, 4369, 16}));

/// Lists the leaves' first references from left to right.
void list_leaves(const Tree& tree, std::uint32_t node, std::vector<std::uint32_t>& leaves) {
  const Tree::Node& n = tree.nodes[node];
  if (n.is_leaf()) {
    leaves.push_back(n.first);
    return;
  }
  for (std::uint32_t i = 0; i < n.count; ++i) list_leaves(tree, n.first + i, leaves);
}

class Collapse : public testing::TestWithParam<std::string> {};

TEST_P(Collapse, AnyMethod_ValidTreeOfTheSameLeaves) {
  for (const NamedBoxes& input : named_boxes()) {
    const Tree binary = build_tree("binned", input.boxes);
    const Tree wide = collapsed(GetParam(), binary);
    EXPECT_EQ(validate(wide, input.boxes), "") << input.name;
    EXPECT_EQ(wide.references, binary.references);
    EXPECT_LE(wide.nodes.size(), binary.nodes.size());
    if (binary.empty()) continue;
    std::vector<std::uint32_t> before, after;
    list_leaves(binary, 0, before);
    list_leaves(wide, 0, after);
    EXPECT_EQ(before, after) << input.name;
  }
}

TEST_P(Collapse, AnyMethod_ArityAsAnnounced) {
  static const std::vector<Stage> stages = {collapse_stage()};
  const StageCall call = stage_call(stages, GetParam());
  const std::uint32_t announced = call.stage->arity(call.options);
  const TreeStatistics found = statistics(collapsed(GetParam(), build_tree("median", random_boxes(4096))));
  EXPECT_LE(found.max_arity, announced);
  EXPECT_GE(found.max_arity * 2, announced);
}

INSTANTIATE_TEST_SUITE_P(Methods, Collapse,
                         testing::Values("collapse(2)", "collapse(3)", "collapse(4)", "collapse(8)", "collapse(64)",
                                         "collapse(2, method=levels)", "collapse(4, method=levels)",
                                         "collapse(8, method=levels)", "collapse(4, method=squaring)",
                                         "collapse(8, method=squaring)", "collapse(16, method=squaring)"));

TEST(Collapse, ByArea_LargestChildOpenedFirst) {
  // A root whose left child is small and whose right child is large; one of them may be opened.
  Tree tree;
  tree.nodes.resize(7);
  const auto set = [&](std::size_t i, Box bounds, std::uint32_t first, std::uint32_t count, bool leaf) {
    tree.nodes[i].bounds = bounds;
    tree.nodes[i].first = first;
    tree.nodes[i].count = count & Tree::max_count;
    tree.nodes[i].leaf = leaf;
    tree.nodes[i].axis = 0;
  };
  set(0, {{0, 0, 0}, {10, 1, 1}}, 1, 2, false);
  set(1, {{0, 0, 0}, {1, 1, 1}}, 3, 2, false);
  set(2, {{1, 0, 0}, {10, 1, 1}}, 5, 2, false);
  for (std::uint32_t i = 3; i < 7; ++i) {
    set(i, {{i < 5 ? 0.0f : 1.0f, 0, 0}, {i < 5 ? 1.0f : 10.0f, 1, 1}}, i - 3, 1, true);
    tree.references.push_back(i - 3);
  }
  const Tree wide = collapsed("collapse(3)", tree);
  ASSERT_EQ(wide.nodes[0].count, 3u);
  EXPECT_FALSE(wide.nodes[1].is_leaf());
  EXPECT_TRUE(wide.nodes[2].is_leaf());
  EXPECT_TRUE(wide.nodes[3].is_leaf());
  EXPECT_EQ(wide.nodes[0].axis, 0u);  // all split along x: still ascending

  tree.nodes[2].axis = 1;
  EXPECT_EQ(collapsed("collapse(3)", tree).nodes[0].axis, Tree::mixed_axis);
}

TEST(Collapse, WrongRequests_Refused) {
  const Tree wide = build_tree("median(k=8)", random_boxes(100));
  EXPECT_THROW(collapsed("collapse(4)", wide), UsageError);
  EXPECT_THROW(collapsed("collapse(4, method=levels)", wide), UsageError);
  EXPECT_THROW(collapsed("collapse(6, method=levels)", build_tree("median", random_boxes(100))), UsageError);
  EXPECT_THROW(collapsed("collapse(32, method=squaring)", build_tree("median", random_boxes(100))), UsageError);
}

}  // namespace
}  // namespace boxwood
