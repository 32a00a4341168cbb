// `boxwood build`, and what is done with its files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

using Arguments = std::vector<std::string>;
constexpr const char* sphere_scene = "generate:sphere";

TEST(BuildCommand, KeepsAStructureThatCompareAndRenderTrace) {
  const TemporaryFolder folder;
  const auto built = run_for_json({"build", sphere_scene, "-a", "default", "-o", "a.boxwood"}, folder.path());
  EXPECT_EQ(built["file_bytes"], std::filesystem::file_size(folder.path() / "a.boxwood"));
  EXPECT_GT(built["load_ms"]["median"], 0);
  const auto compared = run_for_json({"compare", sphere_scene, "-a", "median > binary", "--structure", "a.boxwood",
                                      "--rays", "primary", "--repeat", "1", "--size", "24x24"},
                                     folder.path());
  const auto& rows = compared["scenes"][0]["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1]["file"], "a.boxwood");
  EXPECT_EQ(rows[1]["recipe"], built["recipe"]);
  EXPECT_EQ(rows[1]["rays"]["primary"]["mismatches"], 0);
  run_for_json({"render", sphere_scene, "--structure", "a.boxwood", "-o", "a.png", "--size", "24x24"}, folder.path());
  run_for_json({"render", sphere_scene, "-o", "b.png", "--size", "24x24"}, folder.path());
  EXPECT_EQ(read_file(folder.path() / "a.png"), read_file(folder.path() / "b.png"));
}

TEST(BuildCommand, RefusesWithOneSentence) {
  const TemporaryFolder folder;
  run_for_json({"build", sphere_scene, "-o", "a.boxwood"}, folder.path());
  const auto fails = [&](const Arguments& arguments, int exit_code, const std::string& sentence) {
    const Outcome outcome = run_boxwood(arguments, {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  fails({"build", sphere_scene}, 2, "name the file to write");
  fails({"build", sphere_scene, "-o", "a.boxwood"}, 2, "--force");
  fails({"build", sphere_scene, "-a", "binned > slab", "-o", "b.boxwood"}, 2, "cannot be saved");
  fails({"render", "generate:cube", "--structure", "a.boxwood", "-o", "c.png"}, 1, "build it anew from this scene");
  fails({"compare", "generate:cube", "--structure", "a.boxwood"}, 1, "build it anew from this scene");
  write_file(folder.path() / "cut.boxwood", read_file(folder.path() / "a.boxwood").substr(0, 1000));
  fails({"render", sphere_scene, "--structure", "cut.boxwood", "-o", "c.png"}, 1, "not a usable saved structure");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "c.png"));
}

}  // namespace
}  // namespace boxwood::testing
