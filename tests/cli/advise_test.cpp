// `boxwood advise` and `boxwood soak`.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

using Arguments = std::vector<std::string>;
constexpr const char* small_scene = "generate:sphere(detail=4)";

TEST(AdviseCommand, RecommendsARecipeThatBuildsAndKeepsTheRays) {
  const TemporaryFolder folder;
  const auto advice = run_for_json(
      {"advise", small_scene, "--time", "300ms", "--rays", "primary,ao", "--save-rays", "a.rays"}, folder.path());
  EXPECT_EQ(advice["triangles"], 192);
  EXPECT_GT(advice["candidates"], 100);
  EXPECT_FALSE(advice["interrupted"]);
  const auto& rows = advice["rows"];
  const std::string pick = advice["recommended"];
  const auto row = std::ranges::find_if(rows, [&](const auto& each) { return each["recipe"] == pick; });
  ASSERT_NE(row, rows.end());
  EXPECT_GT((*row)["mrays_per_s"]["median"], 0);
  for (const auto& each : rows) {  // nothing measured beats a member of the front in everything
    if (!each["on_front"]) continue;
    for (const auto& other : rows) {
      EXPECT_FALSE(other["mrays_per_s"]["median"] > each["mrays_per_s"]["median"] && other["bytes"] < each["bytes"] &&
                   other["build_ms"]["median"] < each["build_ms"]["median"]);
    }
  }
  run_for_json({"inspect", small_scene, "-a", pick, "--size", "8x8"}, folder.path());
  const auto again = run_for_json({"advise", small_scene, "--time", "200ms", "--rays", "a.rays"}, folder.path());
  EXPECT_EQ(again["rounds"][0]["triangles"], 192);
}

TEST(AdviseCommand, KeepsTheLimitOfMemory) {
  const auto advice =
      run_for_json({"advise", small_scene, "--time", "1s", "--rays", "primary", "--memory-limit", "20kB"});
  const std::string pick = advice["recommended"];
  for (const auto& row : advice["rows"]) {
    if (row["recipe"] == pick) {
      EXPECT_LE(row["bytes"], 20'000);
    }
  }
}

TEST(AdviseCommand, RefusesWithOneSentence) {
  const auto fails = [](const Arguments& arguments, int exit_code, const std::string& sentence) {
    const Outcome outcome = run_boxwood(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
  };
  fails({"advise", small_scene, "--rays", "primery"}, 2, "did you mean 'primary'");
  fails({"advise", small_scene, "--time", "soon"}, 2, "a time such as");
  fails({"advise", small_scene, "--memory-limit", "1 TB"}, 2, "an amount such as");
  fails({"advise", "generate:none"}, 1, "has no triangles");
  fails({"advise", small_scene, "--time", "200ms", "--rays", "primary", "--memory-limit", "1B"}, 1, "keeps the limits");
}

TEST(SoakCommand, SameSeedSameCases) {
  const Arguments command = {"soak", "--seed", "5", "--cases", "4", "--rays", "20", "--seconds", "250"};
  const auto first = run_for_json(command), second = run_for_json(command);
  EXPECT_EQ(first["cases"], 4);
  EXPECT_TRUE(first["failures"].empty()) << first["failures"];
  EXPECT_EQ(first, second);
  const Outcome text = run_boxwood(with(command, {"--first", "4"}));
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("4 cases"), std::string::npos) << text.out;
}

}  // namespace
}  // namespace boxwood::testing
