// `boxwood cameras` and the paths that `render --cameras` follows.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

TEST(Cameras, OfAGeneratedScene_AreListed) {
  const nlohmann::json document = run_for_json({"cameras", "generate:cube"});
  EXPECT_EQ(document["scene"], "cube");
  EXPECT_EQ(document["cameras"].back()["name"], "auto");
}

TEST(Cameras, OrbitRendered_GivesOnePictureForEachFrame) {
  const TemporaryFolder folder;
  run_for_json({"cameras", "generate:knot", "--path", "orbit", "--frames", "3", "-o", "path.json"}, folder.path());
  const nlohmann::json shots = run_for_json(
      {"render", "generate:knot", "--cameras", "path.json", "--size", "32x32", "-o", "knot.png"}, folder.path());
  ASSERT_EQ(shots.size(), 3u);
  std::vector<std::string> pictures;
  for (const char* name : {"knot-orbit-000.png", "knot-orbit-001.png", "knot-orbit-002.png"}) {
    pictures.push_back(read_file(folder.path() / name));
  }
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_NE(pictures[1], pictures[2]);
}

TEST(Cameras, Spline_NeedsTwoKeyFramesAndPassesThroughThem) {
  const TemporaryFolder folder;
  const Outcome refused = run_boxwood({"cameras", "generate:cube", "--path", "spline"}, {.folder = folder.path()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("two key frames"), std::string::npos) << refused.err;

  write_file(folder.path() / "triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_file(folder.path() / "triangle.cameras.json",
             R"({"cameras": [{"name": "a", "eye": [0,0,1], "direction": [0,0,-1], "up": [0,1,0], "fov": 40},
                             {"name": "b", "eye": [1,0,3], "direction": [0,0,-1], "up": [0,1,0], "fov": 60}]})");
  const nlohmann::json path =
      run_for_json({"cameras", "triangle.obj", "--path", "spline", "--frames", "5"}, folder.path())["cameras"];
  ASSERT_EQ(path.size(), 5u);
  EXPECT_EQ(path.front()["eye"], nlohmann::json({0, 0, 1}));
  EXPECT_EQ(path.back()["eye"], nlohmann::json({1, 0, 3}));
}

TEST(Cameras, WithoutAFileOfCameras_RenderFails) {
  const TemporaryFolder folder;
  const Outcome missing = run_boxwood({"render", "generate:cube", "--cameras", "none.json"}, {.folder = folder.path()});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("none.json"), std::string::npos) << missing.err;
}

}  // namespace
}  // namespace boxwood::testing
