// Slabs, their twin, wide slabs and intervals, walked in every way and in packets, give the answers of brute force.
#include "support/differential.h"

#include <gtest/gtest.h>

#include <tuple>

#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

struct Named {
  const char* name;
  test::LayoutCall call;
};

std::vector<Named> layouts() {
  using test::LayoutCall;
  return {{"slab32", LayoutCall(slab_stage())},
          {"slab64", LayoutCall(slab_stage()).set("index", "64")},
          {"boxes32", LayoutCall(binary_split_stage())},
          {"boxes64", LayoutCall(binary_split_stage()).set("index", "64")},
          {"slabPacket4", LayoutCall(slab_stage()).set("packet", "4")},
          {"slabPacket16", LayoutCall(slab_stage()).set("packet", "16").set("index", "64")},
          {"boxesPacket8", LayoutCall(binary_split_stage()).set("packet", "8")},
          {"wideSlab8", LayoutCall(wide_slab_stage()).set("planes", "1")},
          {"wideSlab16", LayoutCall(wide_slab_stage()).set("k", "16").set("planes", "3")},
          {"wideSlab5", LayoutCall(wide_slab_stage()).set("k", "5").set("planes", "6")},
          {"bih", LayoutCall(bih_stage())}};
}

struct Case {
  test::NamedScene named;
  test::Expected expected;
};

/// Every fourth group of sixteen rays is made of neighbours, so that packets form.
std::vector<Ray> rays_for(const Scene& scene, std::uint64_t seed) {
  std::vector<Ray> rays = test::troubling_rays(scene, 480, seed);
  Random random(seed + 1);
  for (std::size_t i = 0; i < rays.size(); i += 16) {
    if (i / 16 % 4 == 3) continue;
    for (std::size_t k = 1; k < 16 && i + k < rays.size(); ++k) {
      Ray ray = rays[i];
      for (std::size_t axis = 0; axis < 3; ++axis) ray.direction[axis] *= random.uniform(0.98f, 1.02f);
      if (k % 5 == 2) ray.t_far = rays[i + k].t_far;
      if (k % 5 == 3 && rays[i + k].t_near <= ray.t_far) ray.t_near = rays[i + k].t_near;
      rays[i + k] = ray;
    }
  }
  return rays;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> out;
    for (test::NamedScene& named : test::troubled_scenes()) {
      test::Expected expected(named.scene, rays_for(named.scene, out.size()));
      out.push_back({std::move(named), std::move(expected)});
    }
    return out;
  }();
  return all;
}

using Parameters = std::tuple<std::size_t, ChildOrder, bool, TraversalMode>;

class SlabLayout : public testing::TestWithParam<Parameters> {};

TEST_P(SlabLayout, GivesTheAnswersOfBruteForce) {
  const auto& [number, order, cull, mode] = GetParam();
  const Named layout = layouts()[number];
  for (const Case& c : cases()) {
    for (const std::uint32_t leaf_size : {1u, 3u}) {
      const auto encoded = test::encode_scene(c.named.scene, layout.call, {order, cull, mode}, leaf_size);
      test::expect_brute_force_answers(*encoded, c.expected, layout.name + (" over " + c.named.name));
    }
  }
}

std::string name_of(const testing::TestParamInfo<Parameters>& parameters) {
  const auto& [number, order, cull, mode] = parameters.param;
  constexpr const char* orders[] = {"None", "Axis", "Near"};
  return std::string(layouts()[number].name) + orders[static_cast<int>(order)] + (cull ? "Cull" : "") +
         (mode == TraversalMode::recursive ? "Recursive" : "");
}

INSTANTIATE_TEST_SUITE_P(TraceOptions, SlabLayout,
                         testing::Combine(testing::Range(std::size_t{0}, layouts().size()),
                                          testing::Values(ChildOrder::none, ChildOrder::axis, ChildOrder::near),
                                          testing::Bool(),
                                          testing::Values(TraversalMode::iterative, TraversalMode::recursive)),
                         name_of);

TEST(SlabLayout, ScalarAndSimdWideSlabsCountTheSame) {
  const Scene scene = test::sphere(12);
  const test::LayoutCall call = test::LayoutCall(wide_slab_stage()).set("planes", "2");
  TraceOptions scalar;
  scalar.simd = false;
  const auto a = test::encode_scene(scene, call, {}), b = test::encode_scene(scene, call, scalar);
  const std::vector<Ray> rays = test::troubling_rays(scene, 400, 3);
  std::vector<Hit> hits(rays.size());
  std::vector<RayCounters> of_a(rays.size()), of_b(rays.size());
  a->closest_hits_counted(rays, hits, of_a);
  b->closest_hits_counted(rays, hits, of_b);
  EXPECT_EQ(of_a, of_b);
}

/// A bundle towards the scene, alike in signs and dominant axis.
std::vector<Ray> bundle(std::size_t count) {
  Random random(1);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    ray.origin = {-0.5f, -0.6f, 4};
    ray.direction = {random.uniform(0.01f, 0.3f), random.uniform(0.01f, 0.3f), -1};
  }
  return rays;
}

TEST(SlabCounters, RecursiveAndIterativeCountTheSameAndTheTwinNeedsFewerTests) {
  const Scene scene = test::sphere(16);
  const std::vector<Ray> rays = bundle(256);
  for (const char* packet : {"1", "8"}) {
    const test::LayoutCall slab = test::LayoutCall(slab_stage()).set("packet", packet);
    const test::LayoutCall boxes = test::LayoutCall(binary_split_stage()).set("packet", packet);
    for (const ChildOrder order : {ChildOrder::none, ChildOrder::axis}) {
      const auto cost = [&](const test::LayoutCall& call, TraversalMode mode) {
        return test::total_cost(*test::encode_scene(scene, call, {order, true, mode}, 1, false), rays);
      };
      const RayCounters iterative = cost(slab, TraversalMode::iterative);
      EXPECT_EQ(iterative, cost(slab, TraversalMode::recursive));
      EXPECT_EQ(iterative.node_tests, rays.size() + 2 * iterative.steps);
      EXPECT_LT(cost(boxes, TraversalMode::iterative).node_tests, iterative.node_tests);
    }
    const auto axis = test::encode_scene(scene, slab, {ChildOrder::axis}, 1, false);
    const auto none = test::encode_scene(scene, slab, {ChildOrder::none}, 1, false);
    EXPECT_LT(test::total_cost(*axis, rays).node_tests, test::total_cost(*none, rays).node_tests);
  }
}

TEST(SlabCounters, ATestOfAPacketCountsForAllItsRays) {
  const Scene scene = test::sphere(16);
  const test::LayoutCall call = test::LayoutCall(slab_stage()).set("packet", "8");
  const auto layout = test::encode_scene(scene, call, {}, 1, false);
  const std::vector<Ray> rays = bundle(8);
  std::vector<Hit> hits(8);
  std::vector<RayCounters> counters(8);
  layout->closest_hits_counted(rays, hits, counters);
  EXPECT_GT(counters[0].node_tests, 10u);
  for (const RayCounters& c : counters) EXPECT_EQ(c, counters[0]);
}

}  // namespace
}  // namespace boxwood
