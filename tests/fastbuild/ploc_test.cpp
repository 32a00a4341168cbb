#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "build/morton/morton_order.h"
#include "build/morton/radix_sort.h"
#include "fastbuild/trees.h"

namespace boxwood {
namespace {

TEST(RadixSort, RandomKeys_SortedByHighBitsAndOtherwiseUnmoved) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u, 400000u}) {
    RawArray<std::uint64_t> keys(count);
    Random random(count);
    for (std::uint64_t& key : std::span<std::uint64_t>(keys))
      key = (std::uint64_t{random.bits()} << 32 | random.bits()) >> random.below(40);
    std::vector<std::uint64_t> expected(keys.data(), keys.data() + count);
    std::ranges::stable_sort(expected, {}, [](std::uint64_t key) { return key >> 20; });
    radix_sort(keys, 20);
    EXPECT_TRUE(std::ranges::equal(std::span<const std::uint64_t>(keys), expected)) << count << " keys";
  }
}

TEST(MortonOrder, AnyBoxes_EachOnceInOrderOfCodes) {
  const Triangles triangles("scattered", scattered(5000, 0.1f));
  const LargeVector<Reference> references = triangles.input().references;
  for (const unsigned bits : {3u, 30u, 60u}) {
    const MortonOrder order = morton_order(references, bits);
    std::vector<bool> seen(references.size());
    for (std::size_t i = 0; i < references.size(); ++i) {
      EXPECT_FALSE(seen[order.reference(i)]);
      seen[order.reference(i)] = true;
      EXPECT_TRUE(i == 0 || order.keys[i - 1] < order.keys[i]);
    }
  }
}

TEST(MortonOrder, CentersInOctants_GroupedByOctant) {
  LargeVector<Reference> references;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Vec3 at{static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2 & 1)};
    references.push_back({at, i, at});
  }
  const MortonOrder order = morton_order(references, 30);
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t octant = order.reference(i) & 7;
    EXPECT_EQ((octant & 1) * 4 + (octant & 2) + (octant >> 2), i / 8);
  }
}

TEST(Ploc, Surface_NotMuchWorseThanBinned) {
  const Triangles triangles("surface", surface(100));
  EXPECT_LT(sah_cost(build_tree("ploc", triangles)), 1.10 * sah_cost(build_tree("binned", triangles)));
}

TEST(Ploc, LeafSize_IsALimitAndLeavesPay) {
  const Triangles triangles("scattered", scattered(3000, 0.05f));
  for (const std::uint32_t leaf : {1u, 2u, 8u}) {
    const Tree tree = build_tree("ploc(leaf=" + std::to_string(leaf) + ")", triangles);
    for (const Tree::Node& node : tree.nodes) {
      EXPECT_TRUE(!node.is_leaf() || node.count <= leaf);
    }
    EXPECT_LE(sah_cost(tree), sah_cost(build_tree("ploc(leaf=1)", triangles)));
  }
}

TEST(Ploc, RunsOfTheCurve_GroupReferencesAtLittleCost) {
  const Triangles triangles("surface", surface(100));
  const Tree alone = build_tree("ploc(block=4)", triangles), runs = build_tree("ploc(block=4, run=4)", triangles);
  EXPECT_NE(alone.references, runs.references);
  EXPECT_LT(sah_cost(runs), 1.15 * sah_cost(alone));
  for (const Tree::Node& node : runs.nodes) EXPECT_TRUE(!node.is_leaf() || node.count <= 4);
}

/// Boxes of inner nodes and of leaves, sorted: what a tree is, whatever its order in memory.
std::vector<std::array<float, 7>> boxes_of(const Tree& tree) {
  std::vector<std::array<float, 7>> out;
  for (const Tree::Node& node : tree.nodes) {
    const auto& [lower, upper] = node.bounds;
    out.push_back({lower.x, lower.y, lower.z, upper.x, upper.y, upper.z, static_cast<float>(node.count)});
  }
  std::ranges::sort(out);
  return out;
}

TEST(Ploc, WidthInOneBlock_IsCollapse) {
  const Triangles triangles("scattered", scattered(1500, 0.05f));
  for (const std::string k : {"3", "8", "16"}) {
    EXPECT_EQ(boxes_of(build_tree("ploc(block=4, run=4, width=" + k + ")", triangles)),
              boxes_of(build_tree("ploc(block=4, run=4) > collapse(" + k + ")", triangles)));
  }
}

TEST(Ploc, Width_IsALimitAndCostsAboutWhatCollapseGives) {
  const Triangles triangles("surface", surface(100));
  const Tree wide = build_tree("ploc(width=8)", triangles), collapsed = build_tree("ploc > collapse(8)", triangles);
  for (const Tree::Node& node : wide.nodes) EXPECT_TRUE(node.is_leaf() || node.count <= 8);
  EXPECT_LT(sah_cost(wide), 1.05 * sah_cost(collapsed));
}

TEST(Ploc, Groups_CostLittleAndKeepTheWidth) {
  const Triangles triangles("surface", surface(100));
  const Tree single = build_tree("ploc(block=4, run=4, width=8)", triangles);
  for (const std::uint32_t group : {2u, 5u, 8u}) {
    const Tree grouped = build_tree("ploc(block=4, run=4, group=" + std::to_string(group) + ", width=8)", triangles);
    EXPECT_NE(grouped.references, single.references);
    EXPECT_LT(sah_cost(grouped), 1.15 * sah_cost(single)) << group;
    for (const Tree::Node& node : grouped.nodes) EXPECT_TRUE(node.is_leaf() || node.count <= 8);
  }
}

TEST(Ploc, Slack_MakesFewerLeaves) {
  const Triangles triangles("surface", surface(100));
  const auto leaves = [&](const std::string& slack) {
    return statistics(build_tree("ploc(leaf=4, run=4, block=4, group=8, width=8, slack=" + slack + ")", triangles))
        .leaves;
  };
  EXPECT_LT(leaves("1.5"), leaves("1"));
  EXPECT_LT(leaves("4"), leaves("1.5"));
}

TEST(Ploc, BlocksOfFour_FillLeaves) {
  const Triangles triangles("surface", surface(50));
  const TreeStatistics single = statistics(build_tree("ploc(leaf=4)", triangles));
  const TreeStatistics blocks = statistics(build_tree("ploc(leaf=4, block=4)", triangles));
  EXPECT_LT(blocks.leaves, single.leaves);
}

}  // namespace
}  // namespace boxwood
