// Any builder, any refinement, any layout, any walk: the same hits as brute force, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "boxwood/expected_use.h"
#include "boxwood/structure.h"
#include "recipe/stage.h"
#include "support/differential.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

bool has_option(const Stage& stage, const std::string& name) {
  return std::ranges::any_of(stage.options, [&](const Option& option) { return option.name == name; });
}

std::vector<std::string> calls_of(StageKind kind) {
  std::vector<std::string> out;
  for (const Stage& stage : stages()) {
    if (stage.kind != kind) continue;
    if (kind == StageKind::refinement && has_option(stage, "k")) {
      out.push_back(stage.name + "(k=16)");  // never narrower than what any of these builders makes
      continue;
    }
    out.push_back(stage.name);
    if (kind == StageKind::builder && has_option(stage, "k")) {
      for (const char* k : {"4", "16"}) out.push_back(stage.name + "(k=" + k + ")");
    }
    if (kind == StageKind::layout && has_option(stage, "k")) {
      for (const char* k : {"4", "16"}) out.push_back(stage.name + "(" + k + ")");
    }
  }
  return out;
}

/// Every builder with every layout it fits, by way of no refinement and of every one.
std::vector<std::string> recipes_of(const std::string& builder) {
  std::vector<std::string> refinements = calls_of(StageKind::refinement), out;
  for (std::string& refinement : refinements) refinement = " > " + refinement;
  refinements.push_back("");
  for (const std::string& refinement : refinements) {
    for (const std::string& layout : calls_of(StageKind::layout)) {
      const std::string recipe = builder + refinement + " > " + layout;
      try {
        Recipe::parse(recipe);
      } catch (const UsageError&) {
        continue;  // too wide for the layout
      }
      out.push_back(recipe);
    }
  }
  out.push_back("median(k=16) > wide(256)");
  return out;
}

/// What recipes that adapt to rays are told: these, whatever is wrong with them.
ExpectedUse use_of(const std::vector<Ray>& rays) {
  ExpectedUse use;
  use.rays.push_back({"shadow", Query::any_hit, rays, {}});
  for (const Ray& ray : rays) use.rays[0].ends.push_back(ray.t_far);
  return use;
}

struct Case {
  test::NamedScene named;
  test::Expected expected;
  ExpectedUse use;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> out;
    for (test::NamedScene& named : test::troubled_scenes()) {
      const std::vector<Ray> rays = test::troubling_rays(named.scene, 120, 50 + out.size());
      test::Expected expected(named.scene, rays);
      out.push_back({std::move(named), std::move(expected), use_of(rays)});
    }
    return out;
  }();
  return all;
}

void expect_brute_force(const std::string& recipe) {
  for (const Case& c : cases()) {
    test::expect_brute_force_answers(build(c.named.scene, recipe, {.use = &c.use}), c.expected,
                                     recipe + " over " + c.named.name);
  }
}

class EveryBuilder : public testing::TestWithParam<std::string> {};

TEST_P(EveryBuilder, GivesTheAnswersOfBruteForceInEveryLayout) {
  for (const std::string& recipe : recipes_of(GetParam())) expect_brute_force(recipe);
}

TEST_P(EveryBuilder, GivesThemHoweverTheTreeIsWalked) {
  for (const char* layout : {" > binary", " > wide(4)"}) {
    const std::string recipe = GetParam() + layout;
    try {
      Recipe::parse(recipe);
    } catch (const UsageError&) {
      continue;
    }
    for (const char* trace : {"order=none", "order=axis", "order=near", "order=none, cull=off, mode=recursive",
                              "order=axis, mode=recursive", "cull=off", "simd=off"}) {
      expect_brute_force(recipe + " > trace(" + trace + ")");
    }
  }
}

TEST_P(EveryBuilder, GivesTheSameWalksForAnyNumberOfThreads) {
  const Scene scene = test::soup(3000, 0.1f, 31);
  const std::vector<Ray> rays = test::troubling_rays(scene, 200, 5);
  const ExpectedUse use = use_of(rays);
  const auto walks = [&](unsigned threads) {
    std::vector<Hit> hits(rays.size());
    std::vector<RayCounters> counters(rays.size());
    build(scene, GetParam() + " > wide(16)", {threads, &use}).closest_hits_counted(rays, hits, counters);
    return counters;
  };
  EXPECT_EQ(walks(1), walks(4));
}

std::string name_of(const testing::TestParamInfo<std::string>& parameters) {
  std::string name;
  for (const char c : parameters.param) name += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : "";
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryBuilder, testing::ValuesIn(calls_of(StageKind::builder)), name_of);

TEST(EveryPreset, GivesTheAnswersOfBruteForce) {
  for (const Preset& preset : presets()) expect_brute_force(preset.name);
}

TEST(Structure, RefusesSpansOfDifferentLength) {
  const Structure structure = build(test::soup(10, 0.1f, 1), "median > binary");
  const std::vector<Ray> rays(3);
  std::vector<Hit> hits(2);
  std::vector<std::uint8_t> blocked(4);
  EXPECT_THROW(structure.closest_hits(rays, hits), UsageError);
  EXPECT_THROW(structure.any_hits(rays, blocked), UsageError);
}

}  // namespace
}  // namespace boxwood
