#include "boxwood/recipe.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "boxwood/error.h"
#include "options/suggest.h"
#include "recipe/stage.h"

namespace boxwood {
namespace {

std::string usage_error(const std::string& text) {
  try {
    Recipe::parse(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string first_of(StageKind kind) {
  for (const Stage& stage : stages()) {
    if (stage.kind == kind) return stage.name;
  }
  return "";
}

/// A complete recipe around one stage.
std::string recipe_with(const Stage& stage, const std::string& call) {
  switch (stage.kind) {
    case StageKind::builder:
      return call + " > wide(16)";
    case StageKind::refinement:
      return "median > " + call + " > wide(256)";
    case StageKind::layout:
      return (stage.cells ? "octree > " : "median > ") + call;
    case StageKind::trace:
      return "median > binary > " + call;
    case StageKind::peer:
      return call;
  }
  return "";
}

TEST(Recipe, CanonicalTextParsesBackToItself) {
  for (const char* text : {"median > binary", "sweep(k=4, axis=longest)>wide(4)", "binned( bins = 10 )  > wide(8)",
                           "middle > binary > trace(order=axis, mode=recursive)", "fast", "default", "best"}) {
    const Recipe recipe = Recipe::parse(text);
    EXPECT_EQ(Recipe::parse(recipe.text()).text(), recipe.text()) << text;
  }
}

TEST(Recipe, EveryRegisteredStageRoundTrips) {
  for (const Stage& stage : stages()) {
    const Recipe recipe = Recipe::parse(recipe_with(stage, stage.name));
    EXPECT_EQ(Recipe::parse(recipe.text()), recipe) << stage.name;
  }
}

TEST(Recipe, EveryOptionOfEveryStageTakesItsDefaultBack) {
  for (const Stage& stage : stages()) {
    for (const Option& option : stage.options) {
      std::any options = stage.defaults;
      const std::string value = option.get(options);
      EXPECT_NO_THROW(option.set(options, value)) << stage.name << " " << option.name << "=" << value;
      EXPECT_EQ(option.get(options), value);
    }
  }
}

TEST(Recipe, EveryStageHasASummaryASourceAndHelpForEachOption) {
  for (const Stage& stage : stages()) {
    EXPECT_FALSE(stage.summary.empty()) << stage.name;
    EXPECT_FALSE(stage.source.empty()) << stage.name;
    for (const Option& option : stage.options) EXPECT_FALSE(option.help.empty()) << stage.name << " " << option.name;
  }
}

TEST(Recipe, StageNamesAreUniqueAtTheBeginningAndAfterIt) {
  const auto begins = [](const Stage& stage) {
    return stage.kind == StageKind::builder || stage.kind == StageKind::peer;
  };
  for (const Stage& a : stages()) {
    for (const Stage& b : stages()) EXPECT_TRUE(&a == &b || a.name != b.name || begins(a) != begins(b)) << a.name;
  }
}

TEST(Recipe, NameOfBuilderAndLayoutMeansTheBuilderFirst) {
  const Recipe recipe = Recipe::parse("octree(primitives=5) > octree(mailbox=off)");
  EXPECT_EQ(recipe.stages()[0].stage->kind, StageKind::builder);
  EXPECT_EQ(recipe.stages()[1].stage->kind, StageKind::layout);
  EXPECT_EQ(recipe.text(), "octree(primitives=5) > octree(mailbox=off)");
}

TEST(Recipe, LayoutOfCellsNeedsABuilderThatTellsThem) {
  EXPECT_NE(usage_error("binned > bit-octree").find("must follow 'octree' directly"), std::string::npos);
  EXPECT_NE(usage_error("octree > reinsert > octree").find("'reinsert' does not tell any"), std::string::npos);
  EXPECT_EQ(usage_error("octree > bit-octree"), "");
}

TEST(Recipe, OptionsAtTheirDefaultAreLeftOut) {
  EXPECT_EQ(Recipe::parse("median(k=2) > binary > trace(order=near)").text(), "median > binary");
}

TEST(Recipe, BinaryTreeForAWideLayoutIsCollapsedVisibly) {
  EXPECT_EQ(Recipe::parse("binned > wide(8)").text(), "binned > collapse(8) > wide(8)");
  EXPECT_EQ(Recipe::parse("median(k=4) > wide(8)").text(), "median(k=4) > wide(8)");
}

TEST(Recipe, TreeTooWideForItsLayoutIsRefused) {
  EXPECT_NE(usage_error("median(k=4) > binary").find("at most 2 children"), std::string::npos);
}

TEST(Recipe, UnknownNamesAreAnsweredWithTheNearestAndTheList) {
  const std::string stage = usage_error("medain > binary");
  EXPECT_NE(stage.find("did you mean 'median'?"), std::string::npos) << stage;
  EXPECT_NE(stage.find("sweep"), std::string::npos);
  const std::string option = usage_error("median(kk=4) > binary");
  EXPECT_NE(option.find("did you mean 'k'?"), std::string::npos) << option;
}

TEST(Recipe, PresetInALongerRecipeIsAnsweredWithItsStages) {
  for (const std::string text : {"fast > wide(8)", "median > fast"}) {
    const std::string message = usage_error(text);
    EXPECT_NE(message.find(Recipe::parse("fast").text()), std::string::npos) << message;
  }
}

class BadRecipe : public testing::TestWithParam<const char*> {};

TEST_P(BadRecipe, IsAUsageErrorOfOneSentence) {
  const std::string message = usage_error(GetParam());
  EXPECT_FALSE(message.empty());
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Each, BadRecipe,
                         testing::Values("", ">", "median >", "> binary", "median", "binary", "binary > median",
                                         "median > median > binary", "median > binary > wide(4)", "median(k) > binary",
                                         "median(k=) > binary", "median(k=x) > binary", "median(k=-1) > binary",
                                         "median(k=99999999999) > binary", "median(k=2 > binary",
                                         "median k=2) > binary", "median((k=2)) > binary", "median > trace > binary",
                                         "trace", "median > binary > trace > trace", "median > binary > collapse(4)",
                                         "median(axis=w) > binary", "nothing", "median > binary > fast"));

TEST(Suggest, NamesTheNearestByEditDistance) {
  const std::vector<std::string> names{"sweep", "binned", "median"};
  EXPECT_NE(suggest("bined", names).find("'binned'"), std::string::npos);
  EXPECT_NE(suggest("sweeep", names).find("'sweep'"), std::string::npos);
}

TEST(Recipe, LineBreaksAreBlanksAndOtherControlCharactersAreRefused) {
  EXPECT_EQ(Recipe::parse("median\n>\tbinary\r\n"), Recipe::parse("median > binary"));
  for (const char* text : {"l\nevau", "median > \x1b[31mbinary", "med\x7fian > binary"}) {
    const std::string message = usage_error(text);
    EXPECT_FALSE(message.empty());
    for (const char c : message) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << message;
  }
}

TEST(Recipe, PresetsAreValidRecipes) {
  for (const Preset& preset : presets()) {
    for (const std::string& text : {preset.name, preset.text, preset.text_avx512}) {
      if (text.empty()) continue;
      EXPECT_NO_THROW(Recipe::parse(text)) << preset.name;
    }
  }
  EXPECT_FALSE(first_of(StageKind::builder).empty());
}

}  // namespace
}  // namespace boxwood
