// Primitives of the caller's own kind: what asking about every one of them says, to the bit.
#include "boxwood/custom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "recipe/stage.h"
#include "support/concurrent.h"
#include "support/differential.h"
#include "support/rays.h"
#include "support/scenes.h"
#include "support/valid_ray.h"
#include "trace/hit_sink.h"
#include "trace/object_ray.h"

namespace boxwood {
namespace {

struct Ball {
  Vec3 center;
  float radius;
};

class Balls final : public CustomPrimitives {
 public:
  explicit Balls(std::vector<Ball> balls) : balls_(std::move(balls)) {}

  std::uint32_t size() const override { return static_cast<std::uint32_t>(balls_.size()); }
  Box bounds(std::uint32_t primitive) const override {
    const auto& [c, r] = balls_[primitive];
    return {c - Vec3{r, r, r}, c + Vec3{r, r, r}};
  }
  void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> primitives,
                 std::span<CustomHit> hits) const override {
    EXPECT_EQ(rays.size(), primitives.size());
    EXPECT_EQ(rays.size(), hits.size());
    for (std::size_t i = 0; i < rays.size(); ++i) intersect_one(rays[i], balls_[primitives[i]], hits[i]);
    largest_call = std::max<std::size_t>(largest_call.load(), rays.size());
  }

  /// t in double, so that roots are where the box says.
  static void intersect_one(const Ray& ray, const Ball& ball, CustomHit& hit) {
    const auto dot_of = [](const Vec3& a, const Vec3& b) {
      return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y + static_cast<double>(a.z) * b.z;
    };
    const Vec3 from = ray.origin - ball.center;
    const double a = dot_of(ray.direction, ray.direction), b = dot_of(from, ray.direction);
    const double c = dot_of(from, from) - static_cast<double>(ball.radius) * ball.radius;
    const double under = b * b - a * c;
    if (!(under >= 0)) return;
    for (const double sign : {-1.0, 1.0}) {
      const auto t = static_cast<float>((-b + sign * std::sqrt(under)) / a);
      if (!(t >= ray.t_near && t <= ray.t_far)) continue;
      hit = {t, static_cast<float>(sign), ball.radius};
      return;
    }
  }
  const std::vector<Ball>& balls() const { return balls_; }

  mutable std::atomic<std::size_t> largest_call = 0;

 private:
  std::vector<Ball> balls_;
};

std::vector<Ball> random_balls(std::uint32_t count, std::uint64_t seed, float size = 0.2f) {
  Random random(seed);
  std::vector<Ball> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    out.push_back({test::random_point(random, 1), random.uniform(0.1f, 1) * size});
    if (i % 10 == 4) out.push_back(out.back());  // ties
  }
  return out;
}

std::vector<Hit> all_of(const Balls& balls, const Ray& ray, std::uint32_t instance = 0) {
  std::vector<Hit> hits;
  for (std::uint32_t i = 0; i < balls.size() && test::is_valid(ray); ++i) {
    for (Ray rest = ray;;) {
      CustomHit hit;
      Balls::intersect_one(rest, balls.balls()[i], hit);
      if (!(hit.t >= rest.t_near && hit.t <= rest.t_far) || std::isinf(hit.t)) break;
      hits.push_back({hit.t, hit.u, hit.v, i, instance});
      rest.t_near = std::nextafter(hit.t, std::numeric_limits<float>::infinity());
    }
  }
  std::ranges::sort(hits, comes_before);
  return hits;
}

std::vector<Ray> rays_at_balls(std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool alike = i % 2 == 0;
    Ray ray{alike ? Vec3{0, 0, 4} : test::random_point(random, 1.5f), 0, {}};
    ray.direction = test::random_point(random, alike ? 0.8f : 1) - (alike ? Vec3{0, 0, 3} : Vec3{});
    if (i % 9 == 0) ray.t_far = random.uniform(0, 2);
    if (i % 9 == 4) ray.t_near = random.uniform(-2, 1);
    rays.push_back(ray);
  }
  for (const Ray& ray : test::invalid_rays({0, 0, 4}, {0, 0, -1})) rays.push_back(ray);
  return rays;
}

