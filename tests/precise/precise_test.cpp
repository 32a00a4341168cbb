// Structures in double precision: what testing every triangle in double says, to the bit.
#include "boxwood/precise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <vector>

#include "boxwood/error.h"
#include "precise/double_meshes.h"
#include "trace/precise_brute_force.h"

namespace boxwood {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

PreciseStructure build_of(const test::DoubleMesh& mesh, const char* recipe = "default", unsigned threads = 0) {
  return build_precise(mesh.vertices, mesh.triangles, recipe, {.threads = threads});
}

bool same_bits(const PreciseHit& a, const PreciseHit& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return a.primitive == b.primitive && bits(a.t) == bits(b.t) && bits(a.u) == bits(b.u) && bits(a.v) == bits(b.v);
}

std::string describe(const PreciseRay& ray, const PreciseHit& hit) {
  return testing::PrintToString(std::vector{ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                                            ray.direction.z, ray.t_near, ray.t_far, hit.t}) +
         " " + std::to_string(hit.primitive);
}

void expect_brute_force(const test::DoubleMesh& mesh, const PreciseStructure& structure,
                        const std::vector<PreciseRay>& rays, std::size_t least_hits) {
  const PreciseBruteForce truth(mesh.vertices, mesh.triangles);
  std::vector<PreciseHit> batch(rays.size()), counted(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  std::vector<RayCounters> counters(rays.size());
  structure.closest_hits(rays, batch);
  structure.any_hits(rays, blocked);
  structure.closest_hits_counted(rays, counted, counters);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const PreciseHit expected = truth.closest_hit(rays[i]);
    ASSERT_TRUE(same_bits(batch[i], expected)) << i << ": " << describe(rays[i], expected) << batch[i].t;
    ASSERT_TRUE(same_bits(counted[i], expected)) << i;
    ASSERT_TRUE(same_bits(structure.closest_hit(rays[i]), expected)) << i;
    ASSERT_EQ(blocked[i] != 0, expected.valid()) << i << ": " << describe(rays[i], expected);
    ASSERT_EQ(structure.any_hit(rays[i]), expected.valid()) << i;
    hits += expected.valid() ? 1 : 0;
  }
  EXPECT_GE(hits, least_hits);
}

/// At triangles from around them, along axes, with limited ranges, with directions of any length.
std::vector<PreciseRay> troubling_rays(const test::DoubleMesh& mesh, const DoubleVec3& center, double size,
                                       std::uint32_t count) {
  Random random(9);
  const auto last = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<PreciseRay> rays = test::rays_at(mesh, 0, last, center, 2 * size, count, 8);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    PreciseRay& ray = rays[i];
    if (i % 7 == 3) ray.origin = mesh.vertices[random.below(static_cast<std::uint32_t>(mesh.vertices.size()))];
    if (i % 5 == 2) {
      ray.direction = {};
      ray.direction[random.below(3)] = random.below(2) != 0 ? size : -size;
      ray.origin = ray.origin - ray.direction * 3;
    }
    if (i % 6 == 1) ray.t_far = random.uniform(0, 1.5f);
    if (i % 6 == 2) ray.t_near = random.uniform(-1, 1);
    if (i % 8 == 5) ray.origin = ray.origin - ray.direction * 1e6;
    if (i % 4 == 3) ray.direction = ray.direction * std::ldexp(1.0, static_cast<int>(random.below(20)) - 10);
  }
  return rays;
}

class PreciseRecipe : public testing::TestWithParam<const char*> {};

TEST_P(PreciseRecipe, AnyMeshAnswersLikeTestingEveryTriangle) {
  struct Case {
    std::uint32_t count;
    double size, spread;
    DoubleVec3 center;
  };
  for (const auto& [count, size, spread, center] : std::vector<Case>{{1, 1, 0, {}},
                                                                     {400, 0.1, 1, {}},
                                                                     {400, 1e-3, 1e-2, {6e6, -1e5, 2e6}},
                                                                     {300, 3e-8, 3e-7, {6e6, -1e5, 2e6}},  // some ulps
                                                                     {400, 1e-5, 1, {3, 0, 0}},
                                                                     {200, 1e-9, 1e-8, {1, 1, 1}},
                                                                     {300, 1e-31, 1e-30, {}},
                                                                     {300, 1e59, 1e60, {1e61, 0, 0}}}) {
    const test::DoubleMesh mesh = test::double_soup(count, size, spread, center, count);
    const auto rays = troubling_rays(mesh, center, spread + size, 600);
    expect_brute_force(mesh, build_of(mesh, GetParam()), rays, 200);
  }
}

