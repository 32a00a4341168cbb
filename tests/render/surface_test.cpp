#include "render/surface.h"

#include <gtest/gtest.h>

#include "render/secondary_rays.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

using namespace testing_scenes;

TEST(Surfaces, NormalsOfAClosedMeshPointOutwardEvenWhereAnInstanceMirrors) {
  const Scene scene = instanced_scene();
  const Surfaces surfaces(scene);
  const Vec3 centers[] = {{0, 0, 0}, {4, 0, 0}};
  for (std::uint32_t instance = 0; instance < 2; ++instance) {
    for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
      const SurfacePoint point = surfaces.at(instance, triangle, 0.25f, 0.5f);
      EXPECT_GT(dot(point.normal, point.position - centers[instance]), 0) << instance << " " << triangle;
      EXPECT_NEAR(length(point.normal), 1, 1e-6f);
    }
  }
}

TEST(Surfaces, NormalsAreAtRightAnglesToStretchedTriangles) {
  Scene scene = soup_scene(50);
  scene.instances[0].object_to_world =
      Transform::translate({5, -3, 2}) * Transform::rotate({0, 1, 0}, 0.7f) * Transform::scale({1, 6, 0.3f});
  const Surfaces surfaces(scene);
  for (std::uint32_t triangle = 0; triangle < 50; ++triangle) {
    const SurfacePoint a = surfaces.at(0, triangle, 0, 0);
    const SurfacePoint b = surfaces.at(0, triangle, 1, 0), c = surfaces.at(0, triangle, 0, 1);
    EXPECT_NEAR(dot(a.normal, normalize(b.position - a.position)), 0, 2e-5f);
    EXPECT_NEAR(dot(a.normal, normalize(c.position - a.position)), 0, 2e-5f);
  }
}

TEST(Surfaces, MaterialOfATriangleWithoutOneIsTheDefault) {
  Scene scene = plane_scene();
  EXPECT_EQ(Surfaces(scene).at(0, 0, 0, 0).material->diffuse, Material{}.diffuse);
  scene.materials.resize(2);
  scene.materials[1].diffuse = {1, 0, 0};
  scene.meshes[0].materials = {1, 99};
  EXPECT_EQ(Surfaces(scene).at(0, 0, 0, 0).material->diffuse, (Vec3{1, 0, 0}));
  EXPECT_EQ(Surfaces(scene).at(0, 1, 0, 0).material->diffuse, Material{}.diffuse);
}

TEST(SecondaryRays, StartOnTheSideTheyCameFrom) {
  const Scene scene = plane_scene(1000);
  const Surfaces surfaces(scene);
  const SurfacePoint point = surfaces.at(0, 0, 0.2f, 0.3f);
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Ray above = diffuse_ray(point, {0, -1, 0}, random), below = ao_ray(point, {0, 1, 0}, 3, random);
    EXPECT_GT(above.origin.y, 1000);
    EXPECT_GT(above.direction.y, 0);
    EXPECT_LT(below.origin.y, 1000);
    EXPECT_LT(below.direction.y, 0);
    EXPECT_EQ(below.t_far, 3);
  }
  LightSample light;
  light.target = {0, 1010, 0};
  const Ray shadow = shadow_ray(point, {0, -1, 0}, light);
  EXPECT_LT(shadow.t_far, 1);
  EXPECT_EQ(shadow.origin + shadow.direction, (Vec3{0, 1010, 0}));
}

}  // namespace
}  // namespace boxwood
