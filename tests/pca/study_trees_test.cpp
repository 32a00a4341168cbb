// Trees of the PCA study's methods, on any input and against the rules of its description.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "stages.h"
#include "tree/child_axis.h"
#include "tree/split_cost.h"
#include "tree/statistics.h"
#include "tree/validate.h"

namespace boxwood {
namespace {

const std::vector<std::string>& calls() {
  static const std::vector<std::string> all = {"pca",
                                               "pca(order=faithful)",
                                               "pca(split=middle)",
                                               "pca(axis=all, bins=32)",
                                               "pca(cost=interior-fast, centroid=mean)",
                                               "pca(coincident=leaf, order=faithful)",
                                               "pca(stop=count, leaf=8)",
                                               "combined",
                                               "combined(cost=overlap(disjoint=published))",
                                               "pca(cost=overlap)",
                                               "combined(order=faithful)",
                                               "combined(axis=all)",
                                               "distance",
                                               "distance(order=faithful, coincident=leaf)",
                                               "hlbvh",
                                               "hlbvh(leaf=1)",
                                               "binned(bins=12, axis=longest, pairs=on, exact=0, coincident=leaf)"};
  return all;
}

TEST(StudyTree, OfAnyInput_IsValid) {
  for (const std::string& call : calls()) {
    for (const NamedBoxes& input : named_boxes()) {
      const Tree tree = build_study_tree(call, input.boxes);
      EXPECT_EQ(validate(tree, input.boxes, 2), "") << call << " over " << input.name;
      EXPECT_LT(statistics(tree).max_depth, 132u) << call << " over " << input.name;
    }
  }
}

bool same(const Tree& a, const Tree& b) {
  const auto same_node = [](const Tree::Node& x, const Tree::Node& y) {
    return x.bounds == y.bounds && x.first == y.first && x.count == y.count && x.leaf == y.leaf && x.axis == y.axis;
  };
  return a.references == b.references &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_node);
}

TEST(StudyTree, ForAnyNumberOfThreads_IsTheSame) {
  const std::vector<Box> boxes = random_boxes(150000, 0.01f);
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const std::string call : {"pca", "combined", "distance", "hlbvh"}) {
    Tree one, many;
    tbb::task_arena(1).execute([&] { one = build_study_tree(call, boxes); });
    tbb::task_arena(8).execute([&] { many = build_study_tree(call, boxes); });
    EXPECT_TRUE(same(one, many)) << call;
  }
}

TEST(StudyTree, InCorrectedOrder_ChildrenAscendWhereTheyLieFurthestApart) {
  const std::vector<Box> boxes = random_boxes(800);
  for (const std::string call : {"pca", "pca(split=middle)", "combined", "distance"}) {
    const Tree tree = build_study_tree(call, boxes);
    for (const Tree::Node& node : tree.nodes) {
      if (node.is_leaf()) continue;
      const ChildAxis axis = child_axis(tree.nodes[node.first].bounds, tree.nodes[node.first + 1].bounds);
      EXPECT_EQ(node.axis, axis.axis) << call;
      EXPECT_FALSE(axis.descending) << call;
    }
  }
}

TEST(StudyTree, InFaithfulOrder_HoldsTheSameNodes) {
  const std::vector<Box> boxes = random_boxes(800);
  for (const std::string builder : {"pca", "combined", "distance"}) {
    const Tree faithful = build_study_tree(builder + "(order=faithful)", boxes);
    const Tree corrected = build_study_tree(builder, boxes);
    EXPECT_EQ(faithful.references, corrected.references) << builder;
    ASSERT_EQ(faithful.nodes.size(), corrected.nodes.size()) << builder;
    EXPECT_NEAR(sah_cost(faithful), sah_cost(corrected), 1e-9) << builder;
    std::size_t other_order = 0;
    for (std::size_t i = 0; i < faithful.nodes.size(); ++i) {
      other_order += faithful.nodes[i].axis != corrected.nodes[i].axis ? 1 : 0;
    }
    EXPECT_GT(other_order, faithful.nodes.size() / 20) << builder;
  }
}

/// The children's primitives as a set of two sets.
std::vector<std::vector<std::uint32_t>> parts_of_root(const Tree& tree) {
  const std::uint32_t first = tree.nodes[0].first;
  std::vector parts{primitives_below(tree, first), primitives_below(tree, first + 1)};
  std::sort(parts.begin(), parts.end());
  return parts;
}

