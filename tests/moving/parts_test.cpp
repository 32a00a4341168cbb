// Trees in parts: cut, refitted, and put together anew.
#include "tree/parts.h"

#include <gtest/gtest.h>

#include "moving/rebuild_parts.h"
#include "support/scenes.h"
#include "support/trees.h"
#include "tree/statistics.h"
#include "tree/validate.h"

namespace boxwood {
namespace {

struct Sample {
  std::vector<Box> boxes;
  Tree tree;
  TreeParts parts;
};

Sample sample(std::uint32_t triangles, std::uint32_t k, std::uint32_t leaf_size, std::uint32_t most) {
  Sample out;
  out.boxes = test::triangle_boxes(test::soup(triangles, 0.2f, triangles).meshes[0]);
  out.tree = test::split_tree(out.boxes, {k, leaf_size, true});
  out.parts = cut_tree(out.tree, [&](std::uint32_t references, std::uint32_t) { return references <= most; });
  return out;
}

TEST(TreeParts, EveryNodeIsListedOnceAfterItsParent) {
  for (const std::uint32_t most : {1u, 7u, 40u, 1000u}) {
    const Sample s = sample(300, 4, 3, most);
    std::vector<std::size_t> place(s.tree.nodes.size(), s.tree.nodes.size());
    ASSERT_EQ(s.parts.order.size(), s.tree.nodes.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[s.parts.order[i]] = i;
    std::uint32_t references = 0, next = s.parts.above;
    for (std::size_t i = 0; i < place.size(); ++i) {
      ASSERT_LT(place[i], place.size());
      const Tree::Node& node = s.tree.nodes[i];
      for (std::uint32_t c = 0; !node.is_leaf() && c < node.count; ++c) EXPECT_LT(place[i], place[node.first + c]);
    }
    for (const TreeParts::Part& part : s.parts.parts) {
      EXPECT_EQ(part.begin, next);
      EXPECT_EQ(s.parts.order[part.begin], part.root);
      EXPECT_LE(part.references, std::max(most, 3u));
      next = part.end;
      references += part.references;
    }
    EXPECT_EQ(next, place.size());
    EXPECT_EQ(references, s.tree.references.size());
  }
}

TEST(TreeParts, Refit_FitsEveryBoxAndAddsUpCosts) {
  Sample s = sample(300, 4, 3, 20);
  const std::vector<Box> moved = test::triangle_boxes(test::soup(300, 0.1f, 99).meshes[0]);
  const PartCosts costs = refit(s.tree, s.parts, [&](std::span<const std::uint32_t> primitives, Box& box) {
    for (const std::uint32_t primitive : primitives) box.grow(moved[primitive]);
  });
  EXPECT_EQ(validate(s.tree, moved, 4), "");
  for (const Tree::Node& node : s.tree.nodes) {
    Box tight;
    for (std::uint32_t c = 0; c < node.count; ++c) {
      tight.grow(node.is_leaf() ? moved[s.tree.references[node.first + c]] : s.tree.nodes[node.first + c].bounds);
    }
    EXPECT_EQ(node.bounds, tight);
  }
  double sum = 0;
  for (const double cost : costs) sum += cost;
  EXPECT_NEAR(sum / box_area(s.tree.nodes[0].bounds), sah_cost(s.tree), 1e-9 * sum);
  EXPECT_EQ(costs, part_costs(s.tree, s.parts));
}

TEST(RebuildParts, AnyChoice_GivesAValidTreeOverTheSamePrimitives) {
  for (const std::uint32_t k : {2u, 5u}) {
    for (const std::uint32_t most : {10u, 60u, 1000u}) {
      // Somewhere else by now, so that whatever is built anew is better than what it replaces.
      Sample s = sample(400, k, 2, most);
      s.boxes = test::triangle_boxes(test::soup(400, 0.2f, 77).meshes[0]);
      refit(s.tree, s.parts, [&](std::span<const std::uint32_t> primitives, Box& box) {
        for (const std::uint32_t primitive : primitives) box.grow(s.boxes[primitive]);
      });
      const auto count = static_cast<std::uint32_t>(s.parts.parts.size());
      std::vector<std::uint32_t> every, third;
      for (std::uint32_t p = 0; p < count; ++p) {
        every.push_back(p);
        if (p % 3 == 1) third.push_back(p);
      }
      // Trees of parts have leaves of 3; those above have leaves of up to 9 parts, more than a node may have children.
      const auto build = [&](const LargeVector<Reference>& references, bool of_triangles) {
        std::vector<Box> boxes(of_triangles ? s.boxes.size() : count);
        for (const Reference& reference : references) boxes[reference.primitive] = reference.box();
        return test::split_tree(boxes, {k, of_triangles ? 3u : 9u, true});
      };
      for (const std::vector<std::uint32_t>& chosen : {std::vector<std::uint32_t>{}, third, every}) {
        for (const bool above : {false, true}) {
          const Tree tree = rebuild_parts(s.tree, s.parts, {false, above, chosen}, k, build,
                                          [&](std::uint32_t primitive) { return s.boxes[primitive]; });
          EXPECT_EQ(validate(tree, s.boxes, k), "") << k << " " << most << " " << chosen.size() << " " << above;
        }
      }
    }
  }
}

TEST(PartAccounts, RentIsPaidUntilItReachesThePrice) {
  PartAccounts accounts;
  const std::vector<double> areas = {1, 1, 4};
  accounts.start({10, 10, 8}, areas, {100, 300});
  EXPECT_DOUBLE_EQ(accounts.cost_when_built(), 7);
  MotionPolicy policy;
  policy.rays_per_update = 1000;
  policy.build_price = 20;
  // The first part costs 4 more; over the root's area that is 1 more per ray, 1000 per update.
  accounts.charge({14, 10, 8}, areas, policy);
  EXPECT_DOUBLE_EQ(accounts.cost(), 8);
  EXPECT_TRUE(accounts.due(policy).parts.empty());
  accounts.charge({14, 10, 8}, areas, policy);
  DueParts due = accounts.due(policy);  // 2000 = 20 * 100
  EXPECT_EQ(due.parts, std::vector<std::uint32_t>{0});
  EXPECT_FALSE(due.above);
  EXPECT_FALSE(due.all);
  accounts.settle(due, {11, 10, 8}, areas);
  EXPECT_DOUBLE_EQ(accounts.cost(), 7.25);
  accounts.charge({11, 10, 8}, areas, policy);
  EXPECT_TRUE(accounts.due(policy).parts.empty());
  // The whole goes on paying for what the parts could not mend: 2000 so far, then 250, until 8000 are reached.
  for (int i = 0; i < 22; ++i) accounts.charge({11, 10, 8}, areas, policy);
  EXPECT_FALSE(accounts.due(policy).all);
  accounts.charge({11, 10, 8}, areas, policy);
  EXPECT_TRUE(accounts.due(policy).all);
}

}  // namespace
}  // namespace boxwood
