#include "boxwood/scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "math/sampling.h"
#include "scene/generators.h"
#include "scene/placement.h"

namespace boxwood {
namespace {

Mesh one_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(IsUsable, RefusesWhatHasNoAreaOrIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(is_usable(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0));
  EXPECT_TRUE(is_usable(one_triangle({0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}), 0));
  EXPECT_TRUE(is_usable(one_triangle({-1e12f, 0, 0}, {1e12f, 0, 0}, {0, 1e12f, 0}), 0));
  EXPECT_FALSE(is_usable(one_triangle({0, 0, 0}, {0, 0, 0}, {0, 1, 0}), 0));
  EXPECT_FALSE(is_usable(one_triangle({1, 1, 1}, {2, 2, 2}, {4, 4, 4}), 0));
  EXPECT_FALSE(is_usable(one_triangle({nan, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0));
  EXPECT_FALSE(is_usable(one_triangle({0, 0, 0}, {1, -infinity, 0}, {0, 1, 0}), 0));
  EXPECT_FALSE(is_usable(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1.1e12f, 0}), 0));
}

TEST(Scene, AddMeshRefusesIndicesOutOfRange) {
  Scene scene;
  scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_TRUE(scene.single_level());
  EXPECT_THROW(scene.add_mesh({{0, 0, 0}}, {{0, 0, 1}}), Error);
  EXPECT_EQ(scene.meshes.size(), 1u);
  scene.add_mesh({}, {});
  EXPECT_FALSE(scene.single_level());
}

TEST(Scene, BoundsHoldUsableTrianglesOnlyWhereTheyArePlaced) {
  Scene scene = generate("non-finite(400)");
  const Box bounds = scene.bounds();
  EXPECT_GE(bounds.lower.x, 0);
  EXPECT_LE(bounds.upper.x, 1);
  scene.instances[0].object_to_world = Transform::translate({10, 0, 0});
  EXPECT_FLOAT_EQ(scene.bounds().lower.x, bounds.lower.x + 10);
  EXPECT_TRUE(generate("zero-area").bounds().empty());
  EXPECT_TRUE(generate("none").bounds().empty());
}

TEST(Scene, FlattenPlacesTheSameTriangles) {
  const Scene scene = generate("instances(count=20, detail=3)");
  const Scene flat = flatten(scene);
  ASSERT_TRUE(flat.single_level());
  ASSERT_EQ(flat.unique_triangles(), scene.placed_triangles());
  EXPECT_EQ(flat.bounds(), scene.bounds());
  const Mesh &from = scene.meshes[0], &to = flat.meshes[0];
  for (std::size_t i = 0; i < to.triangles.size(); ++i) {
    const Transform& place = scene.instances[i / from.triangles.size()].object_to_world;
    const Triangle& triangle = from.triangles[i % from.triangles.size()];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      ASSERT_EQ(to.positions[to.triangles[i][corner]], place.point(from.positions[triangle[corner]]));
    }
  }
}

TEST(Placement, SinglyPlacedMeshesAreMergedAndUnplacedOnesDropped) {
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    scene.meshes.push_back(one_triangle({0, 0, 0}, {1, 0, 0}, {0, static_cast<float>(i + 1), 0}));
  }
  scene.materials.resize(1);
  scene.meshes[3].materials = {0};
  const auto at = [](float x) { return Transform::translate({x, 0, 0}); };
  // Mesh 0 once, mesh 1 three times of which one is flat, mesh 2 never, mesh 3 once.
  scene.instances = {{0, at(1)}, {1, at(2)}, {1, at(3)}, {1, Transform::scale({1, 1, 0})}, {3, at(4)}};
  const Scene merged = merge_single_placements(scene);
  ASSERT_EQ(merged.meshes.size(), 2u);
  ASSERT_EQ(merged.instances.size(), 3u);
  EXPECT_EQ(merged.meshes[0].triangles.size(), 3u);
  EXPECT_EQ(merged.meshes[0].materials, (std::vector<std::uint16_t>{1, 1, 0}));
  EXPECT_EQ(merged.materials.size(), 2u);
  EXPECT_EQ(merged.placed_triangles(), scene.placed_triangles());
  EXPECT_EQ(merged.bounds(), scene.bounds());
  EXPECT_EQ(find_bad_index(merged), "");
}

TEST(Placement, NormalsStayPerpendicularUnderAnyMap) {
  Mesh mesh = one_triangle({0, 0, 0}, {1, 0, 1}, {0, 1, 0});
  const Vec3 normal = normalize(cross({1, 0, 1}, {0, 1, 0}));
  mesh.normals.assign(3, normal);
  Transform place = uniform_rotation(0.2f, 0.7f, 0.4f) * Transform::scale({3, 0.5f, -1});
  const std::vector<Instance> instances = {{0, place}};
  std::vector<Material> materials;
  const Mesh merged = merge_placed({&mesh, 1}, instances, materials);
  EXPECT_NEAR(dot(merged.normals[0], merged.positions[1] - merged.positions[0]), 0, 1e-5);
  EXPECT_NEAR(dot(merged.normals[0], merged.positions[2] - merged.positions[0]), 0, 1e-5);
  EXPECT_NEAR(length(merged.normals[0]), 1, 1e-5);
}

TEST(Placement, BadIndicesAreFound) {
  Scene scene = generate("cube");
  EXPECT_EQ(find_bad_index(scene), "");
  Scene broken = scene;
  broken.meshes[0].triangles[5][1] = 8;
  EXPECT_NE(find_bad_index(broken), "");
  broken = scene;
  broken.instances[0].mesh = 1;
  EXPECT_NE(find_bad_index(broken), "");
  broken = scene;
  broken.meshes[0].materials.assign(12, 0);
  EXPECT_NE(find_bad_index(broken), "");
  broken = scene;
  broken.meshes[0].normals.resize(3);
  EXPECT_NE(find_bad_index(broken), "");
}

}  // namespace
}  // namespace boxwood
