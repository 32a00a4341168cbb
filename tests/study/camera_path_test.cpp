// Studies along camera paths: trees that are built anew on the way, lights and paths in shares of the scene's box.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "study/observations.h"
#include "study/scene_finder.h"
#include "study/studies.h"
#include "study/study_result.h"

namespace boxwood::testing {
namespace {

const char* const path_study = R"toml(
[run]
rays = ["primary", "diffuse", "shadow", "ao"]
size = [16, 12]
whole_paths = { ao_rays = 3 }
bounces = 2
ao_radius = 5
repetitions = 1
builds = 1
probes = ["tests", "answers"]
[[scene]]
name = "never"
find = ["generate:city(blocks=3)"]
lights = [[0.5, 2, 0.5], [0, 1.5, 0]]
path = { frames = 4, eyes = [[-1, 1.5, 0.5], [2, 1.5, 0.5]], targets = [[0.5, 0.3, 0.5], [0.5, 0.3, 0.5]] }
set = { rebuild = "never", scene = "city" }
[[scene]]
name = "every other"
find = ["generate:city(blocks=3)"]
lights = [[0.5, 2, 0.5], [0, 1.5, 0]]
path = { frames = 4, eyes = [[-1, 1.5, 0.5], [2, 1.5, 0.5]], targets = [[0.5, 0.3, 0.5], [0.5, 0.3, 0.5]] }
rebuild = 2
set = { rebuild = "every other", scene = "city" }
[[recipes]]
label = "{cost}"
recipe = "binned(cost={cost}) > binary"
values = { cost = ["sah", "rdh"] }
[[claim]]
id = "rays"
text = "there are as many rays whichever tree traces them"
value = "rays"
views = "each"
each = ["scene", "view", "rays"]
same = true
[[claim]]
id = "rebuild"
text = "trees that know no rays do not change"
value = "node_tests"
views = "each"
where = { cost = "sah" }
baseline = { rebuild = "never" }
each = ["rebuild", "view", "rays"]
between = [1, 1]
)toml";

/// node_tests by rebuild, cost, view; of primary rays.
std::map<std::array<std::string, 3>, double> node_tests(const Observations& observations) {
  std::map<std::array<std::string, 3>, double> tests;
  for (const Series& series : observations.series(Expression::parse("node_tests"), true)) {
    const auto& f = series.factors;
    if (f.at("rays") == "primary") tests[{f.at("rebuild"), f.at("cost"), f.at("view")}] = series.samples.at(0);
  }
  return tests;
}

TEST(CameraPath, TreesForRaysAreBuiltAnewWhereAsked) {
  const TemporaryStore folder;
  Store store = folder.open();
  const Study study = parse_study(path_study, "path.toml");
  const std::int64_t here = run_study(study, store, {});
  const auto tests = node_tests(Observations(study, store, here));
  ASSERT_EQ(tests.size(), 2u * 2u * 4u);
  const auto of = [&](const char* rebuild, const char* cost, int view) {
    return tests.at({rebuild, cost, "path-00" + std::to_string(view)});
  };
  for (int view = 0; view < 4; ++view) EXPECT_EQ(of("never", "sah", view), of("every other", "sah", view)) << view;
  for (int view = 0; view < 2; ++view) EXPECT_EQ(of("never", "rdh", view), of("every other", "rdh", view)) << view;
  for (int view = 2; view < 4; ++view) EXPECT_NE(of("never", "rdh", view), of("every other", "rdh", view)) << view;
}

TEST(CameraPath, ClaimsCompareScenesThatDifferInAFactorOnly) {
  const TemporaryStore folder;
  Store store = folder.open();
  const Study study = parse_study(path_study, "path.toml");
  const StudyResult result = evaluate(study, store, run_study(study, store, {}));
  ASSERT_EQ(result.claims.size(), 2u);
  for (const JudgedClaim& claim : result.claims) EXPECT_EQ(claim.verdict, Verdict::holds) << claim.measured;
  EXPECT_EQ(result.claims[0].cells.size(), 4u * 5u);  // views, kinds: both bounces are kinds of their own
}

TEST(CameraPath, LightsAndEyesAreSharesOfTheBox) {
  const Study study = parse_study(path_study, "path.toml");
  const StudyScene found = find_scene(study.scenes[0], {}, 0);
  const Box box = found.scene.bounds();
  ASSERT_EQ(found.scene.lights.size(), 2u);
  EXPECT_FLOAT_EQ(found.scene.lights[1].position.y, box.lower.y + 1.5f * box.extent().y);
  ASSERT_EQ(found.views.size(), 4u);
  EXPECT_NEAR(found.views[0].eye.x, box.lower.x - box.extent().x, 1e-4 * static_cast<double>(box.extent().x));
  EXPECT_NEAR(found.views[3].eye.x, box.upper.x + box.extent().x, 1e-4 * static_cast<double>(box.extent().x));
}

TEST(CameraPath, WithMistakes_IsRefused) {
  const std::string rest = "\n[[recipes]]\nrecipe = \"binned > binary\"";
  for (const char* mistake :
       {"path = { eyes = [[0, 0, 0]], targets = [] }", "path = { eyes = [], targets = [] }", "lights = [[0, 1]]",
        "path = { eyes = [[0, 0, 0]] }", "rebuild = -1", "lights = [[0, 0, 1e9]]",
        "orbit = { frames = 2 }\npath = { eyes = [[0, 0, 0]], targets = [[1, 0, 0]] }"}) {
    const std::string scene = "[[scene]]\nname = \"x\"\nfind = [\"generate:cube\"]\n";
    EXPECT_THROW(parse_study(scene + mistake + rest, "x.toml"), UsageError) << mistake;
  }
}

}  // namespace
}  // namespace boxwood::testing
