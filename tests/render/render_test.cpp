#include "render/render.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>

#include "recipe/stage.h"
#include "render/camera_rays.h"
#include "render/integrator.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

using namespace testing_scenes;

RenderSettings settings_of(const std::string& integrator, std::uint32_t size = 48) {
  RenderSettings settings;
  settings.camera = outside_camera();
  settings.width = size;
  settings.height = size - 7;
  settings.spp = 3;
  settings.integrator = integrator;
  return settings;
}

std::vector<std::string> some_recipes() {
  std::vector<std::string> recipes = {"median > binary", "middle > wide(4)"};
  for (const Preset& preset : presets()) recipes.push_back(preset.name);
  return recipes;
}

class AnyIntegrator : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const Integrator& integrator : integrators()) names.emplace_back(integrator.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Render, AnyIntegrator, ::testing::ValuesIn(integrator_names()),
                         [](const auto& each) { return each.param; });

TEST_P(AnyIntegrator, GivesTheSameImageOnAnyNumberOfThreads) {
  const Scene scene = instanced_scene();
  const Structure structure = build(scene, "median > binary");
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  Image images[2];
  std::uint64_t rays[2];
  for (const int i : {0, 1}) {
    tbb::task_arena arena(i == 0 ? 1 : 4);
    const RenderResult result = arena.execute([&] { return render(scene, structure, settings_of(GetParam())); });
    images[i] = result.image;
    rays[i] = std::accumulate(result.ray_kinds.begin(), result.ray_kinds.end(), std::uint64_t{0},
                              [](std::uint64_t sum, const RayKindReport& kind) { return sum + kind.rays; });
  }
  EXPECT_EQ(images[0], images[1]);
  EXPECT_EQ(rays[0], rays[1]);
  EXPECT_NE(images[0], Image(48, 41)) << "the image is black";
}

TEST_P(AnyIntegrator, GivesTheSameImageWithEveryRecipe) {
  if (GetParam() == "heatmap") return;  // shows the recipe
  for (const Scene& scene : {soup_scene(), instanced_scene()}) {
    const Image expected = render(scene, build(scene, "median > binary"), settings_of(GetParam())).image;
    for (const std::string& recipe : some_recipes()) {
      EXPECT_EQ(render(scene, build(scene, recipe), settings_of(GetParam())).image, expected) << recipe;
    }
  }
}

TEST_P(AnyIntegrator, RendersAnEmptyScene) {
  const Scene scene;
  const RenderResult result = render(scene, build(scene, "median > binary"), settings_of(GetParam()));
  for (const Vec3& pixel : result.image.pixels) EXPECT_EQ(pixel, result.image.pixels[0]);
}

