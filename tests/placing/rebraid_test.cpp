// Instances opened where they overlap: the answers of brute force, whatever is opened.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "boxwood/structure.h"
#include "structure/opened_instances.h"
#include "structure/pipeline.h"
#include "support/differential.h"
#include "support/layout_recipes.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

/// `count` instances, in turn of a cube, of loose triangles, and of nothing, at places up to `spread` away.
Scene crowd(std::uint32_t count, float spread) {
  Random random(3);
  Scene scene = test::cube(8);
  scene.meshes.push_back(test::soup(300, 0.3f, 5).meshes[0]);
  scene.meshes.emplace_back();
  scene.instances.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Transform place = Transform::translate(test::random_point(random, spread)) *
                            Transform::rotate(normalize(test::random_point(random, 1)), random.uniform(0, 6));
    scene.instances.push_back({i % 7 == 6 ? 2u : i % 2, place, i % 3 == 0 ? 1u : every_bit});
  }
  return scene;
}

std::vector<Tree> trees_of(const Scene& scene) {
  std::vector<Tree> trees;
  for (const Mesh& mesh : scene.meshes) trees.push_back(tree_of(mesh, Recipe::parse("ploc(block=4) > wide(8)")));
  return trees;
}

TEST(OpenedInstances, AreThePartsOfEveryInstanceWithinTheBudget) {
  const Scene scene = crowd(60, 2);
  const OpenedInstances opened = open_instances(scene, trees_of(scene), 5);
  EXPECT_GT(opened.instances.size(), 60u);
  EXPECT_LE(opened.instances.size(), 300u);
  std::vector<std::vector<std::uint32_t>> triangles(scene.meshes.size());
  for (std::size_t part = 0; part < opened.parts.size(); ++part) {
    auto& of_mesh = triangles[opened.mesh_of[part]];
    of_mesh.insert(of_mesh.end(), opened.parts[part].references.begin(), opened.parts[part].references.end());
  }
  for (std::size_t mesh = 0; mesh < triangles.size(); ++mesh) {
    std::ranges::sort(triangles[mesh]);
    ASSERT_EQ(triangles[mesh].size(), scene.meshes[mesh].triangles.size());
    for (std::uint32_t i = 0; i < triangles[mesh].size(); ++i) ASSERT_EQ(triangles[mesh][i], i);
  }
  // Every instance that has triangles places each part of its mesh once.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> placed, expected;
  for (std::size_t i = 0; i < opened.instances.size(); ++i) {
    placed.emplace_back(opened.numbers[i], opened.instances[i].mesh);
  }
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (std::uint32_t part = 0; part < opened.parts.size(); ++part) {
      if (opened.mesh_of[part] == scene.instances[i].mesh) expected.emplace_back(i, part);
    }
  }
  std::ranges::sort(placed);
  EXPECT_EQ(placed, expected);
}

TEST(OpenedInstances, StayWholeWhereNothingOverlapsOrNothingMayBeAdded) {
  Scene apart = crowd(30, 2);
  for (std::uint32_t i = 0; i < 30; ++i) {
    apart.instances[i].object_to_world.translation = {5.0f * static_cast<float>(i), 0, 0};
  }
  const std::size_t some = open_instances(apart, trees_of(apart), 1).instances.size();
  EXPECT_EQ(open_instances(apart, trees_of(apart), 8).instances.size(), some);
  const Scene close = crowd(30, 1);
  EXPECT_EQ(open_instances(close, trees_of(close), 1).parts.size(), 2u);
}

class Rebraid : public testing::TestWithParam<std::string> {};

TEST_P(Rebraid, AnswersLikeBruteForce) {
  const Scene scene = crowd(60, 1.5f);
  const BruteForce truth(scene);
  const Structure structure = build(scene, GetParam());
  const std::vector<Ray> rays = test::troubling_rays(scene, 300, 4);
  test::expect_brute_force_answers(structure, test::Expected(scene, rays), GetParam());
  for (const Ray& ray : rays) {
    ASSERT_EQ(structure.all_hits(ray), truth.all_hits(ray));
    ASSERT_TRUE(test::same_bits(structure.closest_hit(ray, 2), truth.closest_hit(ray, 2)));
  }
}

std::vector<std::string> rebraided_recipes() {
  std::vector<std::string> out = {"spatial(alpha=0.001) > rebraid(references=6) > wide(8)"};
  for (const std::string& recipe : test::recipe_of_every_layout("binned")) {
    const std::size_t layout = recipe.find(" > ");
    if (recipe.substr(0, layout) == "binned") out.push_back("binned > rebraid(references=6)" + recipe.substr(layout));
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Registered, Rebraid, testing::ValuesIn(rebraided_recipes()));

/// What it is for: where instances lie in each other, a ray tests fewer boxes and triangles.
TEST(RebraidOf, OverlappingInstances_SavesTests) {
  const Scene scene = load("generate:instances(count=200, detail=16, spacing=0.7)");
  const std::vector<Ray> rays = test::troubling_rays(scene, 600, 4);
  const auto tests_of = [&](const char* recipe) {
    std::vector<Hit> hits(rays.size());
    std::vector<RayCounters> counters(rays.size());
    build(scene, recipe).closest_hits_counted(rays, hits, counters);
    std::uint64_t sum = 0;
    for (const RayCounters& counter : counters) sum += counter.node_tests + counter.primitive_tests;
    return sum;
  };
  EXPECT_LT(tests_of("binned > rebraid(references=8) > wide(8)"), tests_of("binned > wide(8)"));
}

TEST(RebraidOf, WhatIsPlacedOrMoves_IsRefused) {
  const Scene scene = crowd(5, 1);
  const std::vector<Structure> parts = {build(test::cube(1))};
  const std::vector<Instance> instances = {{0, {}}};
  EXPECT_THROW(place(parts, instances, "binned > rebraid > wide(8)"), UsageError);
}

}  // namespace
}  // namespace boxwood
