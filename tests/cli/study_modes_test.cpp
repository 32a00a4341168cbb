// The modes of the single slab study: frames of a sequence, timed frames with their report, the viewer.
#include <gtest/gtest.h>

#include <algorithm>

#include "program.h"

namespace boxwood::testing {
namespace {

TEST(VideoCommand, MakesOnePicturePerSceneFromTheFirstScenesCamera) {
  const TemporaryFolder folder;
  const nlohmann::json document = run_for_json(
      {"video", "generate:sphereflake(depth=1)", "generate:sphereflake(depth=0)", "--size", "40x30", "-o", "frames"},
      folder.path());
  ASSERT_EQ(document.at("frames").size(), 2u);
  // The same camera for a scene of its own: rendered alone from that camera it is the same picture.
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frames/frame-00000.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frames/frame-00001.png"));
  run_for_json({"render", "generate:sphereflake(depth=1)", "--size", "40x30", "-o", "alone.png"}, folder.path());
  EXPECT_EQ(read_file(folder.path() / "alone.png"), read_file(folder.path() / "frames/frame-00000.png"));
  const Outcome again =
      run_boxwood({"video", "generate:sphereflake(depth=1)", "-o", "frames"}, {.folder = folder.path()});
  EXPECT_NE(again.exit_code, 0);
  EXPECT_NE(again.err.find("frame-00000.png"), std::string::npos);
}

TEST(TestCommand, ReportsThePlanInItsOrderToConsoleAndFile) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments{"test",     "generate:sphereflake(depth=1)",
                                           "--frames", "2",
                                           "--size",   "32x24",
                                           "-a",       "middle(plane=box) > slab(index=64)",
                                           "-a",       "middle(plane=box) > binary-split(index=64)",
                                           "-a",       "middle(plane=box) > slab(index=64)"};
  std::vector<std::string> with_file = arguments;
  with_file.insert(with_file.end(), {"-o", "report.txt"});
  const Outcome outcome = run_boxwood(with_file, {.folder = folder.path()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read_file(folder.path() / "report.txt"));
  for (const char* line : {"tree height: ", "inner node count: ", "computed memory usage of nodes: ",
                           "average node surface ratio approx/real: ", "average node intersections per ray: ",
                           "minimum traversal time: ", "maximum raytrace time: "}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line;
  }
  const nlohmann::json tests = run_for_json(arguments, folder.path()).at("tests");
  ASSERT_EQ(tests.size(), 3u);
  EXPECT_EQ(tests[0].at("recipe"), tests[2].at("recipe"));
  const std::uint64_t n = tests[0].at("triangles");
  EXPECT_EQ(tests[0].at("inner_nodes"), n - 1);
  EXPECT_EQ(tests[0].at("node_bytes"), (2 * n - 1) * 12);
  EXPECT_EQ(tests[1].at("node_bytes"), (2 * n - 1) * 32);
  EXPECT_EQ(tests[0].at("tree_height"), tests[1].at("tree_height"));
  EXPECT_GT(tests[0].at("surface_ratio"), 1.0);
  EXPECT_EQ(tests[1].at("surface_ratio"), 0.0);
  EXPECT_GT(tests[0].at("node_tests_per_ray"), tests[1].at("node_tests_per_ray"));
}

TEST(ViewCommand, RefusesABadRecipeBeforeAnythingOpens) {
  const Outcome outcome = run_boxwood({"view", "generate:sphereflake", "-a", "sweeep > slab"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("sweep"), std::string::npos);
}

}  // namespace
}  // namespace boxwood::testing
