// What slab nodes hold, what they take in memory, and that the planes are conservative.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "boxwood/error.h"
#include "layout/slab/slab_planes.h"
#include "layout/slab/split_encode.h"
#include "layout/slab/wide/wide_slab_nodes.h"
#include "support/layouts.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

Tree tree_over(const Scene& scene, std::uint32_t leaf_size = 1, bool marks = false) {
  return test::split_tree(test::triangle_boxes(scene.meshes[0]), {2, leaf_size, marks});
}

TEST(SplitWord, KeepsIndexSideAxisLeafAndFixedOrder) {
  for (const std::uint32_t index : {0u, 1u, 12345u, (1u << 27) - 1}) {
    for (BoxSide side = 0; side < 6; ++side) {
      const auto expect = [&](auto word, bool leaf, bool fixed, std::uint32_t axis) {
        EXPECT_EQ(word.index(), index);
        EXPECT_EQ(word.flags().side(), side);
        EXPECT_EQ(word.flags().is_leaf(), leaf);
        EXPECT_EQ(word.flags().fixed_order(), fixed);
        if (!leaf && !fixed) {
          EXPECT_EQ(word.flags().axis(), axis);
        }
      };
      expect(Word32(index, SplitFlags::leaf(side)), true, false, 0);
      expect(Word64(index, SplitFlags::leaf(side)), true, false, 0);
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        for (const bool fixed : {false, true}) {
          expect(Word32(index, SplitFlags::inner(side, axis, fixed)), false, fixed, axis);
          expect(Word64(index, SplitFlags::inner(side, axis, fixed)), false, fixed, axis);
        }
      }
    }
  }
  EXPECT_EQ(Word64(0xffffffffu, SplitFlags::leaf(5)).index(), 0xffffffffu);
}

TEST(SplitNodes, TakeTwoNMinusOneTimesTheNodeSize) {
  const Scene scene = test::soup(500, 0.2f, 1);
  const Tree tree = tree_over(scene);
  const std::size_t nodes = 2 * 500 - 1;
  EXPECT_EQ(encode_split_nodes<SlabNodes32>(tree, "slab").bytes(), nodes * 8);
  EXPECT_EQ(encode_split_nodes<SlabNodes64>(tree, "slab").bytes(), nodes * 12);
  EXPECT_EQ(encode_split_nodes<BoxNodes32>(tree, "binary-split").bytes(), nodes * 28);
  EXPECT_EQ(encode_split_nodes<BoxNodes64>(tree, "binary-split").bytes(), nodes * 32);
  EXPECT_EQ(encode_split_nodes<SlabNodes32>(tree, "slab").node_count(), nodes);
}

TEST(SplitNodes, LeavesOfSeveralTrianglesCostOneBitPerReference) {
  const Scene scene = test::soup(500, 0.2f, 1);
  const Tree tree = tree_over(scene, 4);
  const std::size_t bytes = encode_split_nodes<SlabNodes32>(tree, "slab").bytes();
  EXPECT_EQ(bytes, tree.nodes.size() * 8 + (500 / 64 + 1) * 8);
}

/// Calls visit(node, box of the tree's node, region its path guarantees) for every node.
template <class Visit>
void walk_regions(const Tree& tree, const SlabNodes32& nodes, const Tree::Node& in_tree, const SlabNode<Word32>& node,
                  Box region, const Visit& visit) {
  side_of(region, node.word.flags().side()) = node.plane;
  visit(node, in_tree, region);
  if (in_tree.is_leaf()) return;
  for (std::uint32_t c = 0; c < 2; ++c) {
    // Nodes of mixed axis may be stored the other way round: the tree of this test has none.
    walk_regions(tree, nodes, tree.nodes[in_tree.first + c], nodes.pairs[2 * node.word.index() + c], region, visit);
  }
}

TEST(SlabNodes, EveryPlaneIsASideOfItsBoxAndRegionsShrinkAroundIt) {
  for (const Scene& scene : {test::soup(300, 0.2f, 7), test::cube(4), test::sphere(8)}) {
    const Tree tree = tree_over(scene);
    const SlabNodes32 nodes = encode_split_nodes<SlabNodes32>(tree, "slab");
    std::size_t seen = 0;
    walk_regions(tree, nodes, tree.nodes[0], nodes.root, nodes.root_box,
                 [&](const SlabNode<Word32>& node, const Tree::Node& in_tree, const Box& region) {
                   ++seen;
                   EXPECT_EQ(node.plane, side_of(in_tree.bounds, node.word.flags().side()));
                   EXPECT_TRUE(region.contains(in_tree.bounds));
                   EXPECT_EQ(node.word.flags().is_leaf(), in_tree.is_leaf());
                   if (in_tree.is_leaf()) {
                     EXPECT_EQ(node.word.index(), in_tree.first);
                   }
                 });
    EXPECT_EQ(seen, tree.nodes.size());
  }
}

