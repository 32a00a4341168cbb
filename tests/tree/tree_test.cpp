#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tree/statistics.h"
#include "tree/validate.h"

namespace boxwood {
namespace {

Box unit_box(float x) { return {{x, 0, 0}, {x + 1, 1, 1}}; }

Tree::Node inner(Box bounds, std::uint32_t first, std::uint32_t count) {
  Tree::Node node;
  node.bounds = bounds;
  node.first = first;
  node.count = count & Tree::max_count;
  return node;
}

Tree::Node leaf(Box bounds, std::uint32_t first, std::uint32_t count) {
  Tree::Node node = inner(bounds, first, count);
  node.leaf = 1;
  return node;
}

/// Four unit boxes in a row, in two leaves and one more inner node:  0 -> (1 leaf {0}, 2 -> (3 leaf {1}, 4 leaf {2,
/// 3})).
std::vector<Box> row_of_boxes() { return {unit_box(0), unit_box(1), unit_box(2), unit_box(3)}; }

Tree row_tree() {
  const std::vector<Box> boxes = row_of_boxes();
  Tree tree;
  const Box last = unite(boxes[2], boxes[3]), right = unite(boxes[1], last);
  tree.nodes = {inner(unite(boxes[0], right), 1, 2), leaf(boxes[0], 0, 1), inner(right, 3, 2), leaf(boxes[1], 1, 1),
                leaf(last, 2, 2)};
  tree.references = {0, 1, 2, 3};
  return tree;
}

TEST(Validate, SoundTree_NothingToSay) {
  EXPECT_EQ(validate(row_tree(), row_of_boxes()), "");
  EXPECT_EQ(validate(Tree{}, {}), "");
}

TEST(Validate, PrimitiveWithoutBox_MustNotBeReferenced) {
  std::vector<Box> boxes = row_of_boxes();
  boxes.push_back(Box{});
  EXPECT_EQ(validate(row_tree(), boxes), "");
  boxes[1] = Box{};
  EXPECT_NE(validate(row_tree(), boxes).find("no box"), std::string::npos);
}

struct Mutation {
  std::string name;
  std::function<void(Tree&)> apply;
  std::string complaint;  // part of the sentence, with the node's number
};

class ValidateMutation : public testing::TestWithParam<Mutation> {};

TEST_P(ValidateMutation, BrokenTree_ViolationNamed) {
  Tree tree = row_tree();
  GetParam().apply(tree);
  const std::string said = validate(tree, row_of_boxes(), 2);
  EXPECT_NE(said.find(GetParam().complaint), std::string::npos) << "said: '" << said << "'";
}

std::vector<Mutation> mutations() {
  return {
      Mutation{"NoNodes", [](Tree& t) { t.nodes.clear(); }, "4 references but no nodes"},
      Mutation{"EmptyLeaf", [](Tree& t) { t.nodes[3].count = 0; }, "leaf 3 holds no references"},
      Mutation{"LeafBeyondReferences", [](Tree& t) { t.nodes[4].count = 3; }, "leaf 4 holds references 2 to 4 of 4"},
      Mutation{"OneChild", [](Tree& t) { t.nodes[2].count = 1; }, "inner node 2 has 1 children"},
      Mutation{"TooManyChildren", [](Tree& t) { t.nodes[0].count = 3; }, "inner node 0 has 3 children, more than 2"},
      Mutation{"ChildrenBeyondNodes", [](Tree& t) { t.nodes[2].first = 4; }, "inner node 2 has children 4 to 5 of 5"},
      Mutation{"Cycle", [](Tree& t) { t.nodes[2].first = 0; }, "inner node 2 has child 0, which is not after it"},
      Mutation{"TwoParents", [](Tree& t) { t.nodes[0].first = 2; }, "node 3 has two parents, the second is node 2"},
      Mutation{"Unreachable", [](Tree& t) { t.nodes.push_back(t.nodes[4]); }, "node 5 can not be reached"},
      Mutation{"SharedReference", [](Tree& t) { t.nodes[4].first = 1; }, "reference 1 lies in two leaves"},
      Mutation{"LostReference", [](Tree& t) { t.nodes[4].count = 1; }, "reference 3 lies in no leaf"},
      Mutation{"ReferenceOutOfRange", [](Tree& t) { t.references[2] = 9; }, "reference 2 is primitive 9 of 4"},
      Mutation{"DuplicatedPrimitive", [](Tree& t) { t.references[3] = 0; }, "primitive 0 is referenced twice"},
      Mutation{"MissingPrimitive",
               [](Tree& t) {
                 t.references.pop_back();
                 t.nodes[4].count = 1;
               },
               "primitive 3 is not referenced"},
      Mutation{"EmptyRoot", [](Tree& t) { t.nodes[0].bounds = {}; }, "root's box is empty"},
      Mutation{"EmptyBox", [](Tree& t) { t.nodes[3].bounds = {}; }, "box of node 3 is empty"},
      Mutation{"ChildOutside", [](Tree& t) { t.nodes[4].bounds.upper.y = 2; }, "box of node 4 is not inside"},
      Mutation{"PrimitiveOutside", [](Tree& t) { t.nodes[3].bounds.upper.z = 0.5f; },
               "box of leaf 3 does not hold that of primitive 1"},
      Mutation{"ClippedLeafElsewhere",
               [](Tree& t) {
                 t.clipped_leaves = true;
                 t.nodes[1].bounds = {{3.5f, 0, 0}, {4, 1, 1}};
               },
               "box of leaf 1 does not touch that of primitive 0"}};
}

INSTANTIATE_TEST_SUITE_P(Each, ValidateMutation, testing::ValuesIn(mutations()),
                         [](const auto& test) { return test.param.name; });

TEST(Validate, ClippedLeaves_MayRepeatPrimitives) {
  Tree tree = row_tree();
  tree.clipped_leaves = true;
  tree.nodes[1] = leaf(unit_box(0), 0, 2);
  tree.nodes[3].first = 2;
  tree.nodes[4].first = 3;
  tree.references = {0, 1, 1, 2, 3};
  EXPECT_EQ(validate(tree, row_of_boxes()), "");
}

/// Recursive and straight from the definition.
double slow_sah_cost(const Tree& tree, std::uint32_t node, double traversal, double intersection) {
  const auto area = [](const Box& b) {
    const double x = b.upper.x - b.lower.x, y = b.upper.y - b.lower.y, z = b.upper.z - b.lower.z;
    return 2 * (x * y + x * z + y * z);
  };
  const Tree::Node& n = tree.nodes[node];
  const double p = area(n.bounds) / area(tree.nodes[0].bounds);
  if (n.is_leaf()) return intersection * p * n.count;
  double cost = traversal * p;
  for (std::uint32_t i = 0; i < n.count; ++i) cost += slow_sah_cost(tree, n.first + i, traversal, intersection);
  return cost;
}

TEST(SahCost, RowOfBoxes_AsByDefinition) {
  const Tree tree = row_tree();
  // Areas 18, 14 inside; 6, 6, 10 at the leaves.
  EXPECT_NEAR(sah_cost(tree), (18 + 14 + 6 + 6 + 2 * 10) / 18.0, 1e-12);
  EXPECT_NEAR(sah_cost(tree, {1.2, 3}), slow_sah_cost(tree, 0, 1.2, 3), 1e-12);
  EXPECT_EQ(sah_cost(Tree{}), 0);
}

TEST(SahCost, RootWithoutArea_EveryProbabilityIsOne) {
  Tree tree = row_tree();
  for (Tree::Node& node : tree.nodes) node.bounds = {{1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(sah_cost(tree), 2 + 4);
}

TEST(Statistics, RowOfBoxes_CountedRight) {
  const TreeStatistics found = statistics(row_tree());
  EXPECT_EQ(found.inner_nodes, 2u);
  EXPECT_EQ(found.leaves, 3u);
  EXPECT_EQ(found.references, 4u);
  EXPECT_EQ(found.max_depth, 2u);
  EXPECT_NEAR(found.mean_leaf_depth, 5.0 / 3, 1e-12);
  EXPECT_EQ(found.max_arity, 2u);
  EXPECT_EQ(found.mean_arity, 2);
  EXPECT_EQ(found.leaf_sizes, (std::vector<std::uint64_t>{0, 2, 1}));
  EXPECT_EQ(found.arities, (std::vector<std::uint64_t>{0, 0, 2}));
  // Siblings share a unit square, area 2, at both levels.
  ASSERT_EQ(found.sibling_overlap.size(), 2u);
  EXPECT_NEAR(found.sibling_overlap[0], 2 / 18.0, 1e-12);
  EXPECT_NEAR(found.sibling_overlap[1], 2 / 14.0, 1e-12);
  EXPECT_EQ(statistics(Tree{}).leaves, 0u);
}

}  // namespace
}  // namespace boxwood
