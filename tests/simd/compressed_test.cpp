// Compressed nodes: rounding is outwards, answers are those of brute force to the bit, memory is as small as promised.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "boxwood/error.h"
#include "layout/compressed/packed_leaf-inl.h"
#include "layout/compressed/quantize.h"
#include "layout/compressed/quantized_arena.h"
#include "simd/test_compressed.h"
#include "simd/test_targets.h"
#include "simd/test_trees.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

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

/// Of grids with steps of so many significant bits.
class QuantizeTo : public testing::TestWithParam<int> {};

TEST_P(QuantizeTo, AnyValueInAnyBox_IsEnclosedByItsGridLines) {
  const int bits = GetParam();
  TestRandom random(5);
  for (const Box& box : boxes_to_round()) {
    const Grid grid = grid_over(box, bits);
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

TEST_P(QuantizeTo, Grid_IsLargerThanItsBoxByNoMoreThanItsStepsAreCoarse) {
  const int bits = GetParam();
  for (const Box& box : boxes_to_round()) {
    const Grid grid = grid_over(box, bits);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float size = box.upper[axis] - box.lower[axis];
      if (size < 1e-5f * std::fabs(box.upper[axis]) || size < 1e-25f) continue;  // as fine as floats there
      EXPECT_LT(255 * grid.step[axis], size * (1.01f + std::ldexp(1.0f, 1 - bits)));
    }
  }
}

TEST_P(QuantizeTo, AllStepsOfAGrid_AreFloats) {
  const int bits = GetParam();
  for (const Box& box : boxes_to_round()) {
    const Grid grid = grid_over(box, bits);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (int q = 0; q < 256; ++q) {
        ASSERT_EQ(static_cast<double>(static_cast<float>(q) * grid.step[axis]), q * double{grid.step[axis]});
      }
    }
  }
}

template <class Node>
void expect_keeps_grids() {
  for (const Box& box : boxes_to_round()) {
    const Grid grid = grid_over(box, bits_of_step<Node>);
    Node node;
    set_grid(grid, node);
    const Grid kept = grid_of(node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(kept.origin[axis], grid.origin[axis]);
      ASSERT_EQ(kept.step[axis], grid.step[axis]);
    }
  }
}
TEST(Quantize, Nodes_KeepTheGridsMadeForThem) {
  expect_keeps_grids<QuantizedNode8>();
  expect_keeps_grids<QuantizedNode16>();
}

INSTANTIATE_TEST_SUITE_P(Bits, QuantizeTo, testing::Values(1, 2, 8, 16),
                         [](const auto& test) { return std::to_string(test.param); });

/// What leaves of a compressed tree there are, by the bytes that it may take: packed ones, tight ones, or names, too.
enum class Leaves { by_default, packed, tight, some_named };

template <class Node>
std::size_t least_bytes_without_names(const Tree& tree, const Mesh& mesh) {
  std::size_t bytes = 1;
  while (encode_quantized<Node>(tree, mesh, bytes).view.positions != nullptr) ++bytes;
  return bytes;
}

template <class Node>
std::size_t bytes_for(Leaves leaves, const Tree& tree, const Mesh& mesh) {
  if (leaves == Leaves::by_default) return bytes_per_triangle;
  if (leaves == Leaves::packed) return 64;
  const std::size_t least = least_bytes_without_names<Node>(tree, mesh);
  EXPECT_TRUE(encode_quantized<Node>(tree, mesh, least).view.tight);
  return leaves == Leaves::tight ? least : least - 1;
}

struct CompressedCase {
  const char* scene;
  std::uint32_t width, leaf;
  std::int64_t target;
  Leaves leaves = Leaves::by_default;
};

class CompressedOf : public testing::TestWithParam<CompressedCase> {};

