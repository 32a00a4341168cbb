#include "measure/compare.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "measure/trace_rays.h"
#include "recipe/stage.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

using namespace testing_scenes;

CompareSettings quick() {
  CompareSettings settings;
  settings.repeats = 6;
  settings.build_repeats = 3;
  return settings;
}

std::vector<Recipe> recipes_of(std::initializer_list<const char*> texts) {
  std::vector<Recipe> recipes;
  for (const char* text : texts) recipes.push_back(Recipe::parse(text));
  return recipes;
}

std::vector<RaySet> ray_sets_of(const Scene& scene) {
  RaySetSettings settings;
  settings.camera = outside_camera();
  settings.width = settings.height = 64;
  settings.random_rays = 10000;
  const std::vector<std::string> kinds = {"primary", "ao", "random"};
  return make_ray_sets(scene, build(scene, "median > binary"), settings, kinds);
}

TEST(Compare, HasARowPerRecipeAndRaySetThatAgree) {
  for (const Scene& scene : {soup_scene(), instanced_scene()}) {
    const auto recipes = recipes_of({"median > binary", "middle > wide(4)", "default"});
    const auto sets = ray_sets_of(scene);
    const Comparison comparison = compare(scene, recipes, sets, quick());
    EXPECT_EQ(comparison.triangles, scene.placed_triangles());
    EXPECT_TRUE(comparison.disagreements.empty());
    ASSERT_EQ(comparison.rows.size(), recipes.size());
    for (std::size_t i = 0; i < recipes.size(); ++i) {
      const RecipeRow& row = comparison.rows[i];
      EXPECT_EQ(row.recipe, recipes[i].text());
      EXPECT_EQ(row.build_ms.n, 3u);
      EXPECT_GT(row.build_ms.low, 0);
      EXPECT_GT(row.bytes_per_triangle, 0);
      EXPECT_GT(row.sah_cost, 0);
      ASSERT_EQ(row.rays.size(), sets.size());
      for (std::size_t s = 0; s < sets.size(); ++s) {
        EXPECT_EQ(row.rays[s].kind, sets[s].kind);
        EXPECT_EQ(row.rays[s].rays, sets[s].rays.size());
        EXPECT_EQ(row.rays[s].mrays_per_s.n, 6u);
        EXPECT_GT(row.rays[s].mrays_per_s.low, 0);
        EXPECT_LE(row.rays[s].ratio.low, row.rays[s].ratio.high);
        EXPECT_EQ(row.rays[s].hits, comparison.rows[0].rays[s].hits);
        EXPECT_EQ(row.rays[s].mismatches, 0u);
      }
    }
    EXPECT_EQ(comparison.rows[0].rays[0].ratio.median, 1);
    EXPECT_EQ(comparison.rows[0].rays[0].ratio_p_value, 1);
    EXPECT_GT(comparison.rows[0].rays[0].hits, 0u);
  }
}

TEST(Compare, CountsWhatTheRaysCost) {
  const Scene scene = soup_scene();
  const auto sets = ray_sets_of(scene);
  const Comparison comparison = compare(scene, recipes_of({"median > binary"}), sets, quick());
  const Structure structure = build(scene, "median > binary");
  for (std::size_t s = 0; s < sets.size(); ++s) {
    double steps = 0, leaves = 0, node_tests = 0, primitive_tests = 0;
    for (const Ray& ray : sets[s].rays) {
      Hit hit;
      std::uint8_t blocked;
      RayCounters counters;
      if (sets[s].query == Query::closest_hit) {
        structure.closest_hits_counted({&ray, 1}, {&hit, 1}, {&counters, 1});
      } else {
        structure.any_hits_counted({&ray, 1}, {&blocked, 1}, {&counters, 1});
      }
      steps += counters.steps, leaves += counters.leaves;
      node_tests += counters.node_tests, primitive_tests += counters.primitive_tests;
    }
    const RayKindRow& row = comparison.rows[0].rays[s];
    const auto rays = static_cast<double>(sets[s].rays.size());
    EXPECT_DOUBLE_EQ(row.steps_per_ray, steps / rays);
    EXPECT_DOUBLE_EQ(row.leaves_per_ray, leaves / rays);
    EXPECT_DOUBLE_EQ(row.node_tests_per_ray, node_tests / rays);
    EXPECT_DOUBLE_EQ(row.primitive_tests_per_ray, primitive_tests / rays);
  }
}