TEST(Eyelight, IsBrightestWhereTheViewMeetsTheSurfaceAtARightAngle) {
  const Scene scene = plane_scene();
  RenderSettings settings = settings_of("eyelight", 50);
  settings.spp = 1;
  settings.camera = {"above", {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, 90};
  const RenderResult result = render(scene, build(scene, "median > binary"), settings);
  EXPECT_NEAR(result.image.at(25, 21).x, 0.7f, 0.01f);
  EXPECT_LT(result.image.at(5, 5).x, 0.6f);
  ASSERT_EQ(result.ray_kinds.size(), 1u);
  EXPECT_EQ(result.ray_kinds[0].kind, "primary");
  EXPECT_EQ(result.ray_kinds[0].rays, 50u * 43u);
}

TEST(Normals, AreShownAsColours) {
  const Scene scene = plane_scene();
  RenderSettings settings = settings_of("normals");
  settings.camera = {"above", {0, 0.5f, 0}, {0, -1, 0}, {0, 0, -1}, 90};
  const RenderResult result = render(scene, build(scene, "median > binary"), settings);
  EXPECT_EQ(result.image.at(20, 20), (Vec3{0.5f, 1, 0.5f}));
}

TEST(AmbientOcclusion, OfAnOpenPlaneIsWhite) {
  const Scene scene = plane_scene();
  const Image image = render(scene, build(scene, "median > binary"), settings_of("ao")).image;
  for (const Vec3& pixel : image.pixels) ASSERT_EQ(pixel, (Vec3{1, 1, 1}));
}

TEST(AmbientOcclusion, InsideAClosedBoxIsBlack) {
  const Scene scene = box_scene();
  RenderSettings settings = settings_of("ao");
  settings.camera = {"inside", {0.1f, 0.2f, 0.3f}, {1, 0.3f, 0.2f}, {0, 1, 0}, 100};
  settings.ao_radius = 10;
  const RenderResult result = render(scene, build(scene, "median > binary"), settings);
  for (const Vec3& pixel : result.image.pixels) ASSERT_EQ(pixel, (Vec3{0, 0, 0}));
  ASSERT_EQ(result.ray_kinds.size(), 2u);
  EXPECT_EQ(result.ray_kinds[1].kind, "ao");
  EXPECT_EQ(result.ray_kinds[1].hits, result.ray_kinds[1].rays);
}

TEST(Heatmap, ShowsTheCountersOfPrimaryRays) {
  const Scene scene = soup_scene();
  const Structure structure = build(scene, "median > binary");
  RenderSettings settings = settings_of("heatmap");
  settings.spp = 1;
  settings.heatmap_scale = 50;
  const RenderResult result = render(scene, structure, settings);
  EXPECT_EQ(result.heatmap_scale, 50);

  const CameraRays camera(settings.camera, settings.width, settings.height, 1, settings.seed);
  std::uint64_t tests = 0;
  for (std::uint32_t pixel = 0; pixel < result.counts.pixels.size(); ++pixel) {
    const Ray ray = camera.ray(pixel, 0);
    Hit hit;
    RayCounters counters;
    structure.closest_hits_counted({&ray, 1}, {&hit, 1}, {&counters, 1});
    ASSERT_EQ(result.counts.pixels[pixel],
              (Vec3{static_cast<float>(counters.primitive_tests), static_cast<float>(counters.steps), 0}));
    ASSERT_NEAR(result.image.pixels[pixel].x, static_cast<float>(counters.primitive_tests) / 50, 1e-5f);
    ASSERT_NEAR(result.image.pixels[pixel].y, static_cast<float>(counters.steps) / 50, 1e-5f);
    tests += counters.primitive_tests;
  }
  EXPECT_GT(tests, 0u);
}

TEST(Heatmap, WithoutAScaleReachesFullBrightness) {
  const Scene scene = soup_scene();
  const RenderResult result = render(scene, build(scene, "median > binary"), settings_of("heatmap"));
  float brightest = 0;
  for (const Vec3& pixel : result.image.pixels) brightest = std::max({brightest, pixel.x, pixel.y});
  EXPECT_NEAR(brightest, 1, 1e-5f);
  EXPECT_GT(result.heatmap_scale, 1);
}

TEST(Render, RefusesBadSettings) {
  const Scene scene = plane_scene();
  const Structure structure = build(scene, "median > binary");
  const auto refused = [&](const auto& change) {
    RenderSettings settings = settings_of("eyelight");
    change(settings);
    EXPECT_THROW(render(scene, structure, settings), UsageError);
  };
  refused([](RenderSettings& s) { s.integrator = "eyelite"; });
  refused([](RenderSettings& s) { s.width = 0; });
  refused([](RenderSettings& s) { s.spp = 0; });
  refused([](RenderSettings& s) { s.ao_radius = -1; });
  refused([](RenderSettings& s) { s.heatmap_scale = std::numeric_limits<float>::quiet_NaN(); });
}

class Recorder : public ProgressSink {
 public:
  explicit Recorder(double stop_at) : stop_at_(stop_at) {}
  bool report(double fraction, std::string_view) override {
    fractions.push_back(fraction);
    return fraction < stop_at_;
  }
  std::vector<double> fractions;

 private:
  double stop_at_;
};

TEST(Render, ReportsProgressThatNeverFalls) {
  const Scene scene = plane_scene();
  Recorder recorder(2);
  render(scene, build(scene, "median > binary"), settings_of("eyelight", 100), &recorder);
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions));
  EXPECT_EQ(recorder.fractions.front(), 0);
  EXPECT_EQ(recorder.fractions.back(), 1);
  EXPECT_GT(recorder.fractions.size(), 5u);
}

TEST(Render, StopsWhenAskedTo) {
  const Scene scene = plane_scene();
  Recorder recorder(0.3);
  EXPECT_THROW(render(scene, build(scene, "median > binary"), settings_of("eyelight", 200), &recorder), Cancelled);
  EXPECT_LT(recorder.fractions.back(), 1);
}

}  // namespace
}  // namespace boxwood
