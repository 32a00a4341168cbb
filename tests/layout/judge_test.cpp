#include "trace/judge.h"

#include <gtest/gtest.h>

#include "support/differential.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

TEST(Judge, FindsNoBruteForceAnswerWrong) {
  for (const test::NamedScene& named : test::troubled_scenes()) {
    if (named.name == "vanishing") continue;  // below the smallest sides that float triangles can have
    const test::Expected expected(named.scene, test::troubling_rays(named.scene, 600, 21));
    const Judge judge(named.scene);
    for (std::size_t i = 0; i < expected.rays.size(); ++i) {
      EXPECT_NE(judge.closest_hit(expected.rays[i], expected.hits[i]), Judgement::wrong)
          << named.name << ", ray " << i << ": "
          << test::describe(expected.rays[i], expected.hits[i], expected.hits[i]);
    }
  }
}

/// Rays at random points, so that edges and ties are rare.
test::Expected plain(const Scene& scene) {
  Random random(8);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) {
    const Vec3 origin = test::point_around(scene.bounds(), random, 1);
    rays.push_back({origin, 0, test::point_around(scene.bounds(), random, 0.3f) - origin});
  }
  return {scene, std::move(rays)};
}

TEST(Judge, AgreesWherePlainRaysHit) {
  const Scene scene = test::soup(100, 0.4f, 5);
  const test::Expected expected = plain(scene);
  const Judge judge(scene);
  std::size_t agreed = 0;
  for (std::size_t i = 0; i < expected.rays.size(); ++i) {
    agreed += judge.closest_hit(expected.rays[i], expected.hits[i]) == Judgement::agrees ? 1 : 0;
  }
  EXPECT_GE(agreed, expected.rays.size() - 5);
}

TEST(Judge, CallsInventedAnswersWrong) {
  const Scene scene = test::soup(100, 0.4f, 5);
  const test::Expected expected = plain(scene);
  const Judge judge(scene);
  std::size_t hits = 0, wrong = 0;
  for (std::size_t i = 0; i < expected.rays.size(); ++i) {
    const Ray& ray = expected.rays[i];
    Hit hit = expected.hits[i];
    if (!hit.valid()) continue;
    hits += 3;
    wrong += judge.closest_hit(ray, Hit{}) == Judgement::wrong ? 1 : 0;
    hit.t *= 1.001f;
    wrong += judge.closest_hit(ray, hit) == Judgement::wrong ? 1 : 0;
    hit.t = expected.hits[i].t;
    hit.primitive = (hit.primitive + 1) % 100;
    wrong += judge.closest_hit(ray, hit) == Judgement::wrong ? 1 : 0;
  }
  EXPECT_GT(hits, 300u);
  EXPECT_GE(wrong + 5, hits);
}

TEST(Judge, WantsInvalidRaysToMiss) {
  const Judge judge(test::coincident(1));
  const Hit hit{1, 0, 0, 0, 0};
  for (const Ray& ray : test::invalid_rays({0.3f, 0.4f, -2}, {0, 0, 1})) {
    EXPECT_EQ(judge.closest_hit(ray, Hit{}), Judgement::agrees);
    EXPECT_EQ(judge.closest_hit(ray, hit), Judgement::wrong);
  }
}

}  // namespace
}  // namespace boxwood
