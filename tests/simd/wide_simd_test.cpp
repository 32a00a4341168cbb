// The SIMD kernels give the very bits of the scalar triangle test over all triangles, on every instruction set.
#include "layout/simd/wide_simd.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "layout/simd/wide_arena.h"
#include "math/large_memory.h"
#include "simd/test_targets.h"
#include "simd/test_trees.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

struct Case {
  const char* scene;
  std::uint32_t width;
  std::uint32_t leaf;
  std::int64_t target;
};

class SimdWideOf : public testing::TestWithParam<Case> {
 protected:
  SimdWideOf() : scene_(test_scene(GetParam().scene)), rays_(test_rays(scene_)) {
    const Case& c = GetParam();
    const OnlyTarget only(c.target);
    Contents contents;
    contents.mesh = &scene_.meshes.front();
    layout_ = encode_simd_wide(c.width, test_tree(scene_.meshes.front(), c.width, c.leaf), contents, {});
    const BruteForce brute_force(scene_);
    expected_.resize(rays_.size());
    brute_force.closest_hits(rays_, expected_);
  }

  Scene scene_;
  std::vector<Ray> rays_;
  std::shared_ptr<const Layout> layout_;
  std::vector<Hit> expected_;
};

TEST_P(SimdWideOf, ClosestHits_HaveTheBitsOfBruteForce) {
  std::vector<Hit> hits(rays_.size());
  for (std::size_t i = 0; i < rays_.size(); ++i) hits[i] = layout_->closest_hit(rays_[i]);
  EXPECT_EQ(first_difference(expected_, hits), rays_.size()) << "single rays";
  std::ranges::fill(hits, Hit{1, 2, 3, 4, 5});
  layout_->closest_hits(rays_, hits);
  EXPECT_EQ(first_difference(expected_, hits), rays_.size()) << "batch";
  std::vector<RayCounters> counters(rays_.size());
  layout_->closest_hits_counted(rays_, hits, counters);
  EXPECT_EQ(first_difference(expected_, hits), rays_.size()) << "counted";
}

TEST_P(SimdWideOf, AnyHits_AreThoseOfBruteForce) {
  std::vector<std::uint8_t> expected(rays_.size()), batch(rays_.size(), 7), counted(rays_.size());
  for (std::size_t i = 0; i < rays_.size(); ++i) expected[i] = expected_[i].valid() ? 1 : 0;
  for (std::size_t i = 0; i < rays_.size(); ++i) EXPECT_EQ(layout_->any_hit(rays_[i]), expected[i] != 0) << "ray " << i;
  layout_->any_hits(rays_, batch);
  EXPECT_EQ(batch, expected);
  std::vector<RayCounters> counters(rays_.size());
  layout_->any_hits_counted(rays_, counted, counters);
  EXPECT_EQ(counted, expected);
}

TEST_P(SimdWideOf, BatchOfAnyLength_FillsExactlyItsAnswers) {
  for (const std::size_t length : {0u, 1u, 15u, 16u, 33u, 64u, 127u}) {
    const std::span<const Ray> rays(rays_.data(), length);
    std::vector<Hit> hits(length + 1, Hit{1, 2, 3, 4, 5});
    layout_->closest_hits(rays, {hits.data(), length});
    EXPECT_EQ(first_difference({expected_.data(), length}, {hits.data(), length}), length) << length << " rays";
    EXPECT_EQ(hits[length], (Hit{1, 2, 3, 4, 5}));
    std::vector<std::uint8_t> blocked(length + 1, 7);
    layout_->any_hits(rays, {blocked.data(), length});
    for (std::size_t i = 0; i < length; ++i) EXPECT_EQ(blocked[i], expected_[i].valid() ? 1 : 0);
    EXPECT_EQ(blocked[length], 7);
  }
}

