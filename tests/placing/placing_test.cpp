// Structures placed in structures, and masks: on every layout what brute force down all the ways says, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "boxwood/structure.h"
#include "support/concurrent.h"
#include "support/differential.h"
#include "support/layout_recipes.h"
#include "support/rays.h"
#include "support/scenes.h"
#include "support/valid_ray.h"
#include "trace/hit_sink.h"
#include "trace/object_ray.h"

namespace boxwood {
namespace {

constexpr std::uint32_t masks_of_instances[] = {every_bit, 1, 2, 6, 0x80000001u, 0};

/// A scene, or parts in their places; mapped ray by ray like the structures, but without any tree.
struct Assembly {
  std::unique_ptr<BruteForce> scene;
  std::vector<const Assembly*> parts;
  std::vector<Instance> instances;
  std::uint32_t numbers = 0;

  std::vector<Hit> all_hits(const Ray& ray, std::uint32_t mask) const {
    if (scene) return scene->all_hits(ray, mask);
    std::vector<Hit> hits;
    std::uint32_t first = 0;
    for (const Instance& instance : instances) {
      const Assembly& part = *parts[instance.mesh];
      if ((instance.mask & mask) != 0 && test::is_valid(ray)) {
        for (Hit hit : part.all_hits(object_ray(instance.object_to_world.inverse(), ray), mask)) {
          hit.instance += first;
          hits.push_back(hit);
        }
      }
      first += part.numbers;
    }
    std::ranges::sort(hits, comes_before);
    return hits;
  }
};

Transform random_placement(Random& random, float spread) {
  const Transform turn = Transform::rotate(normalize(test::random_point(random, 1)), random.uniform(0, 6)) *
                         Transform::scale({random.uniform(0.6f, 1.4f), random.uniform(-1.4f, -0.6f), 1});
  return Transform::translate(test::random_point(random, spread)) * turn;
}

std::vector<Instance> random_instances(std::uint32_t count, std::uint32_t parts, float spread, std::uint64_t seed) {
  Random random(seed);
  std::vector<Instance> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    out.push_back({i % parts, random_placement(random, spread), masks_of_instances[random.below(6)]});
    if (i % 7 == 3) out.push_back(out.back());  // twice in the same place
  }
  return out;
}

/// Three levels of instances above a mesh, and parts of other depths beside them.
class World {
 public:
  explicit World(const std::string& recipe) {
    Scene& one = scenes_[0] = test::soup(12, 0.4f, 3);
    Scene& many = scenes_[1] = test::soup(9, 0.5f, 4);
    Scene& none = scenes_[2] = test::scene_of({}, {});
    many.meshes.push_back(test::cube(1).meshes[0]);
    many.instances = random_instances(5, 2, 1.5f, 7);
    for (const Scene* scene : {&one, &many, &none}) {
      structures_.push_back(build(*scene, recipe));
      assemblies_.push_back(std::make_unique<Assembly>());
      assemblies_.back()->scene = std::make_unique<BruteForce>(*scene);
      assemblies_.back()->numbers = static_cast<std::uint32_t>(scene->instances.size());
    }
    add(recipe, {0, 1, 2}, random_instances(6, 3, 3, 11));      // 3: two levels of instances
    add(recipe, {3, 0, 1}, random_instances(5, 3, 6, 12));      // 4: three
    add(recipe, {4, 1, 3, 0}, random_instances(7, 4, 12, 13));  // 5: four
  }
  const Structure& top() const { return structures_.back(); }
  const Assembly& truth() const { return *assemblies_.back(); }

 private:
  void add(const std::string& recipe, const std::vector<std::size_t>& of, std::vector<Instance> instances) {
    std::vector<Structure> parts;
    auto assembly = std::make_unique<Assembly>();
    for (const std::size_t part : of) {
      parts.push_back(structures_[part]);
      assembly->parts.push_back(assemblies_[part].get());
    }
    for (const Instance& instance : instances) assembly->numbers += assembly->parts[instance.mesh]->numbers;
    structures_.push_back(place(parts, instances, recipe));
    assembly->instances = std::move(instances);
    assemblies_.push_back(std::move(assembly));
  }

