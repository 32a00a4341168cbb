// What is drawn over a picture lies where the picture shows it, and a picked ray does what the structures do.
#include <gtest/gtest.h>

#include <algorithm>

#include "boxwood/structure.h"
#include "logic/difference.h"
#include "logic/projection.h"
#include "logic/ray_walk.h"
#include "logic/tree_level.h"
#include "render/camera_rays.h"
#include "structure/pipeline.h"
#include "support/scenes.h"
#include "trace/brute_force.h"

namespace boxwood::viewer {
namespace {

Camera some_camera() {
  Camera camera;
  camera.eye = {1, 2, 4};
  camera.direction = {-0.2f, -0.4f, -1};
  camera.up = {0.1f, 1, 0};
  camera.fov = 50;
  return camera;
}

TEST(Projection, PutsAPointOfARayIntoTheRaysPixel) {
  for (const auto& [width, height] : {std::pair{160u, 90u}, std::pair{60u, 100u}}) {
    const CameraRays rays(some_camera(), width, height, 1, 1);
    const Projection projection(some_camera(), static_cast<float>(width), static_cast<float>(height));
    for (std::uint32_t y = 0; y < height; y += 7) {
      for (std::uint32_t x = 0; x < width; x += 11) {
        const Ray ray = rays.ray(x, y, 0);
        const auto place = projection.point(ray.origin + ray.direction * 3.5f);
        ASSERT_TRUE(place);
        EXPECT_NEAR(place->x, static_cast<float>(x) + 0.5f, 0.01f);
        EXPECT_NEAR(place->y, static_cast<float>(y) + 0.5f, 0.01f);
      }
    }
  }
}

TEST(Projection, CutsLinesAtTheEyeAndDropsWhatIsBehind) {
  const Camera camera = some_camera();
  const Projection projection(camera, 100, 100);
  const Vec3 ahead = normalize(camera.direction);
  EXPECT_FALSE(projection.point(camera.eye - ahead));
  EXPECT_FALSE(projection.line(camera.eye - ahead, camera.eye - ahead * 2.0f));
  const auto cut = projection.line(camera.eye + ahead * 2.0f, camera.eye - ahead + Vec3{0.5f, 0, 0});
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->a.x, 50, 0.01f);
}

class RayWalks : public testing::TestWithParam<ChildOrder> {};

TEST_P(RayWalks, HitWhatBruteForceHitsAndCountWhatABinaryStructureCounts) {
  const Scene scene = test::sphere(12);
  const Recipe recipe = Recipe::parse("sweep > binary");
  const Tree tree = tree_of(scene.meshes[0], recipe);
  const char* orders[] = {"none", "axis", "near"};
  const Structure structure =
      build(scene, std::string("sweep > binary > trace(order=") + orders[static_cast<int>(GetParam())] + ")");
  const CameraRays rays(some_camera(), 20, 20, 1, 1);
  std::size_t same = 0, hits = 0;
  for (std::uint32_t pixel = 0; pixel < 400; ++pixel) {
    const Ray ray = rays.ray(pixel, 0);
    const RayWalk walk = walk_ray(tree, scene.meshes[0], ray, GetParam());
    EXPECT_EQ(walk.hit.primitive, structure.closest_hit(ray).primitive);
    EXPECT_EQ(walk.hit.t, structure.closest_hit(ray).t);
    hits += walk.hit.valid() ? 1 : 0;
    std::vector<Hit> hit(1);
    std::vector<RayCounters> counters(1);
    structure.closest_hits_counted({&ray, 1}, hit, counters);
    same += walk.node_tests == counters[0].node_tests && walk.primitive_tests == counters[0].primitive_tests ? 1 : 0;
    const auto tests = std::ranges::count_if(walk.steps, [](const WalkStep& s) {
      return s.kind == WalkStep::Kind::entered || s.kind == WalkStep::Kind::missed;
    });
    EXPECT_EQ(static_cast<std::uint32_t>(tests), walk.node_tests);
  }
  EXPECT_GT(hits, 40u);
  EXPECT_GT(same, 390u);  // boxes are a little wider in float: a test more or less now and then
}

INSTANTIATE_TEST_SUITE_P(Orders, RayWalks, testing::Values(ChildOrder::none, ChildOrder::axis, ChildOrder::near));

TEST(RayWalk, OfNoTreeIsEmpty) {
  const Scene scene = test::sphere(4);
  EXPECT_TRUE(walk_ray(Tree{}, scene.meshes[0], {}, ChildOrder::near).steps.empty());
}

TEST(TreeLevel, HoldsEveryTriangleOnceAndHeatsTheCostliest) {
  const Scene scene = test::soup(200, 0.2f, 3);
  const Tree tree = tree_of(scene.meshes[0], Recipe::parse("sweep > binary"));
  const std::uint32_t height = height_of(tree);
  ASSERT_GT(height, 6u);
  for (const std::uint32_t level : {0u, 3u, height, height + 5}) {
    const std::vector<LevelBox> boxes = boxes_of_level(tree, level, 100000);
    std::size_t references = 0;
    float hottest = 0;
    for (const LevelBox& box : boxes) {
      // Below a node lie all references of the subtree.
      std::vector<std::uint32_t> open{box.node};
      while (!open.empty()) {
        const Tree::Node& node = tree.nodes[open.back()];
        open.pop_back();
        if (node.is_leaf()) references += node.count;
        for (std::uint32_t c = 0; !node.is_leaf() && c < node.count; ++c) open.push_back(node.first + c);
      }
      hottest = std::max(hottest, box.heat);
      EXPECT_GE(box.heat, 0);
    }
    EXPECT_EQ(references, 200u);
    EXPECT_EQ(hottest, 1);
  }
  EXPECT_EQ(boxes_of_level(tree, 3, 2).size(), 2u);
  EXPECT_TRUE(boxes_of_level(Tree{}, 3, 10).empty());
}

TEST(Difference, CountsPixelsAndMeasuresTheLargest) {
  Image a(3, 1), b(3, 1);
  b.pixels[1] = {0, 0.25f, 0};
  b.pixels[2] = {-0.5f, 0, 0};
  const Difference difference = difference_of(a, b, 2);
  EXPECT_EQ(difference.pixels, 2u);
  EXPECT_EQ(difference.largest, 0.5f);
  EXPECT_EQ(difference.image.pixels[1], (Vec3{0, 0.5f, 0}));
  EXPECT_TRUE(difference_of(a, Image(2, 1), 1).image.pixels.empty());
}

}  // namespace
}  // namespace boxwood::viewer
