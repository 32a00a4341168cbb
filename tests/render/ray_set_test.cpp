#include "boxwood/ray_set.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "render/ray_sets.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

using namespace testing_scenes;

RaySetSettings small_settings() {
  RaySetSettings settings;
  settings.camera = outside_camera();
  settings.width = 40;
  settings.height = 30;
  settings.bounces = 2;
  settings.random_rays = 5000;
  return settings;
}

std::vector<std::string> all_kinds() { return {ray_kinds().begin(), ray_kinds().end()}; }

std::vector<RaySet> make(const Scene& scene, const std::string& recipe = "median > binary",
                         const RaySetSettings& settings = small_settings()) {
  return make_ray_sets(scene, build(scene, recipe), settings, all_kinds());
}

RaySet find(const std::vector<RaySet>& sets, const std::string& kind) {
  return *std::ranges::find(sets, kind, &RaySet::kind);
}

std::vector<Ray> rays_of(const Scene& scene, const std::string& kind) { return find(make(scene), kind).rays; }

bool identical(const RaySet& a, const RaySet& b) {
  return a.kind == b.kind && a.query == b.query && a.rays.size() == b.rays.size() &&
         std::memcmp(a.rays.data(), b.rays.data(), a.rays.size() * sizeof(Ray)) == 0;
}

bool identical(const std::vector<RaySet>& a, const std::vector<RaySet>& b) {
  return std::ranges::equal(a, b, [](const RaySet& x, const RaySet& y) { return identical(x, y); });
}

TEST(RaySets, EveryKindHasRaysAndComesInOrder) {
  std::vector<std::string> kinds;
  for (const RaySet& set : make(soup_scene())) {
    EXPECT_FALSE(set.rays.empty()) << set.kind;
    EXPECT_EQ(set.query, set.kind == "shadow" || set.kind == "ao" ? Query::any_hit : Query::closest_hit);
    kinds.push_back(set.kind);
  }
  EXPECT_EQ(kinds, (std::vector<std::string>{"primary", "shadow", "ao", "diffuse1", "diffuse2", "path", "random",
                                             "axis", "grazing"}));
}

TEST(RaySets, DoNotDependOnThreadsOrRecipe) {
  for (const Scene& scene : {soup_scene(), instanced_scene()}) {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
    tbb::task_arena one(1), four(4);
    const auto expected = one.execute([&] { return make(scene); });
    EXPECT_TRUE(identical(expected, four.execute([&] { return make(scene); })));
    EXPECT_TRUE(identical(expected, make(scene, "default")));
  }
}

TEST(RaySets, DependOnTheSeedAndNotOnWhatElseIsMade) {
  const Scene scene = soup_scene();
  const auto all = make(scene);
  RaySetSettings other = small_settings();
  other.seed = 2;
  EXPECT_FALSE(identical(find(all, "random"), find(make(scene, "median > binary", other), "random")));
  const std::vector<std::string> one_kind = {"diffuse"};
  const auto alone = make_ray_sets(scene, build(scene, "median > binary"), small_settings(), one_kind);
  ASSERT_EQ(alone.size(), 2u);
  EXPECT_TRUE(identical(alone[1], find(all, "diffuse2")));
}

TEST(RaySets, RaysInsideAClosedBoxNeverLeave) {
  const Scene scene = box_scene();
  const Structure structure = build(scene, "median > binary");
  RaySetSettings settings = small_settings();
  settings.camera = {"inside", {0.3f, 0.2f, 0.1f}, {1, 0.5f, 0.2f}, {0, 1, 0}, 110};
  settings.ao_radius = 10;
  settings.bounces = 5;
  for (const RaySet& set : make_ray_sets(scene, structure, settings, all_kinds())) {
    if (set.kind == "shadow" || set.kind == "grazing")
      continue;  // a light may be unblocked; grazing rays start outside
    if (set.kind == "path") {
      EXPECT_GT(set.rays.size(), 3 * 1200u);  // roulette begins after three bounces
    } else {
      EXPECT_EQ(set.rays.size(), set.kind == "random" || set.kind == "axis" ? 5000u : 1200u) << set.kind;
    }
    for (const Ray& ray : set.rays) ASSERT_TRUE(structure.any_hit(ray)) << set.kind;
  }
}

TEST(RaySets, RaysThatLeaveAPlaneDoNotHitItAgain) {
  const Scene scene = plane_scene(100);
  const Structure structure = build(scene, "median > binary");
  RaySetSettings settings = small_settings();
  settings.camera = {"above", {0, 101, 0}, {0.1f, -1, 0}, {0, 0, -1}, 70};
  const auto sets = make_ray_sets(scene, structure, settings, all_kinds());
  for (const std::string kind : {"ao", "diffuse1", "shadow"}) {
    const RaySet set = find(sets, kind);
    EXPECT_FALSE(set.rays.empty());
    for (const Ray& ray : set.rays) ASSERT_FALSE(structure.any_hit(ray)) << kind;
  }
  EXPECT_TRUE(find(sets, "diffuse2").rays.empty());
}

