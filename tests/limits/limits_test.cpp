// The edges of what there can be: numbers, many instances, many threads.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "boxwood/error.h"
#include "boxwood/structure.h"
#include "structure/size_limits.h"
#include "support/concurrent.h"
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

TEST(ConcurrentQueries, OfOneStructureAnswerAsAlone) {
  for (const Scene& scene : {test::soup(200, 0.3f, 7), test::instances()}) {
    const std::vector<Ray> rays = test::troubling_rays(scene, 120, 2);
    for (const char* recipe : {"median > binary", "default", "binned > wide(4) > trace(simd=off)", "compact",
                               "sweep > slab(packet=8)", "octree > octree", "octree > bit-octree", "binned > quantized",
                               "binned > wide-slab(8)", "binned > oriented"}) {
      EXPECT_FALSE(test::answers_differ(build(scene, recipe, {.threads = 4}), rays)) << recipe;
    }
  }
}

}  // namespace
}  // namespace boxwood
