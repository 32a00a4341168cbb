// Batches through levels of instances: the answers of brute force, whatever a batch meets.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "boxwood/structure.h"
#include "support/differential.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

Transform random_placement(Random& random, float spread) {
  const Transform turn = Transform::rotate({0, 0, 1}, random.uniform(0, 6)) *
                         Transform::scale({random.uniform(0.5f, 1.5f), random.uniform(-1.5f, -0.5f), 1});
  return Transform::translate(test::random_point(random, spread)) * turn;
}

/// `count` placements of a few small meshes in a cube of half side `spread`; every 13th instance is placed twice.
Scene crowd(std::uint32_t count, float spread, std::uint64_t seed) {
  Scene scene = test::soup(12, 0.4f, seed);
  scene.meshes.push_back(test::cube(1).meshes[0]);
  scene.meshes.push_back(test::soup(5, 1, seed + 1).meshes[0]);
  scene.meshes.emplace_back();  // without triangles
  scene.instances.clear();
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.instances.push_back({random.below(4), random_placement(random, spread)});
    if (i % 13 == 5) scene.instances.push_back(scene.instances.back());
  }
  return scene;
}

/// Rays as a camera makes them, side by side: they come to an instance together.
std::vector<Ray> parallel_rays(std::uint32_t side, float half) {
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const auto at = [&](std::uint32_t n) { return half * (2 * static_cast<float>(n) / static_cast<float>(side) - 1); };
    rays.push_back({{at(i % side), at(i / side), 5 * half}, 0, {0.01f, 0.02f, -1}});
  }
  return rays;
}

class InstanceBatch : public testing::TestWithParam<const char*> {};

TEST_P(InstanceBatch, AnswersAreThoseOfBruteForce) {
  for (const auto& [count, spread] : {std::pair{3u, 1.0f}, {60u, 2.0f}, {400u, 6.0f}}) {
    const Scene scene = crowd(count, spread, count);
    const Structure structure = build(scene, GetParam());
    // More than are under way at once, and a last few that are less than a batch.
    const test::Expected troubling(scene, test::troubling_rays(scene, 1300, 4));
    test::expect_brute_force_answers(structure, troubling, "troubling rays, instances: " + std::to_string(count));
    const test::Expected parallel(scene, parallel_rays(33, spread));
    test::expect_brute_force_answers(structure, parallel, "parallel rays, instances: " + std::to_string(count));
    const test::Expected few(scene, test::troubling_rays(scene, 5, 6));
    test::expect_brute_force_answers(structure, few, "few rays");
  }
}

TEST_P(InstanceBatch, RaysThatMeetMoreBoxesThanABatchRemembers_AreAnsweredToo) {
  const Scene scene = crowd(1500, 0.02f, 3);
  const test::Expected expected(scene, test::troubling_rays(scene, 60, 4));
  test::expect_brute_force_answers(build(scene, GetParam()), expected, "all in one place");
}

TEST_P(InstanceBatch, InvalidRaysAndEmptyScenes_HitNothing) {
  std::vector<Ray> rays = test::invalid_rays({0, 0, 5}, {0, 0, -1});
  for (const Ray& good : parallel_rays(5, 1)) rays.push_back(good);
  Scene scene = crowd(40, 1, 9);
  test::expect_brute_force_answers(build(scene, GetParam()), test::Expected(scene, rays), "invalid rays among others");
  for (Instance& instance : scene.instances) instance.mesh = 3;
  test::expect_brute_force_answers(build(scene, GetParam()), test::Expected(scene, rays), "nothing there");
}

std::string letters_of(const testing::TestParamInfo<const char*>& parameters) {
  std::string name;
  for (const char c : std::string(parameters.param)) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, InstanceBatch,
                         testing::Values("default", "fast", "best", "compact", "binned > wide(4)", "sweep > wide(16)",
                                         "binned > wide(5)", "binned > wide(8) > trace(order=axis)"),
                         letters_of);

}  // namespace
}  // namespace boxwood