void expect_answers(const Structure& structure, const std::vector<Ray>& rays,
                    const std::vector<std::vector<Hit>>& expected) {
  std::vector<Hit> batch(rays.size()), counted(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  std::vector<RayCounters> counters(rays.size());
  structure.closest_hits(rays, batch);
  structure.any_hits(rays, blocked);
  structure.closest_hits_counted(rays, counted, counters);
  const HitLists lists = structure.all_hits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit first = expected[i].empty() ? Hit{} : expected[i].front();
    ASSERT_TRUE(test::same_bits(batch[i], first)) << i << ": " << test::describe(rays[i], first, batch[i]);
    ASSERT_TRUE(test::same_bits(counted[i], first)) << i;
    ASSERT_TRUE(test::same_bits(structure.closest_hit(rays[i]), first)) << i;
    ASSERT_EQ(blocked[i] != 0, first.valid()) << i;
    ASSERT_EQ(structure.any_hit(rays[i]), first.valid()) << i;
    ASSERT_EQ(lists[i].size(), expected[i].size()) << i;
    for (std::size_t n = 0; n < lists[i].size(); ++n) ASSERT_TRUE(test::same_bits(lists[i][n], expected[i][n])) << i;
  }
}

class CustomPrimitivesOf : public testing::TestWithParam<const char*> {};

TEST_P(CustomPrimitivesOf, AnyNumberAnswerLikeAskingAboutEachOfThem) {
  for (const std::uint32_t count : {0u, 1u, 2u, 30u, 1000u}) {
    const auto balls = std::make_shared<const Balls>(random_balls(count, 5 + count));
    const std::vector<Ray> rays = rays_at_balls(700, 3);
    std::vector<std::vector<Hit>> expected;
    for (const Ray& ray : rays) expected.push_back(all_of(*balls, ray));
    expect_answers(build(balls, GetParam()), rays, expected);
    if (count == 1000) {
      EXPECT_GT(balls->largest_call, 100u);
    }
  }
}

/// More of them in one place than a ray of a batch remembers, and leaves of many.
TEST_P(CustomPrimitivesOf, ManyInOnePlace) {
  const auto balls = std::make_shared<const Balls>(std::vector<Ball>(600, {{0, 0, 0}, 0.5f}));
  const std::vector<Ray> rays = rays_at_balls(40, 3);
  std::vector<std::vector<Hit>> expected;
  for (const Ray& ray : rays) expected.push_back(all_of(*balls, ray));
  expect_answers(build(balls, GetParam()), rays, expected);
}

