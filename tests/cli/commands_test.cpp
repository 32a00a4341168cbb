// What the commands do when all is well.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const std::vector<std::string> small_comparison = {
    "compare", "generate:cube(4)", "--size", "24x16",          "--repeat", "3",
    "-a",      "binned > binary",  "-a",     "sweep > wide(8)"};

void expect_estimate(const json& value, std::uint64_t n) {
  ASSERT_TRUE(value.is_object()) << value;
  EXPECT_LE(value.at("low"), value.at("median"));
  EXPECT_LE(value.at("median"), value.at("high"));
  EXPECT_EQ(value.at("n"), n);
}

TEST(Inspect, Json_TellsWhatTheLayoutTellsOfItself) {
  const json layout =
      run_for_json({"inspect", "generate:sphere(30)", "-a", "octree > bit-octree(chunk=32)"}).at("layout");
  EXPECT_EQ(layout.at("topology_bytes"), 32 * layout.at("chunks").get<double>());
  EXPECT_GT(layout.at("chunk_fill"), 0);
  EXPECT_GE(layout.at("primitive_multiplication"), 1);
}

TEST(Render, HeatmapScale_IsTheOneAskedFor) {
  const fs::path file = fs::temp_directory_path() / fmt::format("boxwood-heat-{}.png", getpid());
  const json document = run_for_json({"render", "generate:cube(4)", "--size", "16x16", "--integrator", "heatmap",
                                      "--heatmap-scale", "77", "-o", file.string()});
  EXPECT_EQ(document.at("heatmap_scale"), 77);
  fs::remove(file);
}

TEST(Animate, Json_FollowsEveryFrameInEveryWay) {
  const json document = run_for_json(
      {"animate", "generate:sphere(12)", "--motion", "explode", "--frames", "2", "--size", "24x16", "--repeat", "1"});
  EXPECT_EQ(document.at("frames"), 2);
  ASSERT_EQ(document.at("rows").size(), 5u);
  for (const json& row : document["rows"]) {
    EXPECT_EQ(row.at("mismatches"), 0);
    expect_estimate(row.at("update_ms"), 2);
    expect_estimate(row.at("mrays_per_s"), 2);
    EXPECT_GT(row.at("mean_sah_ratio"), 0);
    EXPECT_EQ(row.at("frames").at("sah_cost").size(), 2u);
  }
  EXPECT_EQ(document["rows"][0].at("way"), "refit");
  EXPECT_EQ(document["rows"][0].at("rebuilt_share"), 0);
  EXPECT_EQ(document["rows"][3].at("rebuilt_share"), 1);
}

TEST(Compare, Json_HasTheDocumentedFields) {
  const json document = run_for_json(small_comparison);
  ASSERT_EQ(document.at("scenes").size(), 1u);
  const json& scene = document["scenes"][0];
  EXPECT_EQ(scene.at("name"), "cube(4)");
  EXPECT_EQ(scene.at("triangles"), 12 * 16);
  ASSERT_EQ(scene.at("rows").size(), 2u);
  for (const json& row : scene["rows"]) {
    EXPECT_TRUE(row.at("recipe").is_string());
    expect_estimate(row.at("build_ms"), 3);
    EXPECT_GT(row.at("bytes_per_triangle"), 0);
    EXPECT_GT(row.at("sah_cost"), 0);
    EXPECT_EQ(row.at("rays").size(), 4u);
    for (const char* kind : {"primary", "shadow", "ao", "diffuse1"}) {
      const json& rays = row["rays"].at(kind);
      expect_estimate(rays.at("mrays_per_s"), 3);
      expect_estimate(rays.at("ratio"), 3);
      EXPECT_TRUE(rays.at("hits").is_number_unsigned());
      EXPECT_TRUE(rays.at("node_tests_per_ray").is_number());
      EXPECT_TRUE(rays.at("primitive_tests_per_ray").is_number());
      EXPECT_EQ(rays.at("mismatches"), 0);
    }
  }
  EXPECT_EQ(scene["rows"][0]["rays"]["primary"]["ratio"]["median"], 1);
}