TEST_P(PreciseRecipe, DetailsOfAMillimetreOnAPlanet) {
  const test::Planet planet = test::planet(24, 20);
  const auto last = static_cast<std::uint32_t>(planet.mesh.triangles.size());
  const PreciseStructure structure = build_of(planet.mesh, GetParam());
  EXPECT_GT(structure.frames(), 1u);
  for (const auto& [distance, spread] : {std::pair{1.0, 0.5}, {1000.0, 100.0}, {4e5, 1e5}, {1e8, 1e7}}) {
    const DoubleVec3 origin = planet.detail_center + planet.up * distance;
    expect_brute_force(planet.mesh, structure,
                       test::rays_at(planet.mesh, planet.first_detail, last, origin, spread, 200, 4), 180);
    expect_brute_force(planet.mesh, structure,
                       test::rays_at(planet.mesh, 0, planet.first_detail, origin, spread, 200, 5), 50);
  }
}

INSTANTIATE_TEST_SUITE_P(Recipes, PreciseRecipe,
                         testing::Values("default", "fast", "compact", "median(leaf=1) > wide(4)",
                                         "binned(leaf=4) > wide(16)"));

TEST(Precise, NoRayLeavesAClosedMeshWithinAnother) {
  const test::Planet planet = test::planet(48, 40);
  const auto last = static_cast<std::uint32_t>(planet.mesh.triangles.size());
  const PreciseStructure structure = build_of(planet.mesh);
  // From inside the body at its edges and vertices, and from inside the planet at its own.
  for (const PreciseRay& ray :
       test::rays_at(planet.mesh, planet.first_detail, last, planet.detail_center, 0.05, 20'000, 1)) {
    const PreciseHit hit = structure.closest_hit(ray);
    ASSERT_TRUE(hit.valid() && hit.primitive >= planet.first_detail && structure.any_hit(ray));
    ASSERT_LT(std::abs(hit.t - 1), 0.3);
  }
  for (const PreciseRay& ray : test::rays_at(planet.mesh, 0, planet.first_detail, {}, 3e6, 20'000, 2)) {
    ASSERT_TRUE(structure.closest_hit(ray).valid());
  }
}

/// Vertices rounded to float are up to a quarter of a metre off at this distance from the origin: millimetres vanish.
TEST(Precise, SinglePrecisionLosesWhatDoubleFinds) {
  const test::Planet planet = test::planet(24, 20);
  const auto last = static_cast<std::uint32_t>(planet.mesh.triangles.size());
  std::vector<Vec3> rounded;
  const auto to_float = [](const DoubleVec3& v) {
    return Vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  for (const DoubleVec3& v : planet.mesh.vertices) rounded.push_back(to_float(v));
  Scene scene;
  scene.add_mesh(rounded, planet.mesh.triangles);
  const Structure single = build(scene);
  const PreciseStructure precise = build_of(planet.mesh);
  const DoubleVec3 origin = planet.detail_center + planet.up * 2;
  const auto rays = test::rays_at(planet.mesh, planet.first_detail, last, origin, 0.5, 2000, 4);
  std::size_t found_in_single = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (i % 4 == 1 || i % 4 == 2) continue;  // at edges, which may be the outline
    const PreciseHit hit = precise.closest_hit(rays[i]);
    // What is aimed at is hit, or what stands before it.
    ASSERT_TRUE(hit.valid() && hit.primitive >= planet.first_detail && hit.t < 1 + 1e-6) << i;
    const Hit other = single.closest_hit({to_float(rays[i].origin), 0, to_float(rays[i].direction)});
    const double error = test::length(rays[i].direction) * std::abs(static_cast<double>(other.t) - hit.t);
    found_in_single += other.valid() && error < 0.01 ? 1 : 0;
  }
  EXPECT_LT(found_in_single, 50u);
}

/// What frames are for: a ray at the detail tests hardly more triangles than if nothing else were there.
TEST(Precise, DetailCostsLittleMoreOnAPlanetThanAlone) {
  const test::Planet planet = test::planet(48, 40);
  test::DoubleMesh alone{planet.mesh.vertices,
                         {planet.mesh.triangles.begin() + planet.first_detail, planet.mesh.triangles.end()}};
  const auto last = static_cast<std::uint32_t>(planet.mesh.triangles.size());
  const auto rays =
      test::rays_at(planet.mesh, planet.first_detail, last, planet.detail_center + planet.up, 0.5, 1000, 4);
  const auto tests_of = [&](const PreciseStructure& structure) {
    std::vector<PreciseHit> hits(rays.size());
    std::vector<RayCounters> counters(rays.size());
    structure.closest_hits_counted(rays, hits, counters);
    std::uint64_t sum = 0;
    for (const RayCounters& counter : counters) sum += counter.primitive_tests + counter.node_tests;
    return sum;
  };
  EXPECT_LT(tests_of(build_of(planet.mesh)), 2 * tests_of(build_of(alone)));
}

TEST(Precise, AnOrdinaryMeshIsOneFrame) {
  const test::DoubleMesh ball = test::relief(40, 1, {}, [](const DoubleVec3&) { return 0.0; });
  EXPECT_EQ(build_of(ball).frames(), 1u);
}

TEST(Precise, ThreadsChangeNothing) {
  const test::Planet planet = test::planet(24, 40);
  const auto last = static_cast<std::uint32_t>(planet.mesh.triangles.size());
  const auto rays =
      test::rays_at(planet.mesh, planet.first_detail, last, planet.detail_center + planet.up, 0.5, 500, 4);
  const PreciseStructure one = build_of(planet.mesh, "default", 1), many = build_of(planet.mesh, "default", 8);
  EXPECT_EQ(one.report().bytes, many.report().bytes);
  std::vector<PreciseHit> hits(rays.size());
  std::vector<RayCounters> of_one(rays.size()), of_many(rays.size());
  one.closest_hits_counted(rays, hits, of_one);
  many.closest_hits_counted(rays, hits, of_many);
  EXPECT_EQ(of_one, of_many);
}

TEST(Precise, RaysOutsideTheLimitsHitNothing) {
  const test::DoubleMesh mesh = test::relief(8, 1, {}, [](const DoubleVec3&) { return 0.0; });
  const PreciseStructure structure = build_of(mesh);
  const PreciseRay good{{0, 0.1, 5}, 0, {0, 0, -1}};
  ASSERT_TRUE(structure.closest_hit(good).valid());
  std::vector<PreciseRay> bad;
  for (const double value : {nan, infinity, -infinity, 1e81, -1e81}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bad.push_back(good);
      bad.back().origin[axis] = value;
      bad.push_back(good);
      bad.back().direction[axis] = value;
    }
  }
  for (const DoubleVec3& direction : {DoubleVec3{}, {-0.0, 0, -0.0}, {0, 0, -1e-81}}) {
    bad.push_back(good);
    bad.back().direction = direction;
  }
  bad.push_back({good.origin, 1, good.direction, 0.5});
  bad.push_back({good.origin, nan, good.direction, infinity});
  bad.push_back({good.origin, 0, good.direction, nan});
  for (const PreciseRay& ray : bad) {
    EXPECT_EQ(structure.closest_hit(ray), PreciseHit{}) << describe(ray, {});
    EXPECT_FALSE(structure.any_hit(ray));
  }
}

/// From where a double can not tell the mesh's sides apart, an axis-parallel ray still can.
TEST(Precise, RaysFromTheEndOfTheRange) {
  const test::DoubleMesh mesh = test::relief(8, 1, {}, [](const DoubleVec3&) { return 0.0; });
  const PreciseStructure structure = build_of(mesh);
  const PreciseBruteForce truth(mesh.vertices, mesh.triangles);
  for (const double far : {1e6, 1e12, 1e16, 1e20, 1e30, 1e80}) {
    const PreciseRay ray{{far, 0.1, 0.2}, 0, {-3, 0, 0}};  // whose way to the mesh no double says exactly
    EXPECT_TRUE(truth.closest_hit(ray).valid()) << far;
    EXPECT_TRUE(same_bits(structure.closest_hit(ray), truth.closest_hit(ray))) << far;
  }
}

TEST(Precise, UnusableTrianglesAreLeftOutAndCounted) {
  const std::vector<DoubleVec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {0, 1e81, 0}, {2, 0, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 3}, {0, 1, 4}, {0, 1, 5}, {1, 1, 2}, {0, 1, 2}};
  const PreciseStructure structure = build_precise(vertices, triangles);
  EXPECT_EQ(structure.report().primitives, 1u);
  EXPECT_EQ(structure.report().left_out, 4u);
  const PreciseHit hit = structure.closest_hit({{0.25, 0.25, 1}, 0, {0, 0, -1}});
  EXPECT_EQ(hit.primitive, 4u);
  EXPECT_EQ(hit.t, 1);
}

TEST(Precise, NothingToBuildOverHasNoHits) {
  const PreciseStructure structure = build_precise({}, {});
  EXPECT_EQ(structure.frames(), 0u);
  EXPECT_FALSE(structure.closest_hit({{0, 0, 1}, 0, {0, 0, -1}}).valid());
  EXPECT_FALSE(structure.any_hit({{0, 0, 1}, 0, {0, 0, -1}}));
  EXPECT_TRUE(structure.report().bounds.empty());
}

TEST(Precise, MisuseIsAnError) {
  const std::vector<DoubleVec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> good = {{0, 1, 2}}, bad = {{0, 1, 3}};
  EXPECT_THROW(build_precise(vertices, bad), Error);
  for (const char* recipe : {"median > binary", "binned > slab", "binned > wide(8) > trace(order=none)"}) {
    EXPECT_THROW(build_precise(vertices, good, recipe), UsageError) << recipe;
  }
  std::vector<PreciseRay> rays(2);
  std::vector<PreciseHit> hits(1);
  EXPECT_THROW(build_precise(vertices, good).closest_hits(rays, hits), UsageError);
}

}  // namespace
}  // namespace boxwood
