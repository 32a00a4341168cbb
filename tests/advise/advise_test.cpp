// The parts of advice that do not depend on the clock, and that the whole keeps its promises.
#include "advise/advise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "advise/candidates.h"
#include "advise/free_cameras.h"
#include "advise/thin_scene.h"
#include "boxwood/structure.h"
#include "recipe/stage.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

using namespace test;

Trial trial(const char* recipe, double ratio, double build_ms, std::size_t bytes) {
  return {Recipe::parse(recipe), true, {}, build_ms, bytes, {ratio, ratio, ratio, 3}};
}

std::set<std::string> names(std::span<const Trial> trials) {
  std::set<std::string> out;
  for (const Trial& t : trials) out.insert(t.recipe.text());
  return out;
}

TEST(Candidates, HaveEveryBuilderLayoutRefinementAndCostModelOnce) {
  const std::vector<Recipe> recipes = candidate_recipes();
  std::set<std::string> texts;
  std::set<const Stage*> used;
  for (const Recipe& recipe : recipes) {
    EXPECT_TRUE(texts.insert(recipe.text()).second) << recipe.text();
    for (const StageCall& call : recipe.stages()) used.insert(call.stage);
  }
  for (const Stage& stage : stages()) {
    if (stage.kind == StageKind::trace || stage.kind == StageKind::peer) continue;
    EXPECT_TRUE(used.contains(&stage)) << stage.name;
  }
  EXPECT_TRUE(std::ranges::any_of(texts, [](const std::string& t) { return t.find("cost=rdh") != t.npos; }));
}

TEST(ParetoFront, IsWhatNothingBeatsInAllThree) {
  const std::vector<Trial> trials = {
      trial("median > binary", 1, 1, 100),    // cheapest to build
      trial("binned > binary", 2, 5, 100),    // fastest
      trial("sweep > binary", 1.5, 6, 120),   // beaten in all by binned
      trial("binned > wide(4)", 1.2, 4, 50),  // smallest
  };
  EXPECT_EQ(names(pareto_front(trials)),
            (std::set<std::string>{"median > binary", "binned > binary", trials[3].recipe.text()}));
  EXPECT_EQ(pareto_front(trials).front().recipe.text(), "binned > binary");
}

TEST(Survivors, KeepLimitsAndAPlaceForTheFront) {
  const std::vector<Trial> trials = {trial("median > binary", 1, 1, 100), trial("binned > binary", 4, 5, 100),
                                     trial("sweep > binary", 3.5, 6, 120), trial("binned > wide(4)", 1.2, 4, 50),
                                     trial("equal > binary", 3, 7, 130)};
  EXPECT_EQ(names(survivors(trials, 3, {})),
            (std::set<std::string>{"binned > binary", "sweep > binary", trials[3].recipe.text()}));
  for (const Trial& t : survivors(trials, 5, {5.5, 110})) {
    EXPECT_LE(t.build_ms, 5.5);
    EXPECT_LE(t.bytes, 110u);
  }
  EXPECT_TRUE(survivors(trials, 5, {0.5, 0}).empty());
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += 0.5 * double{length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]))};
  }
  return sum;
}

TEST(ThinScene, KeepsAreaAndPlacements) {
  const Scene scene = sphere(60);
  const Scene thin = thin_scene(scene, scene.unique_triangles() / 4);
  EXPECT_NEAR(static_cast<double>(thin.unique_triangles()), static_cast<double>(scene.unique_triangles()) / 4,
              static_cast<double>(scene.unique_triangles()) / 20);
  EXPECT_NEAR(area(thin.meshes[0]) / area(scene.meshes[0]), 1, 0.1);
  const Scene placed = test::instances();
  EXPECT_EQ(thin_scene(placed, 20).instances.size(), placed.instances.size());
  EXPECT_EQ(thin_scene(placed, 1'000'000).unique_triangles(), placed.unique_triangles());
}

/// A ball whose triangles face outward, or inward.
Scene ball(bool outward) {
  Scene scene = sphere(12);
  Mesh& mesh = scene.meshes[0];
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += double{dot(cross(mesh.positions[a], mesh.positions[b]), mesh.positions[c])};
  }
  if ((volume > 0) == outward) return scene;
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return scene;
}