TEST(RaySets, ShadowRaysEndJustShortOfALight) {
  Scene scene = plane_scene();
  scene.lights = {{{0, 5, 0}, {1, 1, 1}}, {{3, 4, 0}, {1, 1, 1}}};
  std::set<int> lights_seen;
  for (const Ray& ray : rays_of(scene, "shadow")) {
    const Vec3 end = ray.origin + ray.direction;
    const int light = length(end - scene.lights[0].position) < 1e-3f ? 0 : 1;
    lights_seen.insert(light);
    ASSERT_LT(length(end - scene.lights[light].position), 1e-3f);
    ASSERT_LT(ray.t_far, 1);
    ASSERT_GT(ray.t_far, 0.99f);
  }
  EXPECT_EQ(lights_seen.size(), 2u);
}

TEST(RaySets, ShadowRaysInAClosedRoomWithoutLightsFindTheLightInside) {
  const Scene scene = box_scene();
  const Structure structure = build(scene, "median > binary");
  RaySetSettings settings = small_settings();
  settings.camera = {"inside", {0.9f, 0.9f, 0.9f}, {-1, -1, -1}, {0, 1, 0}, 60};
  const std::vector<std::string> kinds = {"shadow"};
  const std::vector<RaySet> sets = make_ray_sets(scene, structure, settings, kinds);
  for (const Ray& ray : sets[0].rays) ASSERT_FALSE(structure.any_hit(ray));
}

TEST(RaySets, AxisRaysFollowOneAxisWithZerosOfBothSigns) {
  int positive_zeros = 0, negative_zeros = 0;
  std::set<std::pair<int, bool>> directions;
  for (const Ray& ray : rays_of(soup_scene(), "axis")) {
    int nonzero = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[static_cast<std::size_t>(axis)];
      if (d != 0) {
        ++nonzero;
        ASSERT_EQ(std::fabs(d), 1);
        directions.insert({axis, d < 0});
      } else {
        ++(std::signbit(d) ? negative_zeros : positive_zeros);
      }
    }
    ASSERT_EQ(nonzero, 1);
  }
  EXPECT_EQ(directions.size(), 6u);
  EXPECT_GT(positive_zeros, 4000);
  EXPECT_GT(negative_zeros, 4000);
}

TEST(RaySets, GrazingRaysStartJustOffASurfaceAndRunAlongIt) {
  const Scene scene = plane_scene(10);
  for (const Ray& ray : rays_of(scene, "grazing")) {
    ASSERT_NEAR(ray.origin.y, 10, 1e-3f);
    ASSERT_GT(ray.origin.y, 10);
    ASSERT_LE(std::fabs(ray.direction.y), 0.0101f);
    ASSERT_NEAR(length(ray.direction), 1, 1e-5f);
  }
}

TEST(RaySets, OfAnEmptySceneHoldTheCamerasRaysOnly) {
  for (const RaySet& set : make(Scene()))
    EXPECT_EQ(set.rays.size(), set.kind == "primary" || set.kind == "path" ? 1200u : 0u) << set.kind;
}

TEST(RaySets, OfASceneWithHardlyAUsableTriangleStillGraze) {
  Scene scene;
  std::vector<Triangle> triangles(1000, Triangle{0, 0, 0});
  triangles[900] = {0, 1, 2};
  scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);
  for (const Ray& ray : rays_of(scene, "grazing")) ASSERT_TRUE(is_finite(ray.direction));
}

TEST(RaySets, DiffuseRaysNeedABounce) {
  RaySetSettings settings = small_settings();
  settings.bounces = 0;
  EXPECT_THROW(make(plane_scene(), "median > binary", settings), UsageError);
}

TEST(RaySets, UnknownKindIsRefusedWithTheValidOnes) {
  const Scene scene = plane_scene();
  const std::vector<std::string> kinds = {"primery"};
  try {
    make_ray_sets(scene, build(scene, "median > binary"), small_settings(), kinds);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("'primary'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("grazing"), std::string::npos) << error.what();
  }
}

/// Rays that tell by their t_far which they are.
std::vector<float> kept_of(std::size_t rays, std::size_t run, std::size_t most) {
  std::vector<Ray> numbered(rays);
  for (std::size_t i = 0; i < rays; ++i) numbered[i].t_far = static_cast<float>(i);
  keep_spread_runs(numbered, run, most);
  std::vector<float> out;
  out.reserve(numbered.size());
  for (const Ray& ray : numbered) out.push_back(ray.t_far);
  return out;
}

TEST(SpreadRuns, KeepsWholeRunsFromAllOverTheSet) {
  EXPECT_EQ(kept_of(20, 2, 6), (std::vector<float>{0, 1, 6, 7, 12, 13}));
  // What is left after the last whole run is never kept, and runs are not cut to come nearer to the number wanted.
  EXPECT_EQ(kept_of(21, 4, 11), (std::vector<float>{0, 1, 2, 3, 8, 9, 10, 11}));
}

TEST(SpreadRuns, KeepsOneRunAtLeastAndAllRaysWhereThereAreFew) {
  EXPECT_EQ(kept_of(9, 3, 1), (std::vector<float>{0, 1, 2}));
  EXPECT_EQ(kept_of(5, 3, 8), (std::vector<float>{0, 1, 2, 3, 4}));
  EXPECT_EQ(kept_of(0, 3, 8), std::vector<float>());
}

}  // namespace
}  // namespace boxwood
