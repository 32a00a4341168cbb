// What holds for every top-down builder with any options, on any input.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cctype>

#include "cost/registry.h"
#include "inputs.h"
#include "tree/statistics.h"
#include "tree/validate.h"

namespace boxwood {
namespace {

struct Case {
  std::string call;
  std::uint32_t k = 2;
  std::uint32_t leaf = 4;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::uint32_t k : {2u, 3u, 4u, 8u, 16u}) {
    const std::string ways = "k=" + std::to_string(k);
    all.push_back({"median(" + ways + ")", k, k});
    all.push_back({"median(" + ways + ", extent=centroids, leaf=1)", k, 1});
    all.push_back({"equal(" + ways + ")", k, 1});
    all.push_back({"middle(" + ways + ")", k, 1});
    all.push_back({"middle(" + ways + ", plane=box, leaf=3)", k, 3});
    for (const std::string builder : {"sweep(", "binned("}) {
      all.push_back({builder + ways + ")", k, 4});
      all.push_back({builder + ways + ", axis=longest, extent=box, stop=count, leaf=2)", k, 2});
      all.push_back({builder + ways + ", axis=longest, stop=count, leaf=16)", k, 16});
    }
  }
  for (const std::string builder : {"sweep(", "binned("}) {
    all.push_back({builder + "leaf=1)", 2, 1});
    all.push_back({builder + "pairs=on, traversal_cost=1.2, leaf=1048576)", 2, 1048576});
    all.push_back({builder + "traversal_cost=0)", 2, 4});
    for (const CostModelEntry& cost : cost_models()) {
      all.push_back({builder + "cost=" + cost.name + ")", 2, 4});
      all.push_back({builder + "cost=" + cost.name + ", leaf_test=area, k=8)", 8, 4});
    }
    all.push_back({builder + "cost=rdh(among=children, segments=off), leaf=64)", 2, 64});
    all.push_back({builder + "cost=perspective(literal=on), leaf=1048576)", 2, 1048576});
    all.push_back({builder + "cost=blend(rdh(beta=1), blend(osah, interior-hq), 0.25))", 2, 4});
  }
  for (const std::string bins : {"2", "10", "12", "256"}) {
    all.push_back({"binned(exact=0, bins=" + bins + ")", 2, 4});
    all.push_back({"binned(exact=0, k=16, axis=longest, bins=" + bins + ")", 16, 4});
  }
  for (const std::string builder : {"median", "equal", "middle", "sweep", "binned"}) {
    all.push_back({builder + "(centroid=mean, leaf=1)", 2, 1});
  }
  return all;
}

class TreeOf : public testing::TestWithParam<Case> {};

TEST_P(TreeOf, AnyInput_ValidAndWithinLimits) {
  for (const NamedBoxes& input : named_boxes()) {
    const Tree tree = build_tree(GetParam().call, input.boxes);
    EXPECT_EQ(validate(tree, input.boxes, GetParam().k), "") << input.name;
    for (const Tree::Node& node : tree.nodes) {
      if (node.is_leaf()) {
        EXPECT_LE(node.count, GetParam().leaf) << input.name;
      }
    }
    EXPECT_LT(statistics(tree).max_depth, 132u) << input.name;
  }
}

TEST_P(TreeOf, NoReferences_NoNodes) { EXPECT_TRUE(build_tree(GetParam().call, {}).empty()); }

TEST_P(TreeOf, Children_AscendAlongTheAxis) {
  const std::vector<Box> boxes = random_boxes(500, 1e-6f);  // small enough that centres order as boxes do
  const Tree tree = build_tree(GetParam().call, boxes);
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) continue;
    ASSERT_LT(node.axis, 3u);
    for (std::uint32_t i = 1; i < node.count; ++i) {
      EXPECT_LE(tree.nodes[node.first + i - 1].bounds.center()[node.axis],
                tree.nodes[node.first + i].bounds.center()[node.axis]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AnyBuilder, TreeOf, testing::ValuesIn(cases()), [](const auto& test) {
  std::string name = test.param.call;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
});

bool same(const Tree& a, const Tree& b) {
  const auto same_node = [](const Tree::Node& x, const Tree::Node& y) {
    return x.bounds == y.bounds && x.first == y.first && x.count == y.count && x.leaf == y.leaf && x.axis == y.axis;
  };
  return a.references == b.references &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_node);
}

TEST(TreeOfAnyBuilder, AnyNumberOfThreads_SameTree) {
  const std::vector<Box> boxes = random_boxes(150000, 0.01f);  // large enough for parallel binning, bounds and tasks
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const std::string call : {"median(k=4)", "middle", "equal", "sweep(axis=longest)", "binned", "binned(k=8)"}) {
    Tree one, many;
    tbb::task_arena(1).execute([&] { one = build_tree(call, boxes); });
    tbb::task_arena(8).execute([&] { many = build_tree(call, boxes); });
    EXPECT_TRUE(same(one, many)) << call;
    EXPECT_EQ(validate(many, boxes), "") << call;
  }
}

TEST(TreeOfAnyBuilder, MeanCentroidsWithoutGeometry_Refused) {
  for (const Stage& stage : builder_stages()) {
    const StageCall call = stage_call(builder_stages(), stage.name + "(centroid=mean)");
    EXPECT_THROW(stage.build(call.options, input_of(random_boxes(10))), UsageError) << stage.name;
  }
}

TEST(TreeOfAnyBuilder, StopByCount_LeavesAreFull) {
  const std::vector<Box> boxes = random_boxes(64);
  EXPECT_EQ(build_tree("sweep(stop=count, leaf=64)", boxes).nodes.size(), 1u);
  EXPECT_EQ(build_tree("binned(stop=count, leaf=64)", boxes).nodes.size(), 1u);
}

TEST(TreeOfAnyBuilder, StopByCost_DearTraversalMakesOneLeaf) {
  const std::vector<Box> boxes = random_boxes(64);
  EXPECT_EQ(build_tree("sweep(leaf=64, traversal_cost=1000)", boxes).nodes.size(), 1u);
  EXPECT_GT(build_tree("sweep(leaf=64, traversal_cost=0.1)", boxes).nodes.size(), 30u);
  EXPECT_EQ(build_tree("sweep(leaf=2, traversal_cost=1000)", random_boxes(2)).nodes.size(), 1u);
  EXPECT_EQ(build_tree("sweep(leaf=2, traversal_cost=1000, pairs=on)", random_boxes(2)).nodes.size(), 3u);
}

}  // namespace
}  // namespace boxwood