  Scene scenes_[3];  // `compressed` reads their meshes
  std::vector<Structure> structures_;
  std::vector<std::unique_ptr<Assembly>> assemblies_;
};

/// Towards where the world is thick, from all sides; some alike, so that they enter instances together.
std::vector<Ray> rays_into(const Box& box, std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    Ray ray;
    const bool alike = i % 3 == 0;
    const Vec3 eye{2 * box.upper.x, box.upper.y, 3 * box.upper.z};
    ray.origin = alike ? eye : test::point_around(box, random, 0.8f);
    ray.direction = test::point_around(box, random, alike ? 0.1f : 0.3f) - ray.origin;
    if (i % 11 == 0) ray.t_far = random.uniform(0, 1);
    rays.push_back(ray);
  }
  for (const Ray& ray : test::invalid_rays({0, 0, 5}, {0, 0, -1})) rays.push_back(ray);
  return rays;
}

std::vector<std::uint32_t> some_masks(std::size_t count) {
  constexpr std::uint32_t masks[] = {every_bit, 1, 2, 4, 3, 0, 0x80000000u};
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(masks[i % std::size(masks)]);
  return out;
}

/// Every layout, over a tree that suits it.
std::vector<std::string> recipes() {
  std::vector<std::string> out = {
      "default", "fast", "compact", "binned > wide(4)", "sweep > wide(16)", "binned > wide(5) > trace(order=axis)"};
  for (const std::string& each : test::recipe_of_every_layout("binned")) out.push_back(each);
  return out;
}

struct Expectation {
  std::vector<Ray> rays;
  std::vector<std::uint32_t> masks;
  std::vector<std::vector<Hit>> hits;

  Expectation(const Assembly& truth, std::vector<Ray> asked, std::vector<std::uint32_t> with)
      : rays(std::move(asked)), masks(std::move(with)) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits.push_back(truth.all_hits(rays[i], masks.empty() ? every_bit : masks[i]));
    }
  }
  Hit closest(std::size_t i) const { return hits[i].empty() ? Hit{} : hits[i].front(); }
  std::uint32_t mask(std::size_t i) const { return masks.empty() ? every_bit : masks[i]; }
};

void expect_all_queries(const Structure& structure, const Expectation& expected) {
  const std::size_t count = expected.rays.size();
  std::vector<Hit> batch(count), filtered(count), firsts(2 * count);
  std::vector<std::uint8_t> blocked(count), filtered_blocked(count);
  const auto takes = [](const Hit& hit) { return hit.primitive % 3 == 1; };
  structure.closest_hits(expected.rays, batch, expected.masks);
  structure.any_hits(expected.rays, blocked, expected.masks);
  structure.closest_hits(expected.rays, filtered, takes, expected.masks);
  structure.any_hits(expected.rays, filtered_blocked, takes, expected.masks);
  structure.first_hits(expected.rays, 2, firsts, expected.masks);
  const HitLists all = structure.all_hits(expected.rays, expected.masks);
  for (std::size_t i = 0; i < count; ++i) {
    const Hit hit = expected.closest(i);
    const auto taken = std::ranges::find_if(expected.hits[i], takes);
    const Hit first_taken = taken == expected.hits[i].end() ? Hit{} : *taken;
    ASSERT_TRUE(test::same_bits(batch[i], hit)) << i << ": " << test::describe(expected.rays[i], hit, batch[i]);
    ASSERT_TRUE(test::same_bits(structure.closest_hit(expected.rays[i], expected.mask(i)), hit)) << i;
    ASSERT_EQ(blocked[i] != 0, hit.valid()) << i;
    ASSERT_EQ(structure.any_hit(expected.rays[i], expected.mask(i)), hit.valid()) << i;
    ASSERT_TRUE(test::same_bits(filtered[i], first_taken)) << i;
    ASSERT_EQ(filtered_blocked[i] != 0, first_taken.valid()) << i;
    ASSERT_EQ(all[i].size(), expected.hits[i].size()) << i;
    for (std::size_t n = 0; n < all[i].size(); ++n) ASSERT_TRUE(test::same_bits(all[i][n], expected.hits[i][n])) << i;
    for (std::size_t n = 0; n < 2; ++n) {
      const Hit nth = n < expected.hits[i].size() ? expected.hits[i][n] : Hit{};
      ASSERT_TRUE(test::same_bits(firsts[2 * i + n], nth)) << i;
    }
  }
}

class Placing : public testing::TestWithParam<std::string> {};

