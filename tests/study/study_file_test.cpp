// What a study file says, and what is wrong with it.
#include "study/study_file.h"

#include <gtest/gtest.h>

#include "boxwood/error.h"

namespace boxwood::testing {
namespace {

const std::string head = R"toml(
[[scene]]
name = "cube"
find = ["generate:cube"]
)toml";

const std::string two_recipes = R"toml(
[[recipes]]
label = "{method} {k}"
recipe = "{method} > wide({k})"
[recipes.values]
k = [2, 4]
method = { plain = "median(k={k})", cost = "binned(k={k}, bins={bins})" }
[recipes.set]
bins = 8
)toml";

Study parse(const std::string& text, bool quick = false) { return parse_study(text, "test.toml", quick); }

TEST(StudyFile, Recipes_AreEveryCombinationOfTheValues) {
  const Study study = parse(head + two_recipes);
  ASSERT_EQ(study.recipes.size(), 4u);
  EXPECT_EQ(study.name, "test");
  std::set<std::string> texts, labels;
  for (const RecipeSpec& recipe : study.recipes) {
    texts.insert(recipe.text);
    labels.insert(recipe.label);
    EXPECT_EQ(recipe.factors.at("bins"), "8");
  }
  EXPECT_TRUE(texts.contains("binned(bins=8, k=4) > wide(4)")) << *texts.begin();
  EXPECT_EQ(labels, (std::set<std::string>{"plain 2", "plain 4", "cost 2", "cost 4"}));
}

TEST(StudyFile, Quick_LaysItsTableOverTheRun) {
  const std::string text =
      "quick = { repetitions = 2 }\nrun = { repetitions = 7, size = [30, 20] }\n" + head + two_recipes;
  EXPECT_EQ(parse(text).run.repetitions, 7u);
  EXPECT_EQ(parse(text, true).run.repetitions, 2u);
  EXPECT_EQ(parse(text, true).run.width, 30u);
}

TEST(StudyFile, Claims_SayWhatTheyExpect) {
  const Study study = parse(head + two_recipes + R"toml(
[[claim]]
id = "A"
text = "wider is faster"
published = "1.1"
value = "build_ms + trace_ms"
where = { k = 4 }
baseline = { k = 2 }
each = ["scene", "method"]
above = 1
need = 0.5
)toml");
  ASSERT_EQ(study.claims.size(), 1u);
  const ClaimSpec& claim = study.claims[0];
  EXPECT_EQ(claim.expect->kind, Expectation::Kind::above);
  EXPECT_EQ(claim.figure.where.at("k"), std::vector<std::string>{"4"});
  EXPECT_EQ(claim.each.size(), 2u);
  EXPECT_EQ(claim.need, "0.5");
}

struct Mistake {
  std::string text, told;
};

class StudyMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(StudyMistake, IsRefusedWithItsPlace) {
  try {
    parse(GetParam().text);
    ADD_FAILURE() << "was accepted";
  } catch (const UsageError& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with("test.toml")) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find(GetParam().told), std::string::npos) << what;
  }
}

const std::string plot = head + two_recipes + "[[plot]]\nid = \"P\"\nvalue = \"trace_ms\"\n";
const std::string table = head + two_recipes + "[[table]]\nid = \"T\"\nvalue = \"bytes\"\n";
const std::string claim = head + two_recipes + "[[claim]]\nid = \"A\"\ntext = \"t\"\n";

INSTANTIATE_TEST_SUITE_P(
    Of, StudyMistake,
    ::testing::Values(Mistake{"scene = ", "no TOML"}, Mistake{"", "[[scene]]"}, Mistake{head, "[[recipes]]"},
                      Mistake{"titel = 'x'\n" + head + two_recipes,
                              "test.toml:1: 'titel' means nothing here; did you mean 'title'"},
                      Mistake{head + "[[recipes]]\nrecipe = \"binnd > wide(4)\"", "'binned'"},
                      Mistake{head + "[[recipes]]\nrecipe = \"binned > wide({k})\"", "{k}"},
                      Mistake{head + "[[recipes]]\nrecipe = \"{a}\"\nvalues = { a = \"{a}\" }", "circles"},
                      Mistake{head + head + two_recipes, "two scenes"},
                      Mistake{"[run]\nrays = [\"primry\"]\n" + head + two_recipes, "'primary'"},
                      Mistake{"[run]\nrepetitions = 0\n" + head + two_recipes, "test.toml:2: 'run.repetitions'"},
                      Mistake{"[run]\nprobes = [\"tme\"]\n" + head + two_recipes, "'time'"},
                      Mistake{"[run]\nsize = 3\n" + head + two_recipes, "[width, height]"},
                      Mistake{"[run]\nscenes = [\"cubes\"]\n" + head + two_recipes, "'cube'"},
                      Mistake{table + "published = \"\"\"\na | b\nc\n\"\"\"", "has 1 cells in 'c' and 2"},
                      Mistake{claim, "needs an expectation"}, Mistake{claim + "above = 1", "needs 'value'"},
                      Mistake{claim + "above = 1\nbelow = 1\nvalue = \"trace_ms\"", "second expectation"},
                      Mistake{claim + "above = 1\nvalue = \"trace_m\"", "'trace_ms'"},
                      Mistake{claim + "above = 1\nvalue = \"trace_ms\"\nwhere = { kk = 4 }", "'k'"},
                      Mistake{claim + "above = 1\nvalue = \"trace_ms\"\nwhere = { k = 3 }", "knows no k '3'"},
                      Mistake{claim + "above = 1\nvalue = \"trace_ms\"\nneed = \"lots\"", "most"},
                      Mistake{claim + "above = 1\nvalue = \"trace_ms\"\neach = [\"view\"]", "views = \"each\""},
                      Mistake{claim + "splits_at = [1, 2]\nvalue = \"trace_ms\"", "needs 'versus'"},
                      Mistake{claim + "rises_with = \"k\"\nvalue = \"trace_ms\"\nversus = { value = \"hits\" }",
                              "used by no expectation"},
                      Mistake{claim + "above = 1\nvalue = \"baseline.trace_ms - trace_ms\"", "needs 'baseline'"},
                      Mistake{plot + "x = \"bytez\"\nkind = \"scatter\"", "'bytes'"},
                      Mistake{plot + "x = \"bytes\"", "no factor 'bytes'"},
                      Mistake{plot + "x = \"bytes\"\nkind = \"scatter\"\nfront = [\"low\"]", "better ends"},
                      Mistake{plot + "x = \"k\"\nkind = \"scatter\"\nfront = [\"low\", \"high\"]", "arithmetic"}));

TEST(StudyFile, PublishedTables_AreLinesOfCells) {
  const Study study = parse(table + "published = \"\"\"\nscene | k = 4\n\nsmall room | 1.5 \n\"\"\"");
  const std::vector<std::vector<std::string>> expected = {{"scene", "k = 4"}, {"small room", "1.5"}};
  EXPECT_EQ(study.tables.at(0).published, expected);
}

TEST(StudyFile, ThatIsNotThere_IsNamed) { EXPECT_THROW(read_study("no-such-study.toml"), Error); }

}  // namespace
}  // namespace boxwood::testing
