// Tables that say how their cells spread, on made-up figures whose truth is known.
#include "study/spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "boxwood/error.h"
#include "study/studies.h"
#include "study/study_result.h"

namespace boxwood::testing {
namespace {

/// k = 4 builds in 100 ms; k = 2 in 50 and 200 (median), 300 and 400 (binned) on the small and the large scene.
double build_time(const std::string& scene, const Factors& factors) {
  if (factors.at("k") == "4") return 100;
  if (factors.at("method") == "median") return scene == "small" ? 50 : 200;
  return scene == "small" ? 300 : 400;
}

TableResult table_of(const std::string& rest) {
  const Study study = parse_study(made_up_study + "[[table]]\nid = \"t\"\nvalue = \"build_ms\"\n" + rest, "test.toml");
  const TemporaryStore folder;
  Store store = folder.open();
  const std::int64_t here = store.environment_number(this_environment());
  for (const SceneSpec& scene : study.scenes) {
    for (const RecipeSpec& recipe : study.recipes) {
      for (std::uint32_t r = 0; r < 3; ++r) {
        const Subject built = subject_of(study, scene, recipe, "build", r);
        store.add(built, std::vector<StoredValue>{{"build_ms", "ms", build_time(scene.name, recipe.factors)}}, here);
      }
    }
  }
  return evaluate(study, store, here).tables.front();
}

double figure_of(const TableResult& table, const std::string& what) {
  for (const Cell& cell : table.cells) {
    if (cell.factors.at(spread_factor) == what) return cell.estimate.median;
  }
  ADD_FAILURE() << "no " << what;
  return 0;
}

TEST(SpreadTable, OfRatios_HasLowestMeanHighestAndHowManyAreAbove1) {
  const TableResult table =
      table_of("where = { k = 4 }\nbaseline = { k = 2 }\nrows = [\"k\"]\nspread = [\"scene\", \"method\"]\n");
  EXPECT_EQ(table.spec.columns, std::vector<std::string>{spread_factor});
  EXPECT_NEAR(figure_of(table, "lowest"), 0.5, 1e-9);
  EXPECT_NEAR(figure_of(table, "highest"), 4, 1e-9);
  EXPECT_NEAR(figure_of(table, "mean"), std::pow(0.5 * 2 * 3 * 4, 0.25), 1e-9);
  EXPECT_EQ(figure_of(table, "above 1"), 3);
  EXPECT_EQ(figure_of(table, "all"), 4);
}

TEST(SpreadTable, OfFigures_CountsThemOnly) {
  const TableResult table = table_of("where = { k = 2 }\nrows = [\"k\"]\nspread = [\"scene\", \"method\"]\n");
  EXPECT_DOUBLE_EQ(figure_of(table, "lowest"), 50);
  EXPECT_DOUBLE_EQ(figure_of(table, "highest"), 400);
  EXPECT_EQ(figure_of(table, "all"), 4);
  EXPECT_EQ(table.cells.size(), 4u);
}

TEST(SpreadTable, WithColumnsToo_IsRefused) {
  EXPECT_THROW(table_of("rows = [\"k\"]\ncolumns = [\"method\"]\nspread = [\"scene\"]\n"), UsageError);
}

}  // namespace
}  // namespace boxwood::testing
