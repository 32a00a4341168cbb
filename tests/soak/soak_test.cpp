#include "soak/soak.h"

#include <gtest/gtest.h>

#include <set>

#include "boxwood/structure.h"
#include "recipe/stage.h"
#include "soak/random_recipe.h"
#include "soak/random_scene.h"

namespace boxwood {
namespace {

TEST(Soak, ManyRandomCasesAgreeWithBruteForce) {
  SoakSettings settings;
  settings.seed = 20;
  settings.cases = 150;
  settings.seconds = 20;
  settings.rays = 40;
  const SoakResult result = soak(settings);
  for (const SoakFailure& failure : result.failures) {
    ADD_FAILURE() << "case " << failure.number << ", " << failure.recipe << " on " << failure.scene << ": "
                  << failure.what;
  }
  EXPECT_GT(result.cases, 5u);
}

TEST(Soak, CasesDependOnSeedAndNumberOnly) {
  const auto text = [](std::uint64_t seed, std::uint64_t number) {
    Random random(seed, number);
    const Scene scene = random_scene(random);
    return scene.name + random_recipe(random).text();
  };
  EXPECT_EQ(text(1, 7), text(1, 7));
  EXPECT_NE(text(1, 7), text(1, 8));
  EXPECT_NE(text(1, 7), text(2, 7));
}

TEST(Soak, DrawsEveryStage) {
  std::set<const Stage*> drawn;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    Random random(3, i);
    const Recipe recipe = random_recipe(random);
    for (const StageCall& call : recipe.stages()) drawn.insert(call.stage);
  }
  for (const Stage& stage : stages()) {
    if (stage.kind == StageKind::peer) continue;
    EXPECT_TRUE(drawn.contains(&stage)) << stage.name;
  }
}

TEST(Soak, SeesAWrongAnswer) {
  // A structure of another scene stands for a wrong layout.
  Random random(1);
  Scene scene;
  scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  Scene other = scene;
  other.meshes[0].positions[0].z = 0.5f;
  const Structure wrong = build(other, "median > binary");
  const std::vector<Ray> rays = {{{0.2f, 0.2f, 1}, 0, {0, 0, -1}, 10}};
  EXPECT_NE(find_difference(wrong, scene, rays), "");
  EXPECT_EQ(find_difference(build(scene, "median > binary"), scene, rays), "");
}

}  // namespace
}  // namespace boxwood
