// Rays aimed at shared vertices and edges of closed meshes never slip through.
#include <gtest/gtest.h>

#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

std::vector<test::NamedScene> closed_meshes() {
  std::vector<test::NamedScene> out;
  out.push_back({"sphere", test::sphere(12)});
  out.push_back({"cube", test::cube(8)});
  out.push_back({"torus", test::torus(12)});
  for (const float scale : {1e-6f, 1e9f})
    out.push_back({"scaled sphere", test::transformed(test::sphere(8), scale, {})});
  out.push_back({"moved sphere", test::transformed(test::sphere(8), 1, {1000, -2000, 3000})});
  return out;
}

std::vector<std::shared_ptr<const Layout>> layouts_over(const Scene& scene) {
  std::vector<std::shared_ptr<const Layout>> out;
  for (const test::LayoutCall& call : {test::LayoutCall(binary_stage()), test::LayoutCall(wide_stage())}) {
    out.push_back(test::encode_scene(scene, call, {}));
  }
  return out;
}

/// A vertex, or a point on an edge, jittered or not.
Vec3 target_on(const Mesh& mesh, Random& random) {
  const Triangle& triangle = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
  const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]];
  const Vec3 point = random.below(2) ? a : a + (b - a) * random.uniform();
  return random.below(2) ? point : test::jitter(point, random);
}

/// A point well inside.
Vec3 inside(const test::NamedScene& named, Random& random) {
  const Box box = named.scene.bounds();
  const float size = box.extent().x;
  if (named.name == "torus") {
    const float phi = random.uniform(0, test::full_turn);
    return Vec3{std::cos(phi), std::sin(phi), 0} + test::random_point(random, 0.1f);
  }
  return random.below(4) == 0 ? box.center() : box.center() + test::random_point(random, 0.2f * size);
}

TEST(ClosedMesh, IsNeverLeftFromInside) {
  for (const test::NamedScene& named : closed_meshes()) {
    Random random(3);
    const auto layouts = layouts_over(named.scene);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 origin = inside(named, random);
      const Ray ray{origin, 0, target_on(named.scene.meshes[0], random) - origin};
      for (const auto& layout : layouts) {
        ASSERT_TRUE(layout->closest_hit(ray).valid()) << named.name << ", ray " << i;
        ASSERT_TRUE(layout->any_hit(ray)) << named.name << ", ray " << i;
      }
    }
  }
}

TEST(ClosedMesh, IsNeverPassedFromOutside) {
  for (const test::NamedScene& named : closed_meshes()) {
    Random random(4);
    const Box box = named.scene.bounds();
    const auto layouts = layouts_over(named.scene);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 target = target_on(named.scene.meshes[0], random);
      // A convex mesh shows this side to anyone in a cone around the outward direction.
      const Vec3 outward = named.name == "torus" ? Vec3{0, 0, target.z} : target - box.center();
      if (named.name == "torus" && std::fabs(target.z) < 0.3f) continue;
      const float size = box.extent().x;
      const Vec3 origin = target + (normalize(outward) + test::random_point(random, 0.15f)) * (2 * size);
      const Ray ray{origin, 0, target - origin};
      for (const auto& layout : layouts) {
        // The target is at t = 1; what is behind it is much farther.
        const Hit hit = layout->closest_hit(ray);
        ASSERT_TRUE(hit.valid()) << named.name << ", ray " << i;
        ASSERT_LT(hit.t, 1.02f) << named.name << ", ray " << i;
      }
    }
  }
}

TEST(ClosedMesh, OfInstancesIsNeverLeftFromInside) {
  Scene scene = test::sphere(10);
  scene.instances.clear();
  Random random(6);
  const Vec3 stretch{1, 7, 0.2f};
  for (int i = 0; i < 5; ++i) {
    scene.instances.push_back({0, Transform::translate(test::random_point(random, 50)) *
                                      Transform::rotate(normalize(test::random_point(random, 1)), 1) *
                                      Transform::scale(stretch)});
  }
  const auto layouts = layouts_over(scene);
  for (int i = 0; i < 5000; ++i) {
    const Transform& placed = scene.instances[static_cast<std::size_t>(i) % 5].object_to_world;
    const Vec3 origin = placed.point(test::random_point(random, 0.3f));
    const Ray ray{origin, 0, placed.point(target_on(scene.meshes[0], random)) - origin};
    for (const auto& layout : layouts) ASSERT_TRUE(layout->closest_hit(ray).valid()) << "ray " << i;
  }
}

}  // namespace
}  // namespace boxwood