TEST(Compare, Text_NamesEveryRecipeAndRayKind) {
  const Outcome outcome = run_boxwood(small_comparison);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");  // no progress bar where nobody looks
  for (const char* part :
       {"binned > binary", "sweep > collapse(8) > wide(8)", "primary:", "shadow:", "ao:", "diffuse1:", "Mrays/s",
        "bytes/triangle", "SAH cost", "node tests/ray", "primitive tests/ray"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
}

TEST(Compare, WithoutRecipes_ComparesEightOrMore) {
  const json document =
      run_for_json({"compare", "generate:cube", "--size", "8x8", "--repeat", "1", "--rays", "primary"});
  std::set<std::string> recipes;
  for (const json& row : document["scenes"][0]["rows"]) recipes.insert(row["recipe"]);
  EXPECT_GE(recipes.size(), 8u);
}

TEST(Compare, RayKinds_AreACommaSeparatedList) {
  const json document = run_for_json(with(small_comparison, {"--rays", "ao,primary", "--camera", "auto"}));
  const json& rays = document["scenes"][0]["rows"][0]["rays"];
  EXPECT_EQ(rays.size(), 2u);
  EXPECT_TRUE(rays.contains("ao") && rays.contains("primary")) << rays;
}

TEST(Compare, SavedRays_ReplayToTheSameHits) {
  const TemporaryFolder folder;
  const json saved = run_for_json(with(small_comparison, {"--save-rays", "cube.rays"}), folder.path());
  const json replayed = run_for_json(with(small_comparison, {"--load-rays", "cube.rays"}), folder.path());
  for (const auto& [kind, rays] : saved["scenes"][0]["rows"][0]["rays"].items()) {
    const json& again = replayed["scenes"][0]["rows"][0]["rays"].at(kind);
    EXPECT_EQ(rays["rays"], again["rays"]);
    EXPECT_EQ(rays["hits"], again["hits"]);
    EXPECT_EQ(rays["node_tests_per_ray"], again["node_tests_per_ray"]);
  }
  const std::string before = read_file(folder.path() / "cube.rays");
  const Outcome refused = run_boxwood(with(small_comparison, {"--save-rays", "cube.rays"}), {.folder = folder.path()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(folder.path() / "cube.rays"), before);
}

TEST(Compare, Images_AreARenderingAndAHeatMapPerRecipe) {
  const TemporaryFolder folder;
  const json document = run_for_json(with(small_comparison, {"--images", "pictures"}), folder.path());
  const json& images = document["scenes"][0].at("images");
  EXPECT_TRUE(fs::exists(folder.path() / images.at("rendering").get<std::string>()));
  ASSERT_EQ(images.at("heat_maps").size(), 2u);
  for (const json& map : images["heat_maps"]) {
    EXPECT_TRUE(read_file(folder.path() / map.at("file").get<std::string>()).starts_with("\x89PNG"));
  }
  const Outcome refused = run_boxwood(with(small_comparison, {"--images", "pictures"}), {.folder = folder.path()});
  EXPECT_EQ(refused.exit_code, 2);
  const Outcome forced =
      run_boxwood(with(small_comparison, {"--images", "pictures", "--force"}), {.folder = folder.path()});
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
}

TEST(Render, Picture_IsNeverReplacedUnasked) {
  const TemporaryFolder folder;
  const std::vector<std::string> render = {"render", "generate:cube", "--size", "16x16"};
  EXPECT_EQ(run_boxwood(render, {.folder = folder.path()}).exit_code, 0);
  EXPECT_TRUE(read_file(folder.path() / "out.png").starts_with("\x89PNG"));
  write_file(folder.path() / "out.png", "precious");
  const Outcome refused = run_boxwood(render, {.folder = folder.path()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(folder.path() / "out.png"), "precious");
  EXPECT_EQ(run_boxwood(with(render, {"--force"}), {.folder = folder.path()}).exit_code, 0);
  EXPECT_TRUE(read_file(folder.path() / "out.png").starts_with("\x89PNG"));
}

TEST(Render, Exr_IsChosenByItsExtension) {
  const TemporaryFolder folder;
  run_for_json({"render", "generate:cube", "--size", "16x16", "-o", "cube.exr"}, folder.path());
  EXPECT_TRUE(read_file(folder.path() / "cube.exr").starts_with("\x76\x2f\x31\x01"));
}

TEST(Render, Picture_DependsNeitherOnRecipeNorThreads) {
  const TemporaryFolder folder;
  const std::vector<std::string> render = {"render", "generate:torus", "--size", "40x30", "--spp",
                                           "2",      "--integrator",   "ao"};
  run_for_json(with(render, {"-o", "a.png", "--threads", "1", "-a", "median > binary"}), folder.path());
  run_for_json(with(render, {"-o", "b.png", "--threads", "3", "-a", "best"}), folder.path());
  EXPECT_EQ(read_file(folder.path() / "a.png"), read_file(folder.path() / "b.png"));
}

TEST(Render, Json_TellsTheSpeedOfEveryRayKind) {
  const TemporaryFolder folder;
  const json document =
      run_for_json({"render", "generate:cube", "--size", "16x8", "--integrator", "ao"}, folder.path());
  EXPECT_EQ(document.at("file"), "out.png");
  EXPECT_EQ(document.at("rays").at("primary").at("rays"), 16 * 8);
  EXPECT_TRUE(document["rays"].contains("ao"));
  expect_estimate(document["rays"]["primary"].at("mrays_per_s"), 1);
  expect_estimate(document.at("build_ms"), 1);
}

TEST(Inspect, Json_DescribesTheTree) {
  const json document = run_for_json({"inspect", "generate:cube(4)", "-a", "binned > binary"});
  EXPECT_EQ(document.at("recipe"), "binned > binary");
  ASSERT_EQ(document.at("trees").size(), 1u);
  const json& tree = document["trees"][0];
  EXPECT_EQ(tree.at("references"), 12 * 16);
  EXPECT_EQ(tree.at("inner_nodes").get<int>() + 1, tree.at("leaves"));
  EXPECT_EQ(tree.at("max_arity"), 2);
  EXPECT_EQ(tree.at("sah_traversal_constant"), 1);
  EXPECT_EQ(tree.at("sah_cost"), document.at("sah_cost"));
  EXPECT_GT(tree.at("sibling_overlap").size(), 0u);
}

TEST(Inspect, Text_TellsWhatWasLeftOut) {
  const Outcome outcome = run_boxwood({"inspect", "generate:zero-area(10)"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("10 triangles are degenerate"), std::string::npos) << outcome.out;
}

TEST(Inspect, Instances_KeepTheirOwnTree) {
  const json document = run_for_json({"inspect", "generate:instances(count=5)"});
  EXPECT_EQ(document.at("instances"), 5);
  EXPECT_EQ(document.at("triangles").get<int>(), 5 * document.at("unique_triangles").get<int>());
  EXPECT_EQ(document.at("trees").size(), 1u);
}

class Verify : public ::testing::TestWithParam<std::string> {};

TEST_P(Verify, EveryStageAnswersLikeBruteForce) {
  const json document = run_for_json({"verify", GetParam(), "--rays", "400"});
  EXPECT_GT(document.at("rays"), 0);
  EXPECT_EQ(document.at("mismatches"), 0) << document;
  EXPECT_EQ(document.at("leaks"), 0) << document;
  EXPECT_GE(document.at("rows").size(), 8u);
}

INSTANTIATE_TEST_SUITE_P(On, Verify,
                         ::testing::Values("generate:knot(6)", "generate:instances(count=6, detail=4)",
                                           "generate:random(300)", "generate:none", "generate:coincident(50)"));

TEST(Verify, ClosedMesh_IsTestedForLeaksFromInside) {
  const json closed = run_for_json({"verify", "generate:torus(12)", "--rays", "400", "-a", "default"});
  EXPECT_EQ(closed.at("closed_meshes"), 1);
  EXPECT_EQ(closed.at("rays_from_inside"), 400);
  const json open = run_for_json({"verify", "generate:terrain(8)", "--rays", "400", "-a", "default"});
  EXPECT_EQ(open.at("closed_meshes"), 0);
  EXPECT_EQ(open.at("rays_from_inside"), 0);
}

TEST(Verify, LoadedRays_AreChecked) {
  const TemporaryFolder folder;
  run_for_json(with(small_comparison, {"--save-rays", "cube.rays"}), folder.path());
  const json document =
      run_for_json({"verify", "generate:cube(4)", "--load-rays", "cube.rays", "-a", "default"}, folder.path());
  EXPECT_TRUE(document.at("rays_by_kind").contains("ao")) << document;
}

TEST(Recipes, Markdown_NamesEveryStageAndOption) {
  const json document = run_for_json({"recipes"});
  const Outcome markdown = run_boxwood({"recipes", "--markdown"});
  EXPECT_GE(document.at("stages").size(), 8u);
  EXPECT_GE(document.at("presets").size(), 3u);
  for (const json& stage : document["stages"]) {
    EXPECT_NE(markdown.out.find(fmt::format("### `{}`", stage.at("name").get<std::string>())), std::string::npos);
    for (const json& option : stage.at("options")) {
      EXPECT_NE(markdown.out.find(fmt::format("`{}`", option.at("name").get<std::string>())), std::string::npos);
      EXPECT_FALSE(option.at("values").get<std::string>().empty());
    }
  }
}

TEST(Scenes, EveryGenerator_CanBeInspected) {
  const json document = run_for_json({"scenes"});
  EXPECT_GE(document.at("generators").size(), 10u);
  for (const json& generator : document["generators"]) {
    const std::string scene = fmt::format("generate:{}", generator.at("name").get<std::string>());
    const Outcome outcome = run_boxwood({"inspect", scene, "-a", "fast"});
    EXPECT_EQ(outcome.exit_code, 0) << scene << ": " << outcome.err;
  }
}

TEST(Bench, Quick_MeasuresBuildsMemoryAndTracing) {
  const json document = run_for_json({"bench", "--quick"});
  EXPECT_TRUE(document.at("peer").is_null());
  ASSERT_GE(document.at("build").size(), 1u);
  for (const json& row : document["build"][0].at("rows")) expect_estimate(row.at("ns_per_triangle"), 3);
  ASSERT_GE(document.at("trace").size(), 1u);
  EXPECT_GE(document["trace"][0].at("rows").size(), 3u);
}

TEST(Bench, AgainstEmbree_GivesTheRatioOfEveryColumn) {
  const json document = run_for_json({"bench", "--quick", "--peer", "embree"});
  if (document.at("peer").is_null()) GTEST_SKIP() << "compiled without Embree";
  for (const json& bench : {document, document.at("all_threads")}) {
    for (const char* column :
         {"closest.primary.batch", "closest.diffuse.batch", "closest.random.batch", "any.shadow.batch", "any.ao.batch",
          "closest.primary.single", "closest.diffuse.single", "closest.random.single", "any.shadow.single",
          "any.ao.single", "build.fast", "build.default", "build.best"}) {
      expect_estimate(bench.at("geometric_means").at(column), 3);
    }
    for (const json& scene : bench.at("scenes")) {
      EXPECT_GT(scene.at("bytes_per_triangle").at("default").at("median").get<double>(), 0);
      EXPECT_LE(scene.at("columns").at("closest.diffuse.batch").at("mismatches").get<int>(), 10);
    }
  }
}

}  // namespace
}  // namespace boxwood::testing