TEST_P(Placing, FourLevelsAnswerLikeBruteForceDownAllTheWays) {
  const World world(GetParam());
  const Expectation expected(world.truth(), rays_into(world.top().report().bounds, 900, 5), {});
  std::size_t hit = 0, tied = 0;
  for (const auto& hits : expected.hits) {
    hit += hits.empty() ? 0 : 1;
    for (std::size_t n = 1; n < hits.size(); ++n) tied += hits[n].t == hits[n - 1].t ? 1 : 0;
  }
  ASSERT_GT(hit, 60u);
  ASSERT_GT(tied, 5u);
  expect_all_queries(world.top(), expected);
  std::vector<Hit> counted(expected.rays.size());
  std::vector<RayCounters> counters(expected.rays.size());
  world.top().closest_hits_counted(expected.rays, counted, counters);
  for (std::size_t i = 0; i < counted.size(); ++i) ASSERT_TRUE(test::same_bits(counted[i], expected.closest(i))) << i;
}

TEST_P(Placing, MasksHideInstancesOnAllLevels) {
  const World world(GetParam());
  std::vector<Ray> rays = rays_into(world.top().report().bounds, 900, 6);
  std::vector<std::uint32_t> masks = some_masks(rays.size());
  expect_all_queries(world.top(), Expectation(world.truth(), std::move(rays), std::move(masks)));
}

TEST_P(Placing, MasksOfASceneHideItsInstances) {
  Scene scene = test::soup(12, 0.4f, 3);
  scene.instances = random_instances(20, 1, 2, 5);
  Assembly truth;
  truth.scene = std::make_unique<BruteForce>(scene);
  const Structure structure = build(scene, GetParam());
  std::vector<Ray> rays = test::troubling_rays(scene, 200, 4);
  std::vector<std::uint32_t> masks = some_masks(rays.size());
  expect_all_queries(structure, Expectation(truth, rays, std::move(masks)));
  expect_all_queries(structure, Expectation(truth, rays, {}));
}

std::string name_of(const testing::TestParamInfo<std::string>& parameters) {
  std::string name = std::to_string(parameters.index);
  for (const char c : parameters.param) name += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : "";
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registered, Placing, testing::ValuesIn(recipes()), name_of);

TEST(PlacingOf, ThousandsOfRaysThatEnterTogether_AreAnsweredLikeSingleOnes) {
  const World world("default");
  const std::vector<Ray> rays = rays_into(world.top().report().bounds, 4000, 8);
  const std::vector<std::uint32_t> masks = some_masks(rays.size());
  std::vector<Hit> hits(rays.size());
  for (const bool masked : {false, true}) {
    world.top().closest_hits(rays, hits, masked ? Structure::Masks(masks) : Structure::Masks());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(test::same_bits(hits[i], world.top().closest_hit(rays[i], masked ? masks[i] : every_bit))) << i;
    }
  }
}

TEST(ConcurrentQueries, OfPlacedStructuresAnswerAsAlone) {
  for (const char* recipe : {"default", "median > binary", "compact"}) {
    const World world(recipe);
    EXPECT_FALSE(test::answers_differ(world.top(), rays_into(world.top().report().bounds, 200, 9))) << recipe;
  }
}

/// The world transforms along a path, outermost first, all of one mesh.
TEST(PlacingOf, APath_LeadsToTheInstanceThatAHitNames) {
  const Scene mesh = test::cube(1);
  const Structure one = build(mesh);
  const auto at = [](float x) { return Transform::translate({x, 0, 0}); };
  const std::vector<Instance> three = {{0, at(0), every_bit}, {0, at(4), every_bit}, {0, at(8), every_bit}};
  const std::vector<Instance> two = {{0, at(0), every_bit}, {1, at(20), every_bit}};
  const Structure row = place(std::vector{one}, three);
  const Structure mixed = place(std::vector{row, one}, two);
  const std::vector<Instance> outer = {{1, at(100), every_bit}, {0, at(200), every_bit}, {0, at(300), every_bit}};
  const Structure top = place(std::vector{mixed, one}, outer);
  EXPECT_EQ(row.instance_numbers(), 3u);
  EXPECT_EQ(mixed.instance_numbers(), 4u);
  EXPECT_EQ(top.instance_numbers(), 9u);
  const auto path_at = [&](float x) {
    const Hit hit = top.closest_hit({{x, 0.1f, 9}, 0, {0, 0, -1}});
    EXPECT_TRUE(hit.valid()) << x;
    return top.instance_path(hit.instance);
  };
  using Path = std::vector<std::uint32_t>;
  EXPECT_EQ(path_at(100), Path({0}));
  EXPECT_EQ(path_at(200), Path({1, 0, 0}));
  EXPECT_EQ(path_at(208), Path({1, 0, 2}));
  EXPECT_EQ(path_at(220), Path({1, 1}));
  EXPECT_EQ(path_at(304), Path({2, 0, 1}));
  EXPECT_THROW(top.instance_path(9), UsageError);
  EXPECT_EQ(build(mesh).instance_path(0), Path());
  EXPECT_EQ(build(test::instances()).instance_path(7), Path({7}));
}

