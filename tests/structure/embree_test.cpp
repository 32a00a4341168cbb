// The peer answers the same questions, within the rounding of its own triangle test.
#ifdef BOXWOOD_EMBREE
#include <gtest/gtest.h>

#include <vector>

#include "boxwood/error.h"
#include "boxwood/structure.h"
#include "support/rays.h"
#include "support/scenes.h"
#include "trace/judge.h"

namespace boxwood {
namespace {

std::vector<Ray> plain_rays(const Scene& scene) {
  Random random(12);
  std::vector<Ray> rays;
  for (int i = 0; i < 1001; ++i) {
    const Vec3 origin = test::point_around(test::arena_of(scene), random, 1);
    rays.push_back({origin, 0, normalize(test::point_around(test::arena_of(scene), random, 0.4f) - origin)});
    if (i % 4 == 0) rays.back().t_far = random.uniform(0, 3);
    if (i % 4 == 1) rays.back().t_near = random.uniform(0, 1);
  }
  for (const Ray& ray : test::invalid_rays({0, 0, 0}, {1, 2, 3})) rays.push_back(ray);
  return rays;
}

std::vector<test::NamedScene> scenes() {
  std::vector<test::NamedScene> out;
  out.push_back({"none", test::scene_of({}, {})});
  out.push_back({"unusable", test::with_unusable()});
  out.push_back({"soup", test::soup(300, 0.2f, 7)});
  out.push_back({"sphere", test::sphere(8)});
  out.push_back({"instances", test::instances()});
  return out;
}

TEST(Embree, IsRightWithinRounding) {
  for (const test::NamedScene& named : scenes()) {
    const std::vector<Ray> rays = plain_rays(named.scene);
    const Judge judge(named.scene);
    for (const char* recipe : {"embree", "embree(quality=low)", "embree(quality=high, robust=on, compact=on)",
                               "embree(batch=packet16)", "embree(batch=stream)"}) {
      const Structure structure = build(named.scene, recipe);
      std::vector<Hit> hits(rays.size());
      std::vector<std::uint8_t> blocked(rays.size());
      structure.closest_hits(rays, hits);
      structure.any_hits(rays, blocked);
      std::size_t wrong = 0, disagreements = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        wrong += judge.closest_hit(rays[i], hits[i]) == Judgement::wrong ? 1 : 0;
        disagreements += hits[i].valid() == (blocked[i] != 0) ? 0 : 1;
      }
      // Its fast triangle test rounds more than the judge allows for, on a few rays.
      EXPECT_LE(wrong, rays.size() / 50) << recipe << " over " << named.name;
      EXPECT_LE(disagreements, rays.size() / 200) << recipe << " over " << named.name;
    }
  }
}

TEST(Embree, WithOurTriangleTest_GivesTheHitsOfOurLayouts) {
  for (const test::NamedScene& named : scenes()) {
    std::vector<Ray> rays = plain_rays(named.scene);
    for (Ray& ray : rays) ray.t_near = std::max(ray.t_near, 0.0f);  // it knows no other
    const Structure ours = build(named.scene, "median > binary"), embree = build(named.scene, "embree(geometry=user)");
    std::vector<Hit> expected(rays.size()), hits(rays.size());
    std::vector<RayCounters> counters(rays.size());
    ours.closest_hits(rays, expected);
    embree.closest_hits(rays, hits);
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      different += hits[i] == expected[i] && embree.any_hit(rays[i]) == expected[i].valid() ? 0 : 1;
    }
    EXPECT_LE(different, rays.size() / 500) << named.name;  // its box test rounds in its own way
    embree.closest_hits_counted(rays, hits, counters);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].valid()) {
        EXPECT_GT(counters[i].primitive_tests, 0u);
      }
    }
  }
  EXPECT_THROW(build(test::soup(5, 0.2f, 7), "embree(geometry=user, batch=stream)"), UsageError);
}

TEST(Embree, ReportsItsMemoryAndCountsNothing) {
  const Scene scene = test::soup(1000, 0.2f, 7);
  const Structure structure = build(scene, "embree");
  EXPECT_GT(structure.report().bytes, 1000u * 40);
  const std::vector<Ray> rays = plain_rays(scene);
  std::vector<Hit> hits(rays.size());
  std::vector<RayCounters> counters(rays.size(), RayCounters{.steps = 1});
  structure.closest_hits_counted(rays, hits, counters);
  for (const RayCounters& c : counters) EXPECT_EQ(c, RayCounters{});
}

}  // namespace
}  // namespace boxwood
#endif