/// Triangles, balls, and both together once more, in one structure.
TEST_P(CustomPrimitivesOf, TheyMixWithTrianglesInOneScene) {
  const auto balls = std::make_shared<const Balls>(random_balls(60, 8));
  const Scene soup = test::soup(60, 0.4f, 9);
  const std::vector<Structure> parts = {build(soup, GetParam()), build(balls, GetParam())};
  const Transform turned = Transform::translate({0.5f, 0, 0}) * Transform::rotate({0, 0, 1}, 1);
  const std::vector<Instance> inner = {{0, {}, 1}, {1, turned, 2}};
  const Structure both = place(parts, inner, GetParam());
  const Transform shrunk = Transform::translate({0, 1.5f, 0}) * Transform::scale({0.5f, 0.5f, -0.5f});
  const std::vector<Structure> outer_parts = {both, parts[1]};
  const std::vector<Instance> outer = {{0, {}}, {0, shrunk}, {1, shrunk}};
  const Structure top = place(outer_parts, outer, GetParam());

  const BruteForce triangles(soup);
  const std::vector<Ray> rays = rays_at_balls(500, 12);
  std::vector<std::vector<Hit>> expected;
  for (const Ray& ray : rays) {
    std::vector<Hit>& hits = expected.emplace_back();
    const auto add = [&](std::vector<Hit> more, std::uint32_t instance) {
      for (Hit& hit : more) hit.instance = instance;
      hits.insert(hits.end(), more.begin(), more.end());
    };
    if (!test::is_valid(ray)) continue;
    for (std::uint32_t o = 0; o < 2; ++o) {
      const Ray mapped = object_ray(outer[o].object_to_world.inverse(), ray);
      add(triangles.all_hits(object_ray(Transform{}.inverse(), mapped)), 2 * o);
      add(all_of(*balls, object_ray(turned.inverse(), mapped)), 2 * o + 1);
    }
    add(all_of(*balls, object_ray(shrunk.inverse(), ray)), 4);
    std::ranges::sort(hits, comes_before);
  }
  expect_answers(top, rays, expected);
  EXPECT_EQ(top.instance_path(3), (std::vector<std::uint32_t>{1, 1}));
  // Only the balls of the inner ones are seen by a ray of bit 2.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto is_ball = [](const Hit& hit) { return hit.instance % 2 == 1 || hit.instance == 4; };
    const auto first = std::ranges::find_if(expected[i], is_ball);
    const Hit hit = first == expected[i].end() ? Hit{} : *first;
    ASSERT_TRUE(test::same_bits(top.closest_hit(rays[i], 2), hit)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Recipes, CustomPrimitivesOf,
                         testing::Values("default", "fast", "compact", "binned > wide(4)", "sweep > wide(16)",
                                         "median > wide(3)"),
                         [](const auto& parameters) { return std::to_string(parameters.index); });

TEST(ConcurrentQueries, OfCustomPrimitivesAnswerAsAlone) {
  const auto balls = std::make_shared<const Balls>(random_balls(300, 5));
  for (const char* recipe : {"default", "compact"}) {
    EXPECT_FALSE(test::answers_differ(build(balls, recipe), rays_at_balls(200, 3))) << recipe;
  }
}

TEST(CustomPrimitivesWith, BoxesThatAreNoBoxes_AreLeftOut) {
  std::vector<Ball> balls = {
      {{0, 0, 0}, 0.5f}, {{NAN, 0, 0}, 1}, {{0, 0, 0}, -1}, {{INFINITY, 0, 0}, 1}, {{0, 1e13f, 0}, 1}};
  const Structure structure = build(std::make_shared<const Balls>(balls));
  EXPECT_EQ(structure.report().primitives, 1u);
  EXPECT_EQ(structure.report().left_out, 4u);
  EXPECT_EQ(structure.closest_hit({{0, 0, 2}, 0, {0, 0, -1}}).t, 1.5f);
}

/// Answers NaN, too near, too far, or throws.
class Unruly final : public CustomPrimitives {
 public:
  std::uint32_t size() const override { return 4; }
  Box bounds(std::uint32_t) const override { return {{-1, -1, -1}, {1, 1, 1}}; }
  void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> primitives,
                 std::span<CustomHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (throws) throw Error("stop");
      const float answers[] = {NAN, -5, 1e30f, INFINITY};
      hits[i].t = answers[primitives[i]];
    }
  }
  bool throws = false;
};

TEST(CustomPrimitivesWith, AnswersOutOfRange_AreMisses) {
  const Structure structure = build(std::make_shared<const Unruly>());
  const Ray ray{{0, 0, 5}, 0, {0, 0, -1}, 100};
  EXPECT_FALSE(structure.closest_hit(ray).valid());
  EXPECT_TRUE(structure.all_hits(ray).empty());
}

TEST(CustomPrimitivesWith, ExceptionsOfTheirs_EndTheQuery) {
  const auto unruly = std::make_shared<Unruly>();
  const Structure structure = build(std::shared_ptr<const CustomPrimitives>(unruly));
  unruly->throws = true;
  const std::vector<Ray> rays(50, {{0, 0, 5}, 0, {0, 0, -1}});
  std::vector<Hit> hits(rays.size());
  EXPECT_THROW(structure.closest_hits(rays, hits), Error);
  EXPECT_THROW(structure.any_hit(rays[0]), Error);
}

TEST(CustomPrimitivesWith, RecipesThatCannotHoldThem_AreRefused) {
  const auto balls = std::make_shared<const Balls>(random_balls(5, 1));
  for (const Stage& stage : stages()) {
    if (stage.kind != StageKind::layout || stage.custom) continue;
    std::string recipe = "binned > " + stage.name;
    try {
      Recipe::parse(recipe);
    } catch (const UsageError&) {
      recipe = "octree > " + stage.name;
    }
    EXPECT_THROW(build(balls, recipe), UsageError) << recipe;
  }
  for (const char* recipe : {"binned > wide(8) > trace(order=axis)", "sweep(k=32) > wide(32)"}) {
    EXPECT_THROW(build(balls, recipe), UsageError) << recipe;
  }
  EXPECT_THROW(build(std::shared_ptr<const CustomPrimitives>()), UsageError);
#ifdef BOXWOOD_EMBREE
  EXPECT_THROW(build(balls, "embree"), UsageError);
#endif
}

}  // namespace
}  // namespace boxwood
