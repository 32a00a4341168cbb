// From a view to a build that adapts to it, on one level and on two.
#include <gtest/gtest.h>

#include <set>

#include "boxwood/boxwood.h"
#include "render/camera_rays.h"
#include "structure/mesh_geometry.h"
#include "structure/object_use.h"
#include "support/scenes.h"
#include "trace/brute_force.h"

namespace boxwood::test {
namespace {

RaySetSettings settings_at(const Vec3& eye, std::uint32_t block = 1) {
  RaySetSettings settings;
  settings.camera.eye = eye;
  settings.camera.direction = -eye;
  settings.width = 48, settings.height = 32;
  settings.block = block;
  return settings;
}

const std::vector<std::string> kinds = {"primary", "shadow", "ao", "diffuse"};

ExpectedUse use_of_scene(const Scene& scene, const Vec3& eye) { return expect_view(scene, settings_at(eye, 4)); }

TEST(Blocks, OnePixelOfEach) {
  for (const auto& [width, height, block] : {std::tuple(48u, 32u, 4u), {50u, 3u, 4u}, {7u, 7u, 1u}, {5u, 5u, 9u}}) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> blocks;
    for (const std::uint32_t pixel : pixels_in_blocks(width, height, block, 1)) {
      ASSERT_LT(pixel, width * height);
      EXPECT_TRUE(blocks.insert({pixel % width / block, pixel / width / block}).second);
    }
    EXPECT_EQ(blocks.size(), ((width + block - 1) / block) * ((height + block - 1) / block));
  }
}

TEST(ExpectUse, RaysEndWhereTheyHit_AndWhatTheyHitIsSeen) {
  const Scene scene = soup(300, 0.2f, 1);
  const Structure structure = build(scene, "binned > binary");
  const std::vector<RaySet> sets = make_ray_sets(scene, structure, settings_at({0, 0, 4}), kinds);
  const ExpectedUse use = expect_use(structure, sets, sets);
  std::set<std::uint32_t> seen;
  ASSERT_EQ(use.rays.size(), sets.size());
  for (const ExpectedRays& rays : use.rays) {
    for (std::size_t i = 0; i < rays.rays.size(); ++i) {
      const Hit hit = structure.closest_hit(rays.rays[i]);
      EXPECT_EQ(rays.ends[i], hit.valid() ? hit.t : rays.rays[i].t_far);
      if (hit.valid()) seen.insert(hit.primitive);
    }
  }
  ASSERT_EQ(use.seen.size(), seen.size());
  EXPECT_GT(seen.size(), 10u);
  for (const SeenTriangle& triangle : use.seen) EXPECT_TRUE(seen.contains(triangle.primitive));
}

TEST(ObjectUse, Instances_RaysAreMappedToWhatTheyMeet) {
  const Scene scene = instances();
  const ExpectedUse use = use_of_scene(scene, {0, 1, 9});
  const std::vector<Box> boxes = instance_boxes(scene);
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const KnownUse known = use_of_mesh(use, scene, mesh, boxes);
    const Box box = usable_bounds(scene.meshes[mesh]);
    std::size_t placed = 0, hits = 0;
    for (const Instance& instance : scene.instances) placed += instance.mesh == mesh ? 1 : 0;
    EXPECT_EQ(known.windows.size(), placed);
    for (const ExpectedRays& rays : known.rays) {
      ASSERT_EQ(rays.rays.size(), rays.ends.size());
      for (std::size_t i = 0; i < rays.rays.size(); ++i) {
        const Ray& ray = rays.rays[i];
        const Vec3 end = ray.origin + ray.direction * rays.ends[i];
        const Vec3 margin = box.extent() * 1e-3f;
        hits += rays.ends[i] < 1e9f && Box{box.lower - margin, box.upper + margin}.contains(Box{end, end});
      }
    }
    EXPECT_GT(hits, 0u) << "some rays end on the mesh, in its own space";
    std::size_t seen = 0;
    for (const std::uint8_t s : known.seen) seen += s;
    EXPECT_GT(seen, 0u);
  }
}

class Recipes : public testing::TestWithParam<std::string> {};

TEST_P(Recipes, AnyScene_SameAnswersAsBruteForce) {
  for (const Scene& scene : {soup(200, 0.3f, 2), instances(), scene_of({}, {})}) {
    const ExpectedUse use = scene.empty() ? ExpectedUse{} : use_of_scene(scene, {0, 1, 9});
    const Structure structure = build(scene, GetParam(), {.use = &use});
    const BruteForce truth(scene);
    const Structure usual = build(scene, "binned > binary");
    for (const RaySet& set : make_ray_sets(scene, usual, settings_at({0, 1, 9}), kinds)) {
      std::vector<Hit> hits(set.rays.size()), expected(set.rays.size());
      structure.closest_hits(set.rays, hits);
      truth.closest_hits(set.rays, expected);
      EXPECT_EQ(hits, expected) << set.kind;
    }
  }
}

TEST_P(Recipes, NothingKnown_Refused) {
  EXPECT_TRUE(needs_use(Recipe::parse(GetParam())));
  EXPECT_THROW(build(soup(20, 0.3f, 3), GetParam()), UsageError);
}

TEST_P(Recipes, AnyNumberOfThreads_SameTree) {
  const Scene scene = sphere(24);
  const ExpectedUse use = use_of_scene(scene, {0, 1, 3});
  const Structure one = build(scene, GetParam(), {.threads = 1, .use = &use}),
                  many = build(scene, GetParam(), {.threads = 4, .use = &use});
  EXPECT_EQ(one.report().nodes, many.report().nodes);
  EXPECT_EQ(one.report().sah_cost, many.report().sah_cost);
}

INSTANTIATE_TEST_SUITE_P(Heuristics, Recipes,
                         testing::Values("binned(cost=rdh) > wide(8)", "sweep(cost=osah, k=4) > wide(4)",
                                         "binned(cost=perspective) > binary",
                                         "binned(cost=blend(parallel, rdh, 0.5), leaf_test=area) > binary",
                                         "srdh > binary", "spatial(cost=rdh) > binary", "spatial(cost=osah) > wide(4)"),
                         [](const auto& parameters) { return "Recipe" + std::to_string(parameters.index); });

TEST(Build, UseOfAnotherScene_Refused) {
  const Scene scene = soup(20, 0.3f, 4);
  ExpectedUse use;
  use.seen.push_back({0, 99});
  EXPECT_THROW(build(scene, "binned(cost=osah) > binary", {.use = &use}), UsageError);
  use.seen.clear();
  use.rays.push_back({"primary", Query::closest_hit, std::vector<Ray>(2), {1.0f}});
  EXPECT_THROW(build(scene, "binned(cost=rdh) > binary", {.use = &use}), UsageError);
}

TEST(Build, RecipeThatNeedsNoUse_IgnoresIt) {
  const Scene scene = soup(50, 0.3f, 5);
  ExpectedUse use;
  use.seen.push_back({7, 7});
  EXPECT_FALSE(needs_use(Recipe::parse("default")));
  EXPECT_NO_THROW(build(scene, "default", {.use = &use}));
}

}  // namespace
}  // namespace boxwood::test
