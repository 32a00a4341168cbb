// Large batches of rays that start close together, which any-hit queries trace by streams: the answers of the triangle
// test over all triangles, on every instruction set and however deep the tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "layout/simd/wide_simd.h"
#include "simd/test_compressed.h"
#include "simd/test_targets.h"
#include "simd/test_trees.h"
#include "support/trees.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

/// In every direction from a small region, some of them short, parallel to an axis, unlimited at both ends or invalid;
/// more than two blocks of them, so that one is not full.
std::vector<Ray> rays_around(const Vec3& center) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  TestRandom random(23);
  std::vector<Ray> rays;
  for (int i = 0; i < 9001; ++i) {
    Ray ray{center + random.point(-0.01f, 0.01f), 0, random.point(-1, 1), random.between(0, 2)};
    if (i % 37 == 0) ray.direction = {0, -0.0f, i % 2 == 0 ? 1.0f : -1.0f};
    if (i % 41 == 0) ray.t_near = -infinity, ray.t_far = infinity;
    if (i % 43 == 0) ray.direction = {0, 0, 0};
    rays.push_back(ray);
  }
  return rays;
}

/// What any-hit queries of a scene are to answer.
struct Expected {
  explicit Expected(const Scene& scene) : rays(rays_around(scene.bounds().center())) {
    std::vector<Hit> hits(rays.size());
    BruteForce(scene).closest_hits(rays, hits);
    for (const Hit& hit : hits) blocked.push_back(hit.valid() ? 1 : 0);
  }
  void compare(const Layout& layout, const char* what) const {
    std::vector<std::uint8_t> found(rays.size(), 7);
    layout.any_hits(rays, found);
    const auto different = std::ranges::mismatch(found, blocked).in1 - found.begin();
    EXPECT_EQ(different, std::ssize(found)) << "first ray that differs, in " << what;
  }

  std::vector<Ray> rays;
  std::vector<std::uint8_t> blocked;
};

/// On every instruction set that has streams, through plain nodes and packed ones.
void expect_like_brute_force(const Scene& scene, std::uint32_t leaf, const char* what) {
  const Mesh& mesh = scene.meshes.front();
  Contents contents;
  contents.mesh = &mesh;
  const Expected expected(scene);
  for (const std::int64_t target : testable_targets()) {
    if (target > HWY_AVX2) continue;  // no streams
    const OnlyTarget only(target);
    for (const std::uint32_t width : {8u, 16u}) {
      const Tree tree = test_tree(mesh, width, leaf);
      expected.compare(*encode_simd_wide(width, tree, contents, {}), what);
      expected.compare(*encode_compressed(width, tree, mesh), what);
    }
  }
}

/// Small triangles anywhere in a box.
Scene scattered_triangles(int count, float size) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  TestRandom random(5);
  for (int i = 0; i < count; ++i) {
    const Vec3 a = random.point(-1, 1);
    add_triangle(positions, triangles, a, a + random.point(-size, size), a + random.point(-size, size));
  }
  Scene scene;
  scene.add_mesh(std::move(positions), std::move(triangles));
  return scene;
}

TEST(Streams, AnswerLikeBruteForceOnEveryInstructionSet) {
  for (const char* name : {"random", "grid", "far_away"}) expect_like_brute_force(test_scene(name), 11, name);
}

TEST(Streams, WhereFewRaysShareNodes_AnswerLikeBruteForce) {
  expect_like_brute_force(scattered_triangles(3000, 0.15f), 1, "many small triangles");
}

TEST(Streams, GoRayByRayWhereTheirListsHaveNoRoom) {
  const Scene scene = scattered_triangles(100, 0.2f);
  Contents contents;
  contents.mesh = &scene.meshes.front();
  const Expected expected(scene);
  for (const std::uint32_t width : {8u, 16u}) {
    expected.compare(*encode_simd_wide(width, test::chain(scene.meshes.front()), contents, {}), "a chain");
  }
}

}  // namespace
}  // namespace boxwood
