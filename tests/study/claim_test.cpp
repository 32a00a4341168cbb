// Verdicts on made-up figures whose truth is known.
#include "study/claim.h"

#include <gtest/gtest.h>

#include "study/studies.h"
#include "study/study_result.h"

namespace boxwood::testing {
namespace {

/// trace_ms of a recipe on a scene in a repetition.
using Truth = std::function<double(const std::string& scene, const RecipeSpec& recipe, int repetition)>;

/// Noise between 0.99 and 1.01, the same for all recipes half of it.
double noise(int repetition, std::size_t recipe) {
  const double own[] = {0.1, -0.4, 0.3, 0.0, -0.2, 0.5, -0.5, 0.2};
  return 1 + 0.01 * own[(static_cast<std::size_t>(repetition) * 3 + recipe) % 8];
}

/// Builds take 100 ms for k = 2, 120 for 4, 60 for 8.
JudgedClaim judge_with(const std::string& claim, const Truth& truth, int repetitions = 8,
                       const std::string& value = "trace_ms") {
  const Study study = parse_study(
      made_up_study + "[[claim]]\nid = \"C\"\ntext = \"t\"\nvalue = \"" + value + "\"\n" + claim, "test.toml");
  const TemporaryStore folder;
  Store store = folder.open();
  const std::int64_t here = store.environment_number(this_environment());
  for (const SceneSpec& scene : study.scenes) {
    for (const RecipeSpec& recipe : study.recipes) {
      const Subject built = subject_of(study, scene, recipe, "build", 0);
      const std::string& k = recipe.factors.at("k");
      const std::vector<StoredValue> build = {{"build_ms", "ms", k == "2" ? 100.0 : k == "4" ? 120.0 : 60.0}};
      store.add(built, build, here);
      for (const char* view : {"a", "b"}) {
        for (int r = 0; r < repetitions; ++r) {
          Subject s = subject_of(study, scene, recipe, "time", static_cast<std::uint32_t>(r));
          s.triangles = scene.name == "small" ? 10 : 1000;
          s.view = view;
          s.width = s.height = 8;
          s.rays = "primary";
          s.seed = 1;
          const std::vector<StoredValue> values = {{"trace_ms", "ms", truth(scene.name, recipe, r)},
                                                   {"hits", "rays", recipe.factors.at("k") == "8" ? 7.0 : 5.0}};
          store.add(s, values, here);
        }
      }
    }
  }
  return judge(study, Observations(study, store, here), study.claims.front());
}

/// k = 4 takes 0.8 of the time of k = 2, k = 8 1.5 of it.
double usual(const std::string&, const RecipeSpec& recipe, int repetition) {
  const std::string& k = recipe.factors.at("k");
  const double time = k == "2" ? 10 : k == "4" ? 8 : 15;
  return time * noise(repetition, recipe.text.size());
}

const std::string of_four = "where = { k = 4 }\nbaseline = { k = 2 }\neach = [\"scene\", \"method\"]\n";
const std::string of_eight = "where = { k = 8 }\nbaseline = { k = 2 }\neach = [\"scene\", \"method\"]\n";

TEST(Claim, OnTheRightSide_Holds) {
  const JudgedClaim claim = judge_with(of_four + "above = 1", usual);
  EXPECT_EQ(claim.verdict, Verdict::holds) << claim.measured;
  ASSERT_EQ(claim.cells.size(), 4u);
  for (const JudgedCell& judged : claim.cells) {
    EXPECT_NEAR(judged.cell.estimate.median, 1.25, 0.02);
    EXPECT_NEAR(judged.cell.mean, 1.25, 0.02);
    EXPECT_LT(judged.cell.estimate.low, judged.cell.estimate.high);
    EXPECT_LT(judged.p_value, 0.001);
    EXPECT_LT(judged.welch_p_value, 0.001);
  }
}

TEST(Claim, OnTheWrongSide_DoesNotHold) {
  EXPECT_EQ(judge_with(of_eight + "above = 1", usual).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(of_four + "below = 1", usual).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(of_eight + "below = 1", usual).verdict, Verdict::holds);
}

TEST(Claim, WithinTheNoise_IsInconclusive) {
  const auto equal = [](const std::string&, const RecipeSpec& recipe, int r) {
    return 10 * noise(r, recipe.factors.at("k") == "2" ? 0 : 1);
  };
  EXPECT_EQ(judge_with(of_four + "above = 1.001", equal).verdict, Verdict::inconclusive);
  // A difference that nobody would notice is none.
  EXPECT_EQ(judge_with(of_four + "differs_from = 1", equal).verdict, Verdict::does_not_hold);
}

TEST(Claim, FromOneRepetition_IsNeverCertain) {
  EXPECT_EQ(judge_with(of_four + "above = 1", usual, 1).verdict, Verdict::inconclusive);
}

TEST(Claim, Between_NeedsTheWholeInterval) {
  EXPECT_EQ(judge_with(of_four + "between = [1.2, 1.3]", usual).verdict, Verdict::holds);
  EXPECT_EQ(judge_with(of_four + "between = [1.25, 1.3]", usual).verdict, Verdict::inconclusive);
  EXPECT_EQ(judge_with(of_four + "between = [1.5, 1.6]", usual).verdict, Verdict::does_not_hold);
}

TEST(Claim, Need_SaysHowManyCellsMust) {
  const auto only_small = [](const std::string& scene, const RecipeSpec& recipe, int r) {
    const bool faster = scene == "small" && recipe.factors.at("k") == "4";
    return (faster ? 5 : 10) * noise(r, recipe.text.size());
  };
  EXPECT_EQ(judge_with(of_four + "above = 1.5\nneed = \"all\"", only_small).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(of_four + "above = 1.5\nneed = \"any\"", only_small).verdict, Verdict::holds);
  EXPECT_EQ(judge_with(of_four + "above = 1.5\nneed = \"most\"", only_small).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(of_four + "above = 1.5\nneed = 0.5", only_small).verdict, Verdict::holds);
  const JudgedClaim mean = judge_with(of_four + "above = 1.3\nneed = \"mean\"", only_small);
  EXPECT_EQ(mean.verdict, Verdict::holds);
  ASSERT_EQ(mean.cells.size(), 1u);
  EXPECT_EQ(mean.cells[0].cell.members, 4u);
  EXPECT_NEAR(mean.cells[0].cell.estimate.median, std::sqrt(2.0), 0.02);  // the geometric mean of 2 and 1
}

TEST(Claim, Same_ComparesEveryFigureOfACell) {
  const std::string hits = "same = true\neach = [\"scene\"]\n";
  const auto with_hits = [&](const std::string& where) { return judge_with(where + hits, usual).verdict; };
  // 'value' stands before; the last one would win if TOML allowed two.
  EXPECT_EQ(with_hits(""), Verdict::does_not_hold);  // times differ
}

TEST(Claim, Trend_FollowsTheRanks) {
  const std::string along = "each = [\"method\", \"scene\", \"k\"]\n";
  const auto by_k = [](const std::string&, const RecipeSpec& recipe, int r) {
    return std::stod(recipe.factors.at("k")) * noise(r, recipe.text.size());
  };
  EXPECT_EQ(judge_with(along + "rises_with = \"k\"", by_k).verdict, Verdict::holds);
  EXPECT_EQ(judge_with(along + "falls_with = \"k\"", by_k).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(along + "rises_with = \"triangles\"", by_k).verdict, Verdict::inconclusive);
}

TEST(Claim, Versus_DividesByTheSecondFigure) {
  // k = 8 is 1.5 times as slow as k = 2, k = 4 1.25 times as fast: together 1.875.
  const std::string versus = "versus = { value = \"trace_ms\", where = { k = 8 }, baseline = { k = 2 } }\n";
  const JudgedClaim claim = judge_with(of_four + versus + "above = 1.8", usual);
  EXPECT_EQ(claim.verdict, Verdict::holds) << claim.measured;
  ASSERT_EQ(claim.cells.size(), 4u);
  for (const JudgedCell& judged : claim.cells) EXPECT_NEAR(judged.cell.estimate.median, 1.875, 0.05);
  // A figure that does not depend on the rays, and is the same in every run.
  const JudgedClaim of_hits = judge_with(
      "where = { k = 4 }\neach = [\"scene\", \"rays\"]\nversus = { value = \"hits\", where = { k = 4 } }\nbetween = "
      "[1.5, 1.7]",
      usual);
  EXPECT_EQ(of_hits.verdict, Verdict::holds) << of_hits.measured;  // 8 ms over 5 hits
}

TEST(Claim, Versus_IsWhatTrendsFollowAndSidesAreComparedWith) {
  const std::string each = "each = [\"scene\", \"method\", \"k\"]\n";
  const std::string hits = "versus = { value = \"hits\" }\n";
  // Five hits for k = 2 and 4, seven for k = 8, which is the slowest.
  EXPECT_EQ(judge_with(each + hits + "rises_with = \"versus\"", usual).verdict, Verdict::holds);
  EXPECT_EQ(judge_with(each + hits + "falls_with = \"versus\"", usual).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(each + hits + "unrelated_to = \"versus\"", usual).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judge_with(each + hits + "splits_at = [12, 6]", usual).verdict, Verdict::holds);
  EXPECT_EQ(judge_with(each + hits + "splits_at = [9, 6]\nneed = 0.6", usual).verdict, Verdict::holds);
  EXPECT_EQ(judge_with(each + hits + "splits_at = [9, 6]\nneed = 0.7", usual).verdict, Verdict::does_not_hold);
  const auto by_method = [](const std::string&, const RecipeSpec& recipe, int r) {
    return (recipe.factors.at("method") == "median" ? 3 : 4) * noise(r, recipe.text.size());
  };
  EXPECT_EQ(judge_with(each + hits + "unrelated_to = \"versus\"", by_method).verdict, Verdict::holds);
}

TEST(Claim, Value_MayNameMetricsOfTheBaseline) {
  const std::string frames = "(build_ms - baseline.build_ms) / (baseline.trace_ms - trace_ms)";
  // 20 ms more to build, 2 ms less to trace; 40 less to build, 5 more to trace.
  const JudgedClaim four = judge_with(of_four + "between = [9, 11]", usual, 8, frames);
  EXPECT_EQ(four.verdict, Verdict::holds) << four.measured;
  ASSERT_EQ(four.cells.size(), 4u);
  for (const JudgedCell& judged : four.cells) {
    EXPECT_EQ(judged.cell.values.size(), 8u);
    EXPECT_TRUE(judged.cell.baseline.empty());
    EXPECT_FALSE(judged.cell.exact);
  }
  const JudgedClaim eight = judge_with(of_eight + "between = [7.5, 8.5]", usual, 8, frames);
  EXPECT_EQ(eight.verdict, Verdict::holds) << eight.measured;
}

TEST(Claim, WithoutMeasurements_IsNotRun) {
  const JudgedClaim claim = judge_with(of_four + "above = 1", usual, 0);
  EXPECT_EQ(claim.verdict, Verdict::not_run);
  EXPECT_FALSE(claim.measured.empty());
}

}  // namespace
}  // namespace boxwood::testing
