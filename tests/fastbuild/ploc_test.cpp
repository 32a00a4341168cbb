#include <gtest/gtest.h>

#include <algorithm>

#include "build/morton/morton_order.h"
#include "build/morton/radix_sort.h"
#include "fastbuild/trees.h"

namespace boxwood {
namespace {

TEST(RadixSort, RandomKeys_SortedByHighBitsAndOtherwiseUnmoved) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u, 400000u}) {
    std::vector<std::uint64_t> keys(count), scratch(count);
    Random random(count);
    for (std::uint64_t& key : keys) key = (std::uint64_t{random.bits()} << 32 | random.bits()) >> random.below(40);
    std::vector<std::uint64_t> expected = keys;
    std::ranges::stable_sort(expected, {}, [](std::uint64_t key) { return key >> 20; });
    radix_sort(keys, scratch, 20);
    EXPECT_EQ(keys, expected) << count << " keys";
  }
}

TEST(MortonOrder, AnyBoxes_EachOnceInOrderOfCodes) {
  const Triangles triangles("scattered", scattered(5000, 0.1f));
  const std::vector<Reference> references = triangles.input().references;
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
  std::vector<Reference> references;
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

TEST(Ploc, BlocksOfFour_FillLeaves) {
  const Triangles triangles("surface", surface(50));
  const TreeStatistics single = statistics(build_tree("ploc(leaf=4)", triangles));
  const TreeStatistics blocks = statistics(build_tree("ploc(leaf=4, block=4)", triangles));
  EXPECT_LT(blocks.leaves, single.leaves);
}

}  // namespace
}  // namespace boxwood
