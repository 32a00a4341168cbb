// The path tracer on a pbrt scene, from the command line.
#include <gtest/gtest.h>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

using nlohmann::json;

const char* const scene = R"(Scale -1 1 1 LookAt 0 1 3  0 0 0  0 1 0
Camera "perspective" "float fov" 50
Film "rgb" "integer xresolution" 40 "integer yresolution" 30
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [9 9 9]
  Shape "trianglemesh" "point3 P" [-1 3 -1  1 3 -1  1 3 1  -1 3 1] "integer indices" [0 1 2 0 2 3]
AttributeEnd
Shape "trianglemesh" "point3 P" [-3 -1 -3  3 -1 -3  3 -1 3  -3 -1 3] "integer indices" [0 2 1 0 3 2]
Material "conductor" "float roughness" 0
Shape "sphere"
)";

TEST(PathRender, Json_TellsBothQueriesApart) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.pbrt", scene);
  const json document =
      run_for_json({"render", "a.pbrt", "--integrator", "path", "--spp", "4", "--depth", "3"}, folder.path());
  EXPECT_EQ(document.at("camera"), "pbrt");
  EXPECT_EQ(document.at("width"), 40) << "the size that the file asks for";
  EXPECT_EQ(document.at("rays").at("primary").at("rays"), 40 * 30 * 4);
  EXPECT_EQ(document["rays"].at("shadow").at("query"), "any_hit");
  EXPECT_EQ(document["rays"].at("reflection").at("query"), "closest_hit");
  const json& queries = document.at("queries");
  EXPECT_EQ(queries.at("any_hit").at("rays"), document["rays"]["shadow"]["rays"]);
  EXPECT_GT(queries.at("closest_hit").at("rays"), 40 * 30 * 4);
  EXPECT_TRUE(queries["closest_hit"].at("trace_ms").contains("median"));
}

TEST(PathRender, Exposure_BrightensPngButNotExr) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.pbrt", scene);
  const std::vector<std::string> render = {"render", "a.pbrt", "--integrator", "path", "--size", "16x16"};
  run_for_json(with(render, {"-o", "dark.png", "--exposure", "-3"}), folder.path());
  run_for_json(with(render, {"-o", "bright.png", "--exposure", "3"}), folder.path());
  EXPECT_NE(read_file(folder.path() / "dark.png"), read_file(folder.path() / "bright.png"));
  run_for_json(with(render, {"-o", "dark.exr", "--exposure", "-3"}), folder.path());
  run_for_json(with(render, {"-o", "bright.exr", "--exposure", "3"}), folder.path());
  EXPECT_EQ(read_file(folder.path() / "dark.exr"), read_file(folder.path() / "bright.exr"));
  const Outcome wrong = run_boxwood(with(render, {"--exposure", "bright"}), {.folder = folder.path()});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("takes a number of stops"), std::string::npos) << wrong.err;
}

TEST(PathRender, WhatIsWrongInASceneIsToldWithItsLine) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.pbrt", "WorldBegin\nShape \"sphere\" \"float radius\" [1\n");
  const Outcome outcome = run_boxwood({"render", "a.pbrt"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("a.pbrt:"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace boxwood::testing