TEST_P(CompressedOf, Answers_HaveTheBitsOfBruteForce) {
  const CompressedCase& c = GetParam();
  const OnlyTarget only(c.target);
  const Scene scene = test_scene(c.scene);
  const Mesh& mesh = scene.meshes.front();
  const Tree tree = test_tree(mesh, c.width, c.leaf);
  const std::size_t bytes =
      c.width == 8 ? bytes_for<QuantizedNode8>(c.leaves, tree, mesh) : bytes_for<QuantizedNode16>(c.leaves, tree, mesh);
  const auto layout = encode_compressed(c.width, tree, mesh, bytes, c.leaves != Leaves::by_default);
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
  const auto targets = testable_targets({HWY_SSE4, HWY_AVX2, HWY_AVX3, HWY_AVX3_DL});
  for (const char* scene : test_scene_names) {
    for (const std::uint32_t width : {8u, 16u}) {
      for (const std::uint32_t leaf : {1u, 8u, 11u, 16u}) out.push_back({scene, width, leaf, targets.back()});
    }
  }
  for (const std::int64_t target : targets) {
    for (const std::uint32_t width : {8u, 16u}) {
      for (const Leaves leaves : {Leaves::packed, Leaves::tight, Leaves::some_named}) {
        out.push_back({"random", width, 6, target, leaves});
        out.push_back({"grid", width, 6, target, leaves});
      }
    }
  }
  return out;
}

std::string name_of(const CompressedCase& c) {
  constexpr const char* forms[] = {"", "_packed", "_tight", "_named"};
  return std::string(c.scene) + "_width" + std::to_string(c.width) + "_leaf" + std::to_string(c.leaf) + "_" +
         hwy::TargetName(c.target) + forms[static_cast<std::size_t>(c.leaves)];
}

INSTANTIATE_TEST_SUITE_P(All, CompressedOf, testing::ValuesIn(compressed_cases()),
                         [](const auto& test) { return name_of(test.param); });

TEST(Compressed, Bytes_AreAtMostTwentyPerTriangle) {
  const Scene scene = test_scene("grid");
  const Mesh& mesh = scene.meshes.front();
  for (const std::uint32_t width : {8u, 16u}) {
    const auto layout = encode_compressed(width, test_tree(mesh, width, 8), mesh);
    EXPECT_LE(layout->bytes(), 20 * mesh.triangles.size());
  }
}

/// A mesh of triangles one after the other, and a leaf that has them all.
Mesh separate_triangles(std::span<const Vec3> corners) {
  Mesh mesh;
  mesh.positions.assign(corners.begin(), corners.end());
  for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

std::array<std::uint32_t, 3> bits_of(const Vec3& p) { return std::bit_cast<std::array<std::uint32_t, 3>>(p); }

/// Every part of a packed leaf as the kernels of one instruction set unpack it. Its triangles come in ascending order.
void expect_unpacks(const Mesh& mesh, std::vector<std::uint32_t> names, bool tight) {
  std::size_t done = 0;
  std::ranges::sort(names);
  for_each_packed(names, mesh, tight, [&](const OwnCorners& part, bool more) {
    std::vector<std::uint32_t> words(part.words() + words_at_once);
    part.pack(words.data(), more);
    LeafBlock<8> block;
    if (tight)
      HWY_NAMESPACE::unpack_tight_leaf(words.data(), block);
    else
      HWY_NAMESPACE::unpack_leaf(words.data(), block);
    HWY_NAMESPACE::SpreadHead spread;
    spread.take(words.data());
    const PackedLeafHead head(words[0]);
    ASSERT_EQ(words_of_packed(words.data()), part.words());
    ASSERT_LE(head.corners, most_packed_corners);
    ASSERT_EQ((block.primitives[0] & more_blocks) != 0, more);
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const bool used = lane < part.triangles();
      const std::uint32_t name = names[done + (used ? lane : 0)];
      ASSERT_EQ(used ? block.primitives[lane] & ~more_blocks : name, name);
      if (used) {
        ASSERT_EQ(
            HWY_NAMESPACE::number_of_packed(tight ? spread.words : words.data(), static_cast<std::uint32_t>(lane)),
            name);
      }
      const auto corner = [&](std::size_t vertex) {
        const auto& of_axes = block.vertices[vertex];
        return bits_of({of_axes[0][lane], of_axes[1][lane], of_axes[2][lane]});
      };
      for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        // Those that are missing are points.
        const auto expected = used ? bits_of(mesh.positions[mesh.triangles[name][vertex]]) : corner(0);
        ASSERT_EQ(corner(vertex), expected) << "lane " << lane << " vertex " << vertex;
      }
    }
    done += part.triangles();
  });
  ASSERT_EQ(done, names.size());
}

void expect_unpacks(const Mesh& mesh, const std::vector<std::uint32_t>& names) {
  for (const bool tight : {false, true}) ASSERT_NO_FATAL_FAILURE(expect_unpacks(mesh, names, tight)) << tight;
}

