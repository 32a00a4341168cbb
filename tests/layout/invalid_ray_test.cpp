#include <gtest/gtest.h>

#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

constexpr TraceOptions walks[] = {{ChildOrder::near, true, TraversalMode::iterative},
                                  {ChildOrder::none, false, TraversalMode::recursive}};

TEST(InvalidRay, HitsNothingInAnyLayout) {
  const Scene scene = test::sphere(6);
  const std::vector<Ray> rays = test::invalid_rays({0, 0, 0}, {1, 2, 3});
  const BruteForce brute_force(scene);
  for (const test::LayoutCall& call : {test::LayoutCall(binary_stage()), test::LayoutCall(wide_stage())}) {
    for (const TraceOptions& walk : walks) {
      const auto layout = test::encode_scene(scene, call, walk);
      ASSERT_TRUE(layout->any_hit({{0, 0, 0}, 0, {1, 2, 3}}));
      for (const Ray& ray : rays) {
        EXPECT_FALSE(layout->closest_hit(ray).valid());
        EXPECT_FALSE(layout->any_hit(ray));
        EXPECT_FALSE(brute_force.closest_hit(ray).valid());
        EXPECT_FALSE(brute_force.any_hit(ray));
      }
    }
  }
}

TEST(Ray, LimitsIncludeTheHitItself) {
  const Scene scene = test::coincident(3);
  const auto layout = test::encode_scene(scene, test::LayoutCall(binary_stage()), {});
  Ray ray{{0.3f, 0.4f, -2}, 0, {0, 0, 1}};
  const float t = layout->closest_hit(ray).t;
  ASSERT_LT(t, 10);
  for (const auto& [t_near, t_far, expected] : {std::tuple{t, t, true},
                                                {0.0f, t, true},
                                                {t, 100.0f, true},
                                                {std::nextafter(t, 9.0f), 100.0f, false},
                                                {0.0f, std::nextafter(t, 0.0f), false},
                                                {-100.0f, 0.0f, false}}) {
    ray.t_near = t_near, ray.t_far = t_far;
    EXPECT_EQ(layout->closest_hit(ray).valid(), expected) << t_near << ' ' << t_far;
    EXPECT_EQ(layout->any_hit(ray), expected) << t_near << ' ' << t_far;
  }
}

TEST(EqualDistance, GoesToTheSmallestInstanceThenPrimitive) {
  Scene scene = test::coincident(20);
  const Ray ray{{0.3f, 0.4f, -2}, 0, {0, 0, 1}};
  EXPECT_EQ(test::encode_scene(scene, test::LayoutCall(binary_stage()), {})->closest_hit(ray).primitive, 0u);
  scene.instances.assign(7, scene.instances[0]);
  const Hit hit = test::encode_scene(scene, test::LayoutCall(wide_stage()), {})->closest_hit(ray);
  EXPECT_EQ(hit.primitive, 0u);
  EXPECT_EQ(hit.instance, 0u);
}

}  // namespace
}  // namespace boxwood