TEST(Compare, CountsAndHitsAreTheSameOnAnyNumberOfThreads) {
  const Scene scene = soup_scene();
  const auto sets = ray_sets_of(scene);
  const auto recipes = recipes_of({"median > binary"});
  CompareSettings settings = quick();
  const RecipeRow one = compare(scene, recipes, sets, settings).rows[0];
  settings.threads = 3;
  const RecipeRow three = compare(scene, recipes, sets, settings).rows[0];
  for (std::size_t s = 0; s < sets.size(); ++s) {
    EXPECT_EQ(one.rays[s].hits, three.rays[s].hits);
    EXPECT_EQ(one.rays[s].node_tests_per_ray, three.rays[s].node_tests_per_ray);
    EXPECT_EQ(one.rays[s].primitive_tests_per_ray, three.rays[s].primitive_tests_per_ray);
  }
}

TEST(Compare, PeersAgreeWithUs) {
  const Scene scene = soup_scene();
  for (const Stage& stage : stages()) {
    if (stage.kind != StageKind::peer) continue;
    const Comparison comparison =
        compare(scene, recipes_of({stage.name.c_str(), "median > binary"}), ray_sets_of(scene), quick());
    EXPECT_TRUE(comparison.rows[0].peer);
    EXPECT_EQ(comparison.disagreements, std::vector<std::string>());
  }
}

TEST(Compare, SkipsFurtherBuildsThatAreTooDear) {
  const Scene scene = soup_scene();
  CompareSettings settings = quick();
  settings.build_seconds = 0;
  const Comparison comparison = compare(scene, recipes_of({"median > binary"}), ray_sets_of(scene), settings);
  EXPECT_EQ(comparison.rows[0].build_ms.n, 1u);
}

TEST(Compare, ARaySetWithoutRaysHasNoSpeed) {
  const Scene scene = soup_scene();
  const std::vector<RaySet> sets = {{"shadow", Query::any_hit, {}}};
  const Comparison comparison = compare(scene, recipes_of({"median > binary"}), sets, quick());
  EXPECT_EQ(comparison.rows[0].rays[0].rays, 0u);
  EXPECT_EQ(comparison.rows[0].rays[0].mrays_per_s.n, 0u);
}

TEST(Compare, NeedsRecipesAndDistinctRaySets) {
  const Scene scene = plane_scene();
  const auto recipes = recipes_of({"median > binary"});
  std::vector<RaySet> sets = {{"random", Query::any_hit, {Ray{}}}};
  EXPECT_THROW(compare(scene, {}, sets, quick()), UsageError);
  EXPECT_THROW(compare(scene, recipes, {}, quick()), UsageError);
  sets.push_back(sets[0]);
  EXPECT_THROW(compare(scene, recipes, sets, quick()), UsageError);
}

TEST(Compare, ReportsProgressThatNeverFallsAndStopsWhenAskedTo) {
  class Recorder : public ProgressSink {
   public:
    bool report(double fraction, std::string_view) override {
      fractions.push_back(fraction);
      return fraction < stop_at;
    }
    std::vector<double> fractions;
    double stop_at = 2;
  } recorder;
  const Scene scene = soup_scene();
  const auto recipes = recipes_of({"median > binary", "middle > binary"});
  const auto sets = ray_sets_of(scene);
  compare(scene, recipes, sets, quick(), &recorder);
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions));
  EXPECT_DOUBLE_EQ(recorder.fractions.back(), 1);
  recorder.stop_at = 0.5;
  EXPECT_THROW(compare(scene, recipes, sets, quick(), &recorder), Cancelled);
}

TEST(Mismatches, AreCountedToTheBitOrWithATolerance) {
  const RaySet set{"random", Query::closest_hit, std::vector<Ray>(4)};
  Answers a(set), b(set);
  a.hits[0] = b.hits[0] = {1, 0, 0, 5, 0};
  a.hits[1] = {1, 0, 0, 5, 0}, b.hits[1] = {1.00001f, 0, 0, 6, 0};
  a.hits[2] = {1, 0, 0, 5, 0}, b.hits[2] = {1.1f, 0, 0, 5, 0};
  a.hits[3] = {1, 0, 0, 5, 0};
  EXPECT_EQ(mismatches(a, b, true), 3u);
  EXPECT_EQ(mismatches(a, b, false), 2u);

  const RaySet any{"ao", Query::any_hit, std::vector<Ray>(2)};
  Answers c(any), d(any);
  c.blocked = {1, 0};
  d.blocked = {1, 1};
  EXPECT_EQ(mismatches(c, d, false), 1u);
}

}  // namespace
}  // namespace boxwood
