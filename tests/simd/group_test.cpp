// Groups of coherent rays, as a camera or a lamp makes them: those that pass exactly through corners and edges hit what
// the triangle test over all triangles hits, whichever triangles a group leaves out as a whole, on every instruction
// set that has registers for groups.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "layout/simd/wide_simd.h"
#include "simd/test_compressed.h"
#include "simd/test_targets.h"
#include "simd/test_trees.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

/// Corners and middles of edges near the middle of the scene.
std::vector<Vec3> targets_of(const Scene& scene) {
  const Mesh& mesh = scene.meshes.front();
  const Vec3 center = scene.bounds().center();
  std::vector<Vec3> out;
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]];
    for (const Vec3 target : {a, (a + b) * 0.5f}) {
      const Vec3 away = target - center;
      if (std::max({std::fabs(away.x), std::fabs(away.y), std::fabs(away.z)}) < 0.4f) out.push_back(target);
    }
  }
  return out;
}

/// Groups of 64 in every octant and along every dominant axis: from one point, as a camera's; from a patch; parallel,
/// as the sun's; nearly one and the same ray. Half of them end near what they aim at.
std::vector<Ray> coherent_rays(const Scene& scene) {
  const std::vector<Vec3> targets = targets_of(scene);
  const Vec3 center = scene.bounds().center();
  TestRandom random(31);
  std::vector<Ray> rays;
  std::size_t next = 0;
  for (int group = 0; group < 96; ++group) {
    Vec3 way{3, 4, 5};
    if (group / 8 % 3 == 1) way = {4, 5, 3};
    if (group / 8 % 3 == 2) way = {5, 3, 4};
    for (std::size_t axis = 0; axis < 3; ++axis) way[axis] *= (group >> axis & 1) != 0 ? -1.0f : 1.0f;
    const int kind = group / 24;
    const float patch = kind == 0 ? 0.0f : kind == 3 ? 0.01f : 0.1f;
    for (int i = 0; i < 64; ++i) {
      if (kind < 2 || i == 0) ++next;
      const Vec3 target = targets[next % targets.size()];
      const Vec3 origin = (kind == 2 ? target : center) - way + random.point(-patch, patch);
      rays.push_back({origin, 0, kind == 2 ? way : target - origin, group % 2 != 0 ? random.between(0.9f, 1.1f) : 100});
    }
  }
  return rays;
}

class GroupsIn : public testing::TestWithParam<const char*> {};

TEST_P(GroupsIn, CornersAndEdges_AreHitAsByBruteForce) {
  const Scene scene = test_scene(GetParam());
  const Mesh& mesh = scene.meshes.front();
  const std::vector<Ray> rays = coherent_rays(scene);
  std::vector<Hit> expected(rays.size());
  BruteForce(scene).closest_hits(rays, expected);
  std::vector<std::uint8_t> expected_blocked;
  expected_blocked.reserve(expected.size());
  for (const Hit& hit : expected) expected_blocked.push_back(hit.valid() ? 1 : 0);

  const auto compare = [&](const Layout& layout, const std::string& what) {
    std::vector<Hit> hits(rays.size());
    layout.closest_hits(rays, hits);
    EXPECT_EQ(first_difference(expected, hits), rays.size()) << what;
    std::vector<std::uint8_t> blocked(rays.size(), 7);
    layout.any_hits(rays, blocked);
    EXPECT_EQ(blocked, expected_blocked) << what;
  };
  Contents contents;
  contents.mesh = &mesh;
  for (const std::int64_t target : testable_targets()) {
    if ((target & (HWY_AVX2 | HWY_AVX3)) == 0) continue;  // groups are for registers of eight
    const OnlyTarget only(target);
    for (const std::uint32_t width : {8u, 16u}) {
      for (const std::uint32_t leaf : {2u, 11u}) {
        const Tree tree = test_tree(mesh, width, leaf);
        const std::string name =
            std::to_string(width) + " wide, leaves of " + std::to_string(leaf) + ", " + hwy::TargetName(target);
        compare(*encode_simd_wide(width, tree, contents, {}), name);
        compare(*encode_compressed(width, tree, mesh), name + ", compressed");
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, GroupsIn, testing::Values("grid", "random", "far_away"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace boxwood