/// A closed room that is seen from inside, with a closed solid in it.
Scene room() {
  Scene scene = transformed(ball(false), 5, {});
  const Scene solid = transformed(ball(true), 1, {2, 0, 0});
  Mesh& mesh = scene.meshes[0];
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), solid.meshes[0].positions.begin(), solid.meshes[0].positions.end());
  for (const auto& [a, b, c] : solid.meshes[0].triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  return scene;
}

TEST(FreeCameras, StandInTheRoomAndNotInTheSolid) {
  const Scene scene = room();
  const std::vector<Camera> cameras = free_cameras(scene, build(scene, "default"), 4);
  ASSERT_EQ(cameras.size(), 4u);
  for (const Camera& camera : cameras) {
    EXPECT_LT(length(camera.eye), length(scene.bounds().extent()) / 2);
    EXPECT_GT(length(camera.eye - Vec3{2, 0, 0}), 0.95f);
  }
  EXPECT_TRUE(free_cameras(scene_of({}, {}), build(scene_of({}, {}), "default"), 4).empty());
  const Scene solid = ball(true);
  EXPECT_TRUE(free_cameras(solid, build(solid, "default"), 4).empty());
}

AdviseSettings quick() {
  AdviseSettings settings;
  settings.seconds = 1000;  // no result may depend on the clock
  settings.repeats = 2;
  settings.thin_from = 300;
  settings.thin_triangles = 150;
  return settings;
}

TEST(Advice, RecommendsARecipeThatKeepsTheLimitsAndAnswersRight) {
  const Scene scene = sphere(14);
  std::vector<Camera> cameras;
  const std::vector<std::string> kinds = {"primary", "ao"};
  const std::vector<RaySet> rays = rays_to_advise_for(scene, kinds, 16, 1, cameras);
  ASSERT_EQ(rays.size(), 2u);
  AdviseSettings settings = quick();
  settings.limits.bytes = 1e6;
  const Advice advice = advise(scene, rays, settings);
  ASSERT_LT(advice.recommended, advice.rows.size());
  EXPECT_LE(advice.rows[advice.recommended].measured.bytes, 1e6);
  EXPECT_TRUE(advice.notes.empty()) << advice.notes.front();
  EXPECT_EQ(advice.rows[advice.reference].measured.recipe, Recipe::parse("default").text());
  EXPECT_GT(advice.candidates, 200u);
  EXPECT_TRUE(advice.thin_correlation.has_value());
  for (std::size_t i = 1; i < advice.rows.size(); ++i) {
    EXPECT_GE(advice.rows[i - 1].mrays_per_s, advice.rows[i].mrays_per_s);
  }
  settings.limits.bytes = 10;
  EXPECT_THROW(advise(scene, rays, settings), Error);
}

TEST(Advice, WithoutRaysIsRefused) { EXPECT_THROW(advise(sphere(8), {}, quick()), UsageError); }

class StopAfter final : public ProgressSink {
 public:
  explicit StopAfter(int reports) : left_(reports) {}
  bool report(double, std::string_view) override { return left_-- > 0; }

 private:
  int left_;
};

TEST(Advice, StopsWhenAskedAndTellsWhatItKnows) {
  const Scene scene = sphere(10);
  std::vector<Camera> cameras;
  const std::vector<std::string> kinds = {"primary"};
  const std::vector<RaySet> rays = rays_to_advise_for(scene, kinds, 16, 1, cameras);
  AdviseSettings settings = quick();
  settings.thin_from = 1'000'000;
  settings.seconds = 1000;
  StopAfter at_once(0);
  EXPECT_THROW(advise(scene, rays, settings, &at_once), Cancelled);
  StopAfter later(static_cast<int>(candidate_recipes().size()) + 2);  // within the second round
  const Advice advice = advise(scene, rays, settings, &later);
  EXPECT_TRUE(advice.interrupted);
  EXPECT_FALSE(advice.rows.empty());
}

}  // namespace
}  // namespace boxwood