std::size_t words_of(const Mesh& mesh, std::span<const std::uint32_t> names, bool tight) {
  std::size_t words = 0;
  for_each_packed(names, mesh, tight, [&](const OwnCorners& part, bool) { words += part.words(); });
  return words;
}

TEST(PackedLeaf, AnyTriangles_ComeBackToTheBit) {
  TestRandom random(11);
  for (int n = 0; n < 2000; ++n) {
    const float place = std::ldexp(1.0f, static_cast<int>(random.between(-40, 39)));
    const float size = std::ldexp(place, -static_cast<int>(random.between(0, 30)));
    const Vec3 center = random.point(-place, place);
    std::vector<Vec3> corners(3 * static_cast<std::size_t>(random.between(1, most_triangles_in_parts + 1)));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i] = i > 2 && n % 3 != 0 && random.between(0, 1) < 0.7f ? corners[i - 1 - i / 2]
                                                                      : center + random.point(-size, size);
      if (n % 5 == 0) corners[i].y = -0.0f;
      if (n % 7 == 0) corners[i].x *= i % 2 == 0 ? 1e-30f : -1;
      if (n % 4 == 1) corners[i].z = center.z * std::floor(random.between(0, 2.99f));  // one value, or two and zero
    }
    const Mesh mesh = separate_triangles(corners);
    std::vector<std::uint32_t> names;
    for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
      if (n % 2 == 0 || i == 0 || random.between(0, 1) < 0.6f) names.push_back(static_cast<std::uint32_t>(i));
    }
    ASSERT_NO_FATAL_FAILURE(expect_unpacks(mesh, names)) << n;
  }
}

TEST(PackedLeaf, Tight_KeepsValuesThatRepeatOnce) {
  std::vector<std::uint32_t> names = {0, 1, 2, 3};
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    for (const float least : {0.0f, -0.0f, 0.3f}) {
      std::vector<Vec3> corners(12);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = {std::sqrt(static_cast<float>(i)), std::cbrt(static_cast<float>(i)),
                      1.0f / static_cast<float>(i + 1)};
        corners[i][axis] = i % 3 == 0 ? least : i % 3 == 1 ? 1e-7f : 0.7f;
      }
      const Mesh mesh = separate_triangles(corners);
      expect_unpacks(mesh, names);
      // Nine values of 22 bits or more are not kept, for which there are two bytes; zero is none to keep.
      EXPECT_LE(words_of(mesh, names, true) + 5, words_of(mesh, names, false)) << axis << " " << least;
    }
  }
}

TEST(PackedLeaf, Tight_HasIndicesOfThePairsThatAreThere) {
  const std::vector<Vec3> corners = {{1, 2, 3}, {2, 3, 1}, {3, 1, 2}};
  const Mesh mesh = separate_triangles(corners);
  for (std::uint32_t count = 1; count <= 8; ++count) {
    const std::vector<std::uint32_t> names(count, 0);
    expect_unpacks(mesh, names);
    for_each_packed(names, mesh, true, [&](const OwnCorners& part, bool) {
      std::vector<std::uint32_t> words(part.words());
      part.pack(words.data(), false);
      EXPECT_EQ(PackedLeafHead(words[0]).pairs, (count + 1) / 2);
    });
  }
}

TEST(PackedLeaf, OfSeventeenCornersAndMore_HasParts) {
  std::vector<Vec3> corners(24);
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = {static_cast<float>(i), 1, 2};
  const Mesh mesh = separate_triangles(corners);
  const std::vector<std::uint32_t> names = {0, 1, 2, 3, 4, 5, 6, 7};
  std::vector<std::size_t> parts;
  for_each_packed(names, mesh, false, [&](const OwnCorners& part, bool) { parts.push_back(part.triangles()); });
  EXPECT_EQ(parts, (std::vector<std::size_t>{5, 3}));
  expect_unpacks(mesh, names);
}

TEST(PackedLeaf, OfOneTriangleManyTimes_HasItsCornersOnce) {
  const std::vector<Vec3> corners = {{1, 2, 3}, {1, 2, 3}, {4, 5, 6}};  // a line
  const Mesh mesh = separate_triangles(corners);
  const std::vector<std::uint32_t> names(8, 0);
  for_each_packed(names, mesh, false, [&](const OwnCorners& part, bool) {
    std::vector<std::uint32_t> words(part.words());
    part.pack(words.data(), false);
    EXPECT_EQ(PackedLeafHead(words[0]).corners, 2u);
  });
  expect_unpacks(mesh, names);
}