TEST(PlacingOf, WhatCannotBePlaced_IsRefusedWithAReason) {
  const std::vector<Structure> parts = {build(test::cube(1))};
  EXPECT_THROW(place(parts, std::vector<Instance>{{1, {}}}), UsageError);
  EXPECT_THROW(place(parts, std::vector<Instance>{{0, Transform::scale({1, 0, 1})}}), Error);
  std::vector<Structure> deeper = parts;
  for (int level = 0; level < 6; ++level) deeper = {place(deeper, std::vector<Instance>{{0, {}}})};
  EXPECT_TRUE(deeper[0].any_hit({{0, 0, 5}, 0, {0, 0, -1}}));
  std::vector<Ray> rays(2000, {{0, 0, 5}, 0, {0, 0, -1}});
  std::vector<Hit> hits(rays.size());
  deeper[0].closest_hits(rays, hits);
  EXPECT_EQ(std::ranges::count_if(hits, [](const Hit& hit) { return hit.t == 4; }), 2000);
  EXPECT_THROW(place(deeper, std::vector<Instance>{{0, {}}}), UsageError);
#ifdef BOXWOOD_EMBREE
  EXPECT_THROW(place(std::vector{build(test::cube(1), "embree")}, std::vector<Instance>{{0, {}}}), UsageError);
  EXPECT_THROW(place(parts, std::vector<Instance>{{0, {}}}, "embree"), UsageError);
#endif
}

TEST(PlacingOf, NothingPlacedOrNothingInIt_HitsNothing) {
  const std::vector<Structure> parts = {build(test::scene_of({}, {}))};
  for (const Structure& structure : {place(parts, {}), place({}, {}), place(parts, std::vector<Instance>{{0, {}}})}) {
    EXPECT_FALSE(structure.any_hit({{0, 0, 5}, 0, {0, 0, -1}}));
    EXPECT_TRUE(structure.all_hits({{0, 0, 5}, 0, {0, 0, -1}}, 5).empty());
    EXPECT_TRUE(structure.report().bounds.empty());
  }
}

TEST(MasksOf, AMeshThatStandsAlone_IsSeenByAnyBit) {
  const Structure structure = build(test::cube(1));
  const Ray ray{{0, 0, 5}, 0, {0, 0, -1}};
  EXPECT_TRUE(structure.closest_hit(ray, 4).valid());
  EXPECT_FALSE(structure.closest_hit(ray, 0).valid());
  EXPECT_FALSE(structure.any_hit(ray, 0));
  EXPECT_TRUE(structure.all_hits(ray, 0).empty());
  Scene hidden = test::cube(1);
  hidden.instances[0].mask = 2;
  EXPECT_TRUE(build(hidden).any_hit(ray, 2));
  EXPECT_FALSE(build(hidden).any_hit(ray, 1));
}

TEST(MasksOf, WrongLengthsAndPeers_AreRefused) {
  const Structure structure = build(test::cube(1));
  std::vector<Ray> rays(3);
  std::vector<Hit> hits(3);
  const std::vector<std::uint32_t> two(2, 1), three(3, 1);
  EXPECT_THROW(structure.closest_hits(rays, hits, two), UsageError);
  EXPECT_THROW(structure.all_hits(rays, two), UsageError);
#ifdef BOXWOOD_EMBREE
  const Structure peer = build(test::cube(1), "embree");
  EXPECT_THROW(peer.closest_hits(rays, hits, three), UsageError);
  EXPECT_THROW(peer.any_hit(rays[0], 1), UsageError);
  Scene hidden = test::cube(1);
  hidden.instances[0].mask = 2;
  EXPECT_THROW(build(hidden, "embree"), UsageError);
#endif
}

}  // namespace
}  // namespace boxwood
