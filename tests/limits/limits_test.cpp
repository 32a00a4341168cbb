// The edges of what there can be: numbers, many instances, many threads.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include "boxwood/error.h"
#include "boxwood/structure.h"
#include "structure/size_limits.h"
#include "support/rays.h"
#include "support/scenes.h"
#include "trace/brute_force.h"

namespace boxwood {
namespace {

std::string refusal_of(std::uint64_t triangles, std::uint64_t instances) {
  try {
    check_named(triangles, instances);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Limits, TwoToThe32TrianglesOrInstancesAreRefusedByASentence) {
  constexpr std::uint64_t too_many = std::uint64_t{1} << 32;
  EXPECT_EQ(refusal_of(too_many - 2, too_many - 2), "");
  EXPECT_NE(refusal_of(too_many, 1).find("4294967296 triangles"), std::string::npos);
  EXPECT_NE(refusal_of(too_many - 1, 1), "");
  EXPECT_NE(refusal_of(1, too_many).find("4294967296 instances"), std::string::npos);
}

TEST(Limits, AHundredThousandInstancesAreTraced) {
  const Scene scene = load("generate:instances(count=100000, detail=3)");
  ASSERT_EQ(scene.instances.size(), 100'000u);
  const std::vector<Ray> rays = test::troubling_rays(scene, 60, 1);
  const BruteForce brute_force(scene);
  std::vector<Hit> expected(rays.size()), hits(rays.size());
  build(scene, "median > binary").closest_hits(rays, expected);
  for (const char* recipe : {"default", "binned > slab"}) {
    build(scene, recipe).closest_hits(rays, hits);
    EXPECT_TRUE(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(Hit)) == 0) << recipe;
  }
  const std::span<const Ray> few = std::span(rays).first(3);
  brute_force.closest_hits(few, std::span(hits).first(few.size()));
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(hits[i], expected[i]);
}

/// Whether any of several threads that ask at once gets another answer than one that asks alone.
bool answers_differ(const Structure& structure, const std::vector<Ray>& rays) {
  std::vector<Hit> expected(rays.size());
  std::vector<std::uint8_t> expected_blocked(rays.size());
  structure.closest_hits(rays, expected);
  structure.any_hits(rays, expected_blocked);
  std::vector<std::uint8_t> wrong(6, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      std::vector<Hit> hits(rays.size());
      std::vector<std::uint8_t> blocked(rays.size());
      for (int round = 0; round < 5; ++round) {
        structure.closest_hits(rays, hits);
        structure.any_hits(rays, blocked);
        if (hits != expected || blocked != expected_blocked) wrong[t] = 1;
        for (std::size_t i = t; i < rays.size(); i += wrong.size()) {
          if (structure.closest_hit(rays[i]) != expected[i]) wrong[t] = 1;
          if (structure.any_hit(rays[i]) != (expected_blocked[i] != 0)) wrong[t] = 1;
          const std::vector<Hit> all = structure.all_hits(rays[i]);
          if (all.empty() ? expected[i].valid() : all.front() != expected[i]) wrong[t] = 1;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return wrong != std::vector<std::uint8_t>(wrong.size(), 0);
}

TEST(ConcurrentQueries, OfOneStructureAnswerAsAlone) {
  for (const Scene& scene : {test::soup(200, 0.3f, 7), test::instances()}) {
    const std::vector<Ray> rays = test::troubling_rays(scene, 120, 2);
    for (const char* recipe : {"median > binary", "default", "binned > wide(4) > trace(simd=off)", "compact",
                               "sweep > slab(packet=8)", "octree > octree", "octree > bit-octree", "binned > quantized",
                               "binned > wide-slab(8)", "binned > oriented"}) {
      EXPECT_FALSE(answers_differ(build(scene, recipe, {.threads = 4}), rays)) << recipe;
    }
  }
}

}  // namespace
}  // namespace boxwood
