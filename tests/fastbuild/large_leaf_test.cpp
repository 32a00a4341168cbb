#include <gtest/gtest.h>

#include "fastbuild/trees.h"

namespace boxwood {
namespace {

/// A thousand small triangles around the origin, and two others.
Triangles dust_and(const Corners& first, const Corners& second) {
  std::vector<Corners> all = scattered(1000, 0.01f);
  for (Corners& triangle : all) {
    for (Vec3& corner : triangle) corner = corner * 0.1f;
  }
  all.push_back(first);
  all.push_back(second);
  return {"dust and two", std::move(all)};
}

/// Whether a leaf holds both of the last two triangles.
bool share_a_leaf(const Tree& tree, const Triangles& triangles) {
  const auto last = static_cast<std::uint32_t>(triangles.size() - 1);
  return std::ranges::any_of(tree.nodes, [&](const Tree::Node& node) {
    if (!node.is_leaf()) return false;
    const auto begin = tree.references.begin() + node.first, end = begin + node.count;
    return std::find(begin, end, last) != end && std::find(begin, end, last - 1) != end;
  });
}

const std::string pipelines[] = {"spatial(leaf=8, block=8)", "ploc(leaf=8, block=8)",
                                 "ploc(leaf=8, block=8, run=8, slack=2)"};

TEST(LargeLeaf, FarApart_AreTwoThoughOneBlockHoldsBoth) {
  const Triangles triangles =
      dust_and({{{30, 0, 0}, {30, 1, 0}, {30, 0, 1}}}, {{{60, 60, 60}, {60, 61, 60}, {60, 60, 61}}});
  for (const std::string& pipeline : pipelines) {
    EXPECT_FALSE(share_a_leaf(build_tree(pipeline, triangles), triangles)) << pipeline;
  }
}

TEST(LargeLeaf, FlatOnesOneAboveTheOther_AreTwoThoughSlackWouldJoinThem) {
  // Together the area is 3, apart 2.
  const Triangles triangles =
      dust_and({{{10, 10, 0}, {20, 10, 0}, {10, 20, 0}}}, {{{10, 10, 10}, {20, 10, 10}, {10, 20, 10}}});
  for (const std::string& pipeline : pipelines) {
    EXPECT_FALSE(share_a_leaf(build_tree(pipeline, triangles), triangles)) << pipeline;
  }
}

TEST(LargeLeaf, OnTopOfEachOther_AreOne) {
  const Corners flat = {{{10, 10, 0}, {20, 10, 0}, {10, 20, 0}}};
  const Triangles triangles = dust_and(flat, flat);
  for (const std::string& pipeline : pipelines) {
    EXPECT_TRUE(share_a_leaf(build_tree(pipeline, triangles), triangles)) << pipeline;
  }
}

TEST(LargeLeaf, SceneWithoutArea_HasFullLeaves) {
  std::vector<Corners> points;
  for (int i = 0; i < 64; ++i) {
    const Vec3 point{static_cast<float>(i), 0, 0};
    points.push_back({point, point, point});
  }
  const Triangles triangles("points on a line", std::move(points));
  for (const std::string& pipeline : pipelines) {
    const Tree tree = build_tree(pipeline, triangles);
    const auto leaves = std::ranges::count_if(tree.nodes, [](const Tree::Node& node) { return node.is_leaf(); });
    EXPECT_LE(leaves, 32) << pipeline;
  }
}

}  // namespace
}  // namespace boxwood