Vec3 turned(const Vec3& p) {
  constexpr float c = 0.6f, s = 0.8f;  // about z, then about x
  const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x, c * q.y - s * q.z, s * q.y + c * q.z};
}

TEST(PcaMiddle, OfTurnedPoints_PartsThemAlike) {
  std::vector<Box> points = random_boxes(200, 0), other = points;
  for (Box& box : points) box.lower = box.upper = box.lower * Vec3{5, 1, 2};
  for (std::size_t i = 0; i < points.size(); ++i) other[i].lower = other[i].upper = turned(points[i].lower);
  EXPECT_EQ(parts_of_root(build_study_tree("pca(split=middle)", points)),
            parts_of_root(build_study_tree("pca(split=middle)", other)));
  EXPECT_NE(parts_of_root(build_study_tree("middle", points)), parts_of_root(build_study_tree("middle", other)));
}

TEST(Pca, OfAGridAlongTheAxes_CostsWhatTheClassicalTreeCosts) {
  std::vector<Box> boxes;
  for (int x = 0; x < 11; ++x) {
    for (int y = 0; y < 7; ++y) {
      for (int z = 0; z < 3; ++z) {
        const Vec3 at{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        boxes.push_back({at, at + Vec3{0.5f, 0.5f, 0.5f}});
      }
    }
  }
  const Tree classical = build_study_tree("binned(bins=12, axis=longest, pairs=on, exact=0)", boxes);
  EXPECT_NEAR(split_price(build_study_tree("pca", boxes), 0), split_price(classical, 0), 1e-3);
}

TEST(Pca, OfThinDiagonalRows_SplitsThemCheaper) {
  // Two parallel rows of points along (1, 1, 0): no cut along an axis parts them.
  std::vector<Box> boxes;
  for (int i = 0; i < 64; ++i) {
    const auto t = static_cast<float>(i);
    boxes.push_back({{t, t, 0}, {t, t, 0.1f}});
    boxes.push_back({{t + 200, t - 200, 0}, {t + 200, t - 200, 0.1f}});
  }
  const auto parts = parts_of_root(build_study_tree("pca", boxes));
  EXPECT_EQ(parts[0].size(), 64u);
  EXPECT_EQ(parts[0][1] % 2, parts[0][0] % 2);
}

TEST(Combined, AtEveryNode_CostsNoMoreThanTheClassicalCut) {
  const std::vector<Box> boxes = random_boxes(400, 0.3f);
  const Tree tree = build_study_tree("combined(leaf=1)", boxes);
  std::size_t cheaper = 0;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    if (tree.nodes[i].is_leaf()) continue;
    const std::vector<std::uint32_t> below = primitives_below(tree, i);
    if (below.size() <= 2) continue;
    const Tree classical = build_study_tree("binned(bins=12, axis=longest, exact=0, leaf=1)", subset(boxes, below));
    EXPECT_LE(split_price(tree, i), split_price(classical, 0) * 1.00001);
    cheaper += split_price(tree, i) < split_price(classical, 0) * 0.999 ? 1 : 0;
  }
  EXPECT_GT(cheaper, 20u);
}

TEST(SplitCost, SumsEveryNodesOwn) {
  const std::vector<Box> boxes = random_boxes(300);
  const Tree tree = build_study_tree("binned", boxes);
  double sum = 0;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) sum += tree.nodes[i].is_leaf() ? 0 : 1 + split_price(tree, i);
  EXPECT_NEAR(split_cost_sum(tree), sum, 1e-6 * sum);
  EXPECT_EQ(split_cost_sum({}), 0);
  // Points have no area: every probability is 1, so a node counts 1 and its references.
  const Tree points = build_study_tree("middle", std::vector<Box>(4, Box{{1, 1, 1}, {1, 1, 1}}));
  EXPECT_EQ(split_cost_sum(points), 3 + 4 + 2 + 2);
}

TEST(Coincident, AsOneLeaf_HoweverMany) {
  const std::vector<Box> boxes(50, Box{{1, 2, 3}, {2, 3, 4}});
  for (const std::string builder : {"pca", "combined", "distance", "binned", "middle", "equal"}) {
    EXPECT_EQ(build_study_tree(builder + "(coincident=leaf)", boxes).nodes.size(), 1u) << builder;
    EXPECT_GT(build_study_tree(builder, boxes).nodes.size(), 1u) << builder;
  }
}

}  // namespace
}  // namespace boxwood