TEST(SlabPlanes, TheSideThatCutsMostIsTakenAndTheLastOfEqualOnes) {
  const Box region{{0, 0, 0}, {10, 10, 10}};
  Box cut = region;
  EXPECT_EQ(cut_by_best_side({{0, 6, 0}, {9, 10, 10}}, cut), 2u);  // lower y
  EXPECT_EQ(cut, (Box{{0, 6, 0}, {10, 10, 10}}));
  cut = region;
  EXPECT_EQ(cut_by_best_side(region, cut), 5u);  // all tie
  EXPECT_EQ(cut, region);
}

TEST(SlabPlanes, SurfaceRatioIsOneForASingleNodeAndMoreBelow) {
  EXPECT_EQ(slab_fit(Tree{}).surface_ratio, 0);
  EXPECT_EQ(slab_fit(tree_over(test::soup(1, 0.5f, 1))).surface_ratio, 1);
  EXPECT_GT(slab_fit(tree_over(test::soup(100, 0.2f, 1))).surface_ratio, 1.5);
}

/// What single slabs guarantee of every node.
std::vector<Box> regions_of(const Tree& tree, std::size_t& unchanged) {
  std::vector<Box> regions(tree.nodes.size());
  regions[0] = tree.nodes[0].bounds;
  unchanged = 1;  // the root's plane
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    for (std::uint32_t c = node.first; !node.is_leaf() && c < node.first + node.count; ++c) {
      regions[c] = regions[i];
      cut_by_best_side(tree.nodes[c].bounds, regions[c]);
      unchanged += regions[c] == regions[i] ? 1 : 0;
    }
  }
  return regions;
}

TEST(SlabPlanes, OnlyTheRootsPlaneCutsNothing) {
  for (const Scene& scene : {test::soup(300, 0.2f, 7), test::sphere(8), test::torus(8)}) {
    std::size_t unchanged = 0;
    regions_of(tree_over(scene), unchanged);
    EXPECT_EQ(unchanged, 1u);
  }
}

TEST(SlabPlanes, SurfaceRatioIsNoArtefactOfRounding) {
  const Tree tree = tree_over(test::sphere(16));
  std::size_t unchanged = 0;
  const std::vector<Box> regions = regions_of(tree, unchanged);
  const auto surface = [](const Box& box) {
    const long double x = static_cast<long double>(box.upper.x) - box.lower.x;
    const long double y = static_cast<long double>(box.upper.y) - box.lower.y;
    const long double z = static_cast<long double>(box.upper.z) - box.lower.z;
    return x * y + y * z + z * x;
  };
  long double sum = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) sum += surface(regions[i]) / surface(tree.nodes[i].bounds);
  const auto exact = static_cast<double>(sum / static_cast<long double>(tree.nodes.size()));
  EXPECT_NEAR(slab_fit(tree).surface_ratio / exact, 1, 1e-5);
}

TEST(SlabPlanes, AtLeastHalfOfBothChildrensSidesLieInTheParents) {
  for (const Scene& scene : {test::soup(300, 0.2f, 7), test::sphere(8)}) {
    const Tree tree = tree_over(scene);
    for (const Tree::Node& node : tree.nodes) {
      if (node.is_leaf()) continue;
      int shared = 0;
      for (std::uint32_t c = node.first; c < node.first + 2; ++c) {
        for (BoxSide side = 0; side < 6; ++side) {
          shared += side_of(tree.nodes[c].bounds, side) == side_of(node.bounds, side) ? 1 : 0;
        }
      }
      EXPECT_GE(shared, 6);
    }
  }
}

TEST(WideSlabPlanes, CarryTheirSideAndMoveOutwardByEightUnitsAtMost) {
  Random random(3);
  std::vector<float> values{0.0f, -0.0f, 1e12f, -1e12f, 1e-45f, -1e-45f, 1.0f, -1.0f};
  for (int i = 0; i < 1000; ++i) values.push_back(random.uniform(-100, 100));
  for (const float value : values) {
    for (BoxSide side = 0; side < 6; ++side) {
      const float plane = plane_with_side(value, side);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(plane) & 7, side);
      if (side & 1) {
        EXPECT_GE(plane, value);
      } else {
        EXPECT_LE(plane, value);
      }
      EXPECT_LE(std::fabs(plane - value), std::fabs(value) * 0x1p-19f + 1e-43f);
    }
  }
}

TEST(WideSlab, EightChildrenOfOnePlaneAreACacheLine) {
  const Scene scene = test::soup(512, 0.2f, 1);
  const test::LayoutCall call = test::LayoutCall(wide_slab_stage()).set("k", "8").set("planes", "1");
  const auto layout = test::encode_scene(scene, call, {}, 1, false);
  const std::size_t nodes = 1 + 8 + 64;
  EXPECT_EQ(layout->bytes(), nodes * 64 + 512 * sizeof(LeafTriangle));
}

TEST(SplitNodes, RefuseATreeThatIsNotBinary) {
  const Scene scene = test::soup(64, 0.2f, 1);
  const Tree wide = test::split_tree(test::triangle_boxes(scene.meshes[0]), {4, 1, false});
  EXPECT_THROW(encode_split_nodes<SlabNodes32>(wide, "slab"), UsageError);
}

}  // namespace
}  // namespace boxwood
