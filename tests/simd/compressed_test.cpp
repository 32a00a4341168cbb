// Compressed nodes: rounding is outwards, answers are those of brute force to the bit, memory is as small as promised.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "boxwood/error.h"
#include "layout/compressed/compressed_kernels.h"
#include "layout/compressed/quantize.h"
#include "layout/compressed/quantized_arena.h"
#include "layout/simd/simd_layout.h"
#include "simd/test_targets.h"
#include "simd/test_trees.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

std::shared_ptr<const Layout> encode(std::uint32_t width, const Tree& tree, const Mesh& mesh) {
  using Compressed = SimdLayout<QuantizedArena>;
  if (width == 8) {
    return std::make_shared<Compressed>(encode_quantized<QuantizedNode8>(tree, mesh), compressed_kernels<8>());
  }
  return std::make_shared<Compressed>(encode_quantized<QuantizedNode16>(tree, mesh), compressed_kernels<16>());
}

/// Boxes of every size and place: flat ones, far ones, ones that one float step bounds.
std::vector<Box> boxes_to_round() {
  TestRandom random(3);
  std::vector<Box> out;
  for (int i = 0; i < 3000; ++i) {
    const float place = std::ldexp(1.0f, static_cast<int>(random.between(-40, 39)));
    const float size = std::ldexp(1.0f, static_cast<int>(random.between(-60, 39)));
    Box box;
    box.grow(random.point(-place, place));
    Vec3 other = box.lower + random.point(-size, size);
    if (i % 5 == 0) other.y = box.lower.y;
    if (i % 7 == 0) other.z = std::nextafter(box.lower.z, 2 * place);
    box.grow(other);
    out.push_back(box);
  }
  return out;
}

TEST(Quantize, AnyValueInAnyBox_IsEnclosedByItsGridLines) {
  TestRandom random(5);
  for (const Box& box : boxes_to_round()) {
    const Grid grid = grid_over(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_GE(grid.at(axis, 255), box.upper[axis]);
      for (int i = 0; i < 20; ++i) {
        const float part = random.between(0, 1);
        const float between = box.lower[axis] + (box.upper[axis] - box.lower[axis]) * part;
        const float value = i == 0   ? box.lower[axis]
                            : i == 1 ? box.upper[axis]
                                     : std::clamp(between, box.lower[axis], box.upper[axis]);
        const std::uint8_t low = round_down(grid, axis, value), high = round_up(grid, axis, value);
        ASSERT_LE(grid.at(axis, low), value);
        ASSERT_GE(grid.at(axis, high), value);
        ASSERT_LE(high - low, 1) << "no wider than a step";
      }
    }
  }
}

TEST(Quantize, Grid_IsAtMostTwiceAsLargeAsItsBox) {
  for (const Box& box : boxes_to_round()) {
    const Grid grid = grid_over(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float size = box.upper[axis] - box.lower[axis];
      if (size < 1e-6f * std::fabs(box.upper[axis]) || size < 1e-25f) continue;  // as fine as floats there
      EXPECT_LT(std::ldexp(255.0f, grid.exponent[axis]), 2.01f * size);
    }
  }
}

struct CompressedCase {
  const char* scene;
  std::uint32_t width, leaf;
  std::int64_t target;
};

class CompressedOf : public testing::TestWithParam<CompressedCase> {};

TEST_P(CompressedOf, Answers_HaveTheBitsOfBruteForce) {
  const CompressedCase& c = GetParam();
  const OnlyTarget only(c.target);
  const Scene scene = test_scene(c.scene);
  const auto layout = encode(c.width, test_tree(scene.meshes.front(), c.width, c.leaf), scene.meshes.front());
  const std::vector<Ray> rays = test_rays(scene);
  std::vector<Hit> expected(rays.size()), single(rays.size()), batch(rays.size()), counted(rays.size());
  BruteForce(scene).closest_hits(rays, expected);
  for (std::size_t i = 0; i < rays.size(); ++i) single[i] = layout->closest_hit(rays[i]);
  layout->closest_hits(rays, batch);
  std::vector<RayCounters> counters(rays.size());
  layout->closest_hits_counted(rays, counted, counters);
  EXPECT_EQ(first_difference(expected, single), rays.size()) << "single rays";
  EXPECT_EQ(first_difference(expected, batch), rays.size()) << "batch";
  EXPECT_EQ(first_difference(expected, counted), rays.size()) << "counted";

  std::vector<std::uint8_t> blocked(rays.size(), 7);
  layout->any_hits(rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(layout->any_hit(rays[i]), expected[i].valid()) << "ray " << i;
    ASSERT_EQ(blocked[i] != 0, expected[i].valid()) << "ray " << i << " of the batch";
  }
}

std::vector<CompressedCase> compressed_cases() {
  std::vector<CompressedCase> out;
  const auto targets = testable_targets();
  for (const char* scene : test_scene_names) {
    for (const std::uint32_t width : {8u, 16u}) {
      for (const std::uint32_t leaf : {1u, 8u, 11u}) out.push_back({scene, width, leaf, targets.back()});
    }
  }
  for (const std::int64_t target : targets) {
    for (const std::uint32_t width : {8u, 16u}) out.push_back({"random", width, 6, target});
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, CompressedOf, testing::ValuesIn(compressed_cases()), [](const auto& test) {
  return std::string(test.param.scene) + "_width" + std::to_string(test.param.width) + "_leaf" +
         std::to_string(test.param.leaf) + "_" + hwy::TargetName(test.param.target);
});

TEST(Compressed, Bytes_AreAtMostTwentyPerTriangle) {
  const Scene scene = test_scene("grid");
  const Mesh& mesh = scene.meshes.front();
  for (const std::uint32_t width : {8u, 16u}) {
    const auto layout = encode(width, test_tree(mesh, width, 8), mesh);
    EXPECT_LE(layout->bytes(), 20 * mesh.triangles.size());
  }
}

TEST(Compressed, LeavesTooLargeForTheirNode_AreRefusedOrNumbered) {
  const Scene scene = test_scene("random");
  const Mesh& mesh = scene.meshes.front();
  EXPECT_FALSE(fits_eight(test_tree(mesh, 2, 400)));
  EXPECT_TRUE(fits_eight(test_tree(mesh, 2, 20)));
  EXPECT_THROW(encode(8, test_tree(mesh, 2, 400), mesh), UsageError);
  EXPECT_NO_THROW(encode(16, test_tree(mesh, 2, 400), mesh));
}

}  // namespace
}  // namespace boxwood