/// Everything on the machine's best instruction set; a part on the others, which emulate fused operations slowly.
std::vector<Case> cases() {
  std::vector<Case> out;
  const std::vector<std::int64_t> targets = testable_targets();
  for (const char* scene : test_scene_names) {
    for (const std::uint32_t width : {4u, 8u, 16u}) {
      for (const std::uint32_t leaf : {1u, 4u, 11u}) out.push_back({scene, width, leaf, targets.back()});
    }
  }
  for (const std::int64_t target : targets) {
    if (target == targets.back()) continue;
    for (const std::uint32_t width : {4u, 8u, 16u}) out.push_back({"grid", width, 4, target});
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, SimdWideOf, testing::ValuesIn(cases()), [](const auto& test) {
  return std::string(test.param.scene) + "_width" + std::to_string(test.param.width) + "_leaf" +
         std::to_string(test.param.leaf) + "_" + hwy::TargetName(test.param.target);
});

TEST(SimdWide, CountsOfOneTriangle_AreOneStepOneLeafOneTest) {
  const Scene scene = test_scene("one_triangle");
  Contents contents;
  contents.mesh = &scene.meshes.front();
  const auto layout = encode_simd_wide(8, test_tree(scene.meshes.front(), 8, 4), contents, {});
  const Ray ray{{0.2f, 0.2f, -1}, 0, {0, 0, 1}};
  Hit hit;
  RayCounters counters{9, 9, 9, 9, 9};
  layout->closest_hits_counted({&ray, 1}, {&hit, 1}, {&counters, 1});
  EXPECT_EQ(counters, (RayCounters{1, 1, 1, 1, 1}));
  EXPECT_EQ(hit.t, 1);
}

/// Saved files and their checksums depend on it.
TEST(SimdWide, Memory_DoesNotDependOnWhatItHeldBefore) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  TestRandom random(3);
  for (int i = 0; i < 50000; ++i) {
    const Vec3 center = random.point(-1, 1);
    add_triangle(positions, triangles, center, center + random.point(0, 0.01f), center + random.point(0, 0.01f));
  }
  Scene scene;
  scene.add_mesh(std::move(positions), std::move(triangles));
  const Mesh& mesh = scene.meshes.front();
  const auto bytes_of = [&]<int N, int L>(std::integral_constant<int, N>, std::integral_constant<int, L>,
                                          std::byte before) {
    constexpr std::size_t dirty = std::size_t{4} << 20;
    std::vector<void*> blocks;
    for (std::size_t i = 1; i < 5; ++i) {
      blocks.push_back(allocate_large(i * dirty));
      std::fill_n(static_cast<std::byte*>(blocks.back()), i * dirty, before);
    }
    for (void* block : blocks) free_large(block);
    const WideArena arena = *encode_wide<N, L>(test_tree(mesh, N, 3), mesh);
    return std::vector<std::byte>(arena.memory.data(), arena.memory.data() + arena.memory.bytes());
  };
  const auto check = [&](auto n, auto l) {
    const auto first = bytes_of(n, l, std::byte{0x55}), second = bytes_of(n, l, std::byte{0xaa});
    EXPECT_GT(first.size(), std::size_t{2} << 20);
    EXPECT_TRUE(first == second) << n;
  };
  check(std::integral_constant<int, 4>(), std::integral_constant<int, 4>());
  check(std::integral_constant<int, 8>(), std::integral_constant<int, 4>());
  check(std::integral_constant<int, 16>(), std::integral_constant<int, 8>());
}

TEST(SimdWide, UnsupportedTrees_AreRefused) {
  const Scene scene = test_scene("random");
  const Mesh& mesh = scene.meshes.front();
  Contents contents;
  contents.mesh = &mesh;
  const Tree tree = test_tree(mesh, 8, 4);
  EXPECT_TRUE(simd_wide_supports(8, tree, contents, {}));
  EXPECT_FALSE(simd_wide_supports(4, tree, contents, {})) << "nodes of eight children";
  EXPECT_FALSE(simd_wide_supports(6, tree, contents, {})) << "no kernel of this width";
  EXPECT_FALSE(simd_wide_supports(8, tree, contents, {ChildOrder::none, true, TraversalMode::iterative}));
  EXPECT_FALSE(simd_wide_supports(8, tree, Contents{}, {})) << "not triangles";
  Tree fixed = tree;
  fixed.nodes[0].fixed_order = 1;
  EXPECT_FALSE(simd_wide_supports(8, fixed, contents, {}));
  for (const std::uint32_t width : {4u, 6u}) EXPECT_EQ(encode_simd_wide(width, tree, contents, {}), nullptr);
  EXPECT_EQ(encode_simd_wide(8, fixed, contents, {}), nullptr);
}

}  // namespace
}  // namespace boxwood
