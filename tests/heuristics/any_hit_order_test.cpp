// The order of children for any-hit rays: the cheapest to expect, and only an order.
#include "tree/any_hit_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "boxwood/boxwood.h"
#include "structure/mesh_geometry.h"
#include "structure/pipeline.h"
#include "support/scenes.h"
#include "support/trees.h"
#include "tree/validate.h"

namespace boxwood::test {
namespace {

/// By the words of the docstring, from the leaves up: what a ray may expect of a node.
struct Expected {
  double blocked = 0.25, cost = 1;
};

Expected expected_of(const Tree& tree, std::uint32_t n) {
  const Tree::Node& node = tree.nodes[n];
  if (node.is_leaf()) return {};
  double open = 1, cost = 1;
  for (std::uint32_t c = node.first + node.count; c-- > node.first;) {
    const Expected child = expected_of(tree, c);
    const double met = half_area(tree.nodes[c].bounds) / half_area(node.bounds);
    cost += open * met * child.cost;
    open *= 1 - met * child.blocked;
  }
  return {1 - open, cost};
}

Tree wide_tree(const Scene& scene) {
  const MeshGeometry geometry(scene.meshes[0]);
  return Pipeline(Recipe::parse("binned > collapse(4) > wide(4)")).tree({geometry.references(), &geometry, nullptr});
}

/// Nodes by what is in them, wherever they lie.
std::vector<std::pair<std::uint32_t, float>> contents_of(const Tree& tree) {
  std::vector<std::pair<std::uint32_t, float>> out;
  for (const Tree::Node& node : tree.nodes) out.emplace_back(node.first << 1 | node.leaf, half_area(node.bounds));
  std::ranges::sort(out);
  return out;
}

TEST(AnyHitOrder, EveryNode_NoOtherOrderOfItsChildrenCostsLess) {
  Tree tree = wide_tree(soup(300, 0.3f, 1));
  order_for_any_hits(tree);
  std::size_t looked_at = 0;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Tree::Node node = tree.nodes[n];
    if (node.is_leaf() || node.count > 5) continue;
    const double cost = expected_of(tree, n).cost;
    const auto first = tree.nodes.begin() + node.first;
    const std::vector<Tree::Node> kept(first, first + node.count);
    std::vector<std::uint32_t> order(node.count);
    std::iota(order.begin(), order.end(), 0u);
    while (std::ranges::next_permutation(order).found) {
      for (std::uint32_t c = 0; c < node.count; ++c) first[c] = kept[order[c]];
      EXPECT_GE(expected_of(tree, n).cost, cost * (1 - 1e-5)) << "node " << n;
    }
    std::ranges::copy(kept, first);
    ++looked_at;
  }
  EXPECT_GT(looked_at, 20u);
}

TEST(AnyHitOrder, Tree_StaysValidWithTheSameNodes) {
  Tree tree = wide_tree(soup(300, 0.3f, 2));
  const Tree before = tree;
  order_for_any_hits(tree);
  EXPECT_EQ(contents_of(tree), contents_of(before));
  EXPECT_EQ(tree.references, before.references);
  const Scene scene = soup(300, 0.3f, 2);
  const MeshGeometry geometry(scene.meshes[0]);
  std::vector<Box> boxes;
  for (const Reference& reference : geometry.references()) boxes.push_back(reference.box());
  EXPECT_EQ(validate(tree, boxes), "");
}

TEST(AnyHitOrder, OctreeInWideNodes_StaysValid) {
  const Scene scene = soup(300, 0.3f, 5);
  const MeshGeometry geometry(scene.meshes[0]);
  std::vector<Box> boxes;
  for (const Reference& reference : geometry.references()) boxes.push_back(reference.box());
  for (const std::string layout : {"wide(8)", "compressed(8)"}) {
    EXPECT_EQ(validate(tree_of(scene.meshes[0], Recipe::parse("octree > " + layout)), boxes), "") << layout;
  }
}

TEST(AnyHitOrder, FixedOrder_IsLeftAlone) {
  Tree tree = wide_tree(soup(300, 0.3f, 3));
  for (Tree::Node& node : tree.nodes) node.fixed_order = node.is_leaf() ? 0 : 1;
  const Tree before = tree;
  order_for_any_hits(tree);
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    EXPECT_EQ(tree.nodes[n].first, before.nodes[n].first);
    EXPECT_EQ(tree.nodes[n].axis, before.nodes[n].axis);
  }
}

TEST(AnyHitOrder, WallInFrontOfMuch_IsLookedAtFirst) {
  // Two thousand small triangles, and a wall below them that all rays meet as well, from either side.
  Scene scene = soup(2000, 0.05f, 4);
  Mesh& mesh = scene.meshes[0];
  const auto corner = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3 at : {Vec3{-4, -4, -1.5f}, Vec3{6, -4, -1.5f}, Vec3{0, 1.1f, -1.5f}}) mesh.positions.push_back(at);
  mesh.triangles.push_back({corner, corner + 1, corner + 2});
  std::vector<Ray> rays;
  for (int i = 0; i < 64; ++i) {
    const float x = 0.1f * static_cast<float>(i % 8), y = -0.9f + 0.1f * static_cast<float>(i / 8);
    rays.push_back({{x, y, -2}, 0, {0, 0, 1}, 10});
    rays.push_back({{x, y, 3}, 0, {0, 0, -1}, 10});
  }
  for (const std::string layout : {"wide(4)", "wide(8)", "compressed(8)"}) {
    const Structure structure = build(scene, "binned > optimal-collapse(4) > " + layout);
    std::vector<std::uint8_t> blocked(rays.size());
    std::vector<RayCounters> counters(rays.size());
    structure.any_hits_counted(rays, blocked, counters);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(blocked[i], 1) << layout;
      EXPECT_LE(counters[i].steps, 2u) << layout << ", ray " << i;
      EXPECT_EQ(counters[i].leaves, 1u) << layout << ", ray " << i;
    }
  }
}

}  // namespace
}  // namespace boxwood::test
