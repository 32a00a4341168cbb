// What a user who made a mistake, or has bad luck, is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

struct Mistake {
  std::vector<std::string> arguments;
  std::string told;  ///< part of the sentence
};

class BadRequest : public ::testing::TestWithParam<Mistake> {};

TEST_P(BadRequest, ExitsWithTwoAndOneSentence) {
  const TemporaryFolder folder;
  const Outcome outcome = run_boxwood(GetParam().arguments, {.folder = folder.path()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("boxwood: ")) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().told), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Of, BadRequest,
    ::testing::Values(Mistake{{"rener"}, "did you mean 'render'"}, Mistake{{"compare"}, "SCENE"},
                      Mistake{{"compare", "generate:cube", "--repat", "3"}, "did you mean '--repeat'"},
                      Mistake{{"compare", "generate:cube", "--rays", "primry"}, "did you mean 'primary'"},
                      Mistake{{"compare", "generate:cube", "-a", "binnned"}, "did you mean 'binned'"},
                      Mistake{{"compare", "generate:cube", "-a", "binned(bin=3) > binary"}, "did you mean 'bins'"},
                      Mistake{{"compare", "generate:cube", "generate:torus", "--save-rays", "r"}, "one scene"},
                      Mistake{{"compare", "generate:cube", "--load-rays", "r", "--rays", "ao"}, "--rays"},
                      Mistake{{"compare", "generate:cube", "--threads", "0"}, "--threads"},
                      Mistake{{"render", "cube"}, "generate:cube"}, Mistake{{"render", "generate:cub"}, "'cube'"},
                      Mistake{{"render", "generate:cube", "generate:cube"}, "too many"},
                      Mistake{{"render", "generate:cube", "--size", "640"}, "WIDTHxHEIGHT"},
                      Mistake{{"render", "generate:cube", "--size", "0x1"}, "WIDTHxHEIGHT"},
                      Mistake{{"render", "generate:cube", "--spp", "0"}, "--spp"},
                      Mistake{{"render", "generate:cube", "--integrator", "aoo"}, "'ao'"},
                      Mistake{{"render", "generate:cube", "--camera", "left"}, "auto"},
                      Mistake{{"render", "generate:cube", "-o", "cube.jpg"}, ".png or .exr"},
                      Mistake{{"render", "generate:cube", "-o", "no-such-folder/cube.png"}, "no-such-folder"},
                      Mistake{{"bench", "--peer", "magic"}, "embree"},
                      Mistake{{"recipes", "--json", "--markdown"}, "--markdown"}));

class Command : public ::testing::TestWithParam<std::string> {};

TEST_P(Command, HasHelp) {
  const Outcome outcome = run_boxwood({GetParam(), "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("boxwood " + GetParam()), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.err, "");
}

INSTANTIATE_TEST_SUITE_P(Of, Command,
                         ::testing::Values("render", "compare", "inspect", "verify", "cameras", "bench", "recipes",
                                           "scenes"));

TEST(Boxwood, WithoutArguments_PrintsHelp) {
  const Outcome outcome = run_boxwood({});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("compare"), std::string::npos);
}

TEST(Boxwood, Version_IsOneLine) {
  const Outcome outcome = run_boxwood({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out.starts_with("boxwood ")) << outcome.out;
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 1);
}

TEST(SceneFile, Missing_FailsWithAHintWhereScenesAre) {
  for (const char* command : {"render", "compare", "inspect", "verify"}) {
    const Outcome outcome = run_boxwood({command, "no-such-file.ply"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("boxwood scenes"), std::string::npos) << outcome.err;
  }
}

TEST(SceneFile, Broken_FailsWithItsName) {
  const TemporaryFolder folder;
  write_file(folder.path() / "broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  const Outcome outcome = run_boxwood({"inspect", "broken.ply"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("broken.ply"), std::string::npos) << outcome.err;
}

TEST(RayFile, Broken_FailsWithItsName) {
  const TemporaryFolder folder;
  write_file(folder.path() / "broken.rays", "these are no rays");
  for (const char* command : {"compare", "verify"}) {
    const Outcome outcome =
        run_boxwood({command, "generate:cube", "--load-rays", "broken.rays"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("broken.rays"), std::string::npos) << outcome.err;
  }
}

TEST(StandardOutput, Full_IsAnError) {
  const Outcome outcome = run_boxwood({"recipes"}, {.out_file = "/dev/full"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
}

TEST(Interrupt, StopsCleanlyAndLeavesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = run_boxwood({"render", "generate:knot", "--size", "2048x2048", "--spp", "256"},
                                      {.folder = folder.path(), .interrupt_after_ms = 1000});
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace boxwood::testing