TEST(Compressed, SeparateTriangles_NameThoseThatNeedMoreThanTwentyBytes) {
  const Scene scene = test_scene("random");
  const Mesh& mesh = scene.meshes.front();
  std::vector<Vec3> corners;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) corners.push_back(mesh.positions[vertex]);
  }
  const Mesh separate = separate_triangles(corners);
  const auto layout = encode_compressed(8, test_tree(separate, 8, 8), separate);
  EXPECT_LE(layout->bytes(), bytes_per_triangle * separate.triangles.size());
  EXPECT_GE(layout->bytes(), (bytes_per_triangle - 1) * separate.triangles.size()) << "what there is room for is used";
}

TEST(Compressed, BytesThatARecipeAllows_AreUsedForCornersOfLeaves) {
  const Mesh mesh = test_scene("random").meshes.front();
  const Tree tree = test_tree(mesh, 16, 8);
  std::size_t before = 0;
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{20}, std::size_t{24}, std::size_t{64}}) {
    const QuantizedArena arena = encode_quantized<QuantizedNode16>(tree, mesh, bytes);
    EXPECT_GT(arena.bytes(), before);
    EXPECT_LE(arena.bytes(), std::max<std::size_t>(bytes, 19) * mesh.triangles.size());
    EXPECT_EQ(arena.view.positions == nullptr, bytes == 64) << "whether kernels look for leaves that name triangles";
    before = arena.bytes();
  }
}

/// Of leaves that hold their own corners and of those that do not: the area for each word that packing adds.
struct Worth {
  std::vector<float> packed, named;
};

/// The same node of both.
void add_worths(const Tree& tree, std::uint32_t of_tree, const QuantizedArena& arena, WideReference reference,
                const Mesh& mesh, Worth& out) {
  const auto* words = reinterpret_cast<const std::uint32_t*>(arena.memory.data());
  const auto& node = *reinterpret_cast<const QuantizedNode16*>(words + (reference >> 1));
  for (std::uint32_t c = 0; c < tree.nodes[of_tree].count; ++c) {
    const std::uint32_t i = tree.nodes[of_tree].first + c;
    const Tree::Node& child = tree.nodes[i];
    if (!child.is_leaf()) {
      add_worths(tree, i, arena, node.children[c], mesh, out);
      continue;
    }
    const std::size_t size = words_of(mesh, std::span(tree.references).subspan(child.first, child.count), true);
    const bool packed = (words[node.children[c] >> 1] & packed_leaf) != 0;
    (packed ? out.packed : out.named).push_back(half_area(child.bounds) / static_cast<float>(size - child.count));
  }
}

TEST(Compressed, LeavesThatNameTheirTriangles_AreThoseThatRaysMeetLeastForTheirSize) {
  const Mesh mesh = test_scene("random").meshes.front();
  const Tree tree = test_tree(mesh, 16, 8);
  const QuantizedArena arena = encode_quantized<QuantizedNode16>(tree, mesh);
  Worth worth;
  add_worths(tree, 0, arena, arena.view.root, mesh, worth);
  ASSERT_FALSE(worth.packed.empty());
  ASSERT_FALSE(worth.named.empty());
  // But for steps of a 64th, and the last leaf that there was room for.
  std::ranges::sort(worth.packed, std::greater<>());
  EXPECT_GE(worth.packed.back() * (1 + 1.0f / 32), std::ranges::max(worth.named));
}

TEST(Compressed, LeavesTooLargeForTheirNode_AreRefusedOrNumbered) {
  const Scene scene = test_scene("random");
  const Mesh& mesh = scene.meshes.front();
  EXPECT_FALSE(fits_eight(test_tree(mesh, 2, 400)));
  EXPECT_TRUE(fits_eight(test_tree(mesh, 2, 20)));
  EXPECT_THROW(encode_compressed(8, test_tree(mesh, 2, 400), mesh), UsageError);
  EXPECT_NO_THROW(encode_compressed(16, test_tree(mesh, 2, 400), mesh));
}

}  // namespace
}  // namespace boxwood
