// The path tracer of the SAH alternatives study: how many rays of each kind there are, and where they go.
#include "render/whole_paths.h"

#include <gtest/gtest.h>

#include <map>

#include "render/test_scenes.h"

namespace boxwood {
namespace {

using namespace testing_scenes;

constexpr std::uint32_t pixels = 40 * 30;

RaySetSettings settings_in(const Camera& camera) {
  RaySetSettings settings;
  settings.camera = camera;
  settings.width = 40;
  settings.height = 30;
  settings.bounces = 2;
  settings.ao_radius = 5;
  return settings;
}

std::map<std::string, RaySet> sets_of(const Scene& scene, const RaySetSettings& settings,
                                      const WholePaths& paths = {}) {
  const std::vector<std::string> kinds = {"primary", "shadow", "ao", "diffuse"};
  std::map<std::string, RaySet> sets;
  for (RaySet& set : make_path_sets(scene, build(scene, "median > binary"), settings, paths, kinds))
    sets[set.kind] = set;
  return sets;
}

Scene lit_room() {
  Scene scene = box_scene();
  scene.lights = {{{0.5f, 0.5f, 0.5f}}, {{-0.5f, 0.5f, 0.1f}}, {{0, 0.2f, -0.7f}}};
  return scene;
}

const Camera inside{"inside", {0.3f, 0.2f, 0.1f}, {1, 0.5f, 0.2f}, {0, 1, 0}, 110};

TEST(WholePaths, InAClosedRoom_ShadeAtThreePointsOfEveryPath) {
  const auto sets = sets_of(lit_room(), settings_in(inside));
  EXPECT_EQ(sets.at("primary").rays.size(), pixels);
  EXPECT_EQ(sets.at("diffuse1").rays.size(), pixels);
  EXPECT_EQ(sets.at("diffuse2").rays.size(), pixels);
  EXPECT_EQ(sets.at("shadow").rays.size(), 3 * 3 * pixels);  // lights, points
  EXPECT_EQ(sets.at("ao").rays.size(), 3 * 3 * pixels);      // rays, points
}

TEST(WholePaths, EveryPointSeesEveryLight) {
  const Scene scene = lit_room();
  const std::vector<Ray> rays = sets_of(scene, settings_in(inside)).at("shadow").rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_LT(length(rays[i].origin + rays[i].direction - scene.lights[i % 3].position), 1e-3f) << i;
    ASSERT_EQ(rays[i].origin, rays[i - i % 3].origin) << i;
  }
}

TEST(WholePaths, OcclusionRaysOfAPointDiffer) {
  const std::vector<Ray> rays = sets_of(lit_room(), settings_in(inside)).at("ao").rays;
  EXPECT_EQ(rays[0].origin, rays[2].origin);
  EXPECT_NE(rays[0].direction, rays[1].direction);
  EXPECT_NE(rays[1].direction, rays[2].direction);
  for (const Ray& ray : rays) ASSERT_EQ(ray.t_far, 5);
}

TEST(WholePaths, BouncesAreUniformOverTheHemisphere) {
  const Camera above{"above", {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, 60};
  const std::vector<Ray> rays = sets_of(plane_scene(), settings_in(above)).at("diffuse1").rays;
  double sum = 0;
  for (const Ray& ray : rays) sum += static_cast<double>(ray.direction.y);
  // The mean cosine is a half, standard error 0.29 / sqrt(1200) = 0.008; around the cosine it would be two thirds.
  EXPECT_NEAR(sum / static_cast<double>(rays.size()), 0.5, 0.03);
}

TEST(WholePaths, StopWherePathsLeave) {
  const Camera above{"above", {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, 60};
  const auto sets = sets_of(plane_scene(), settings_in(above));
  EXPECT_EQ(sets.at("diffuse1").rays.size(), pixels);
  EXPECT_TRUE(sets.at("diffuse2").rays.empty());
  EXPECT_EQ(sets.at("ao").rays.size(), 3 * pixels);
}

TEST(WholePaths, ASceneWithoutLights_HasTheDefaultOne) {
  EXPECT_EQ(sets_of(box_scene(), settings_in(inside)).at("shadow").rays.size(), 3 * pixels);
}

TEST(WholePaths, WithoutOcclusionRays_AreRefused) {
  EXPECT_THROW(sets_of(lit_room(), settings_in(inside), {.ao_rays = 0}), UsageError);
}

}  // namespace
}  // namespace boxwood
