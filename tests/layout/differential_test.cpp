// Every layout, walked in every way, gives the answers of brute force to the bit.
#include "support/differential.h"

#include <gtest/gtest.h>

#include <tuple>

#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

std::vector<test::LayoutCall> layouts() {
  std::vector<test::LayoutCall> out;
  out.emplace_back(binary_stage());
  for (const char* k : {"2", "3", "4", "8", "16", "256"}) out.push_back(test::LayoutCall(wide_stage()).set("k", k));
  return out;
}

struct Case {
  test::NamedScene named;
  test::Expected expected;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> out;
    for (test::NamedScene& named : test::troubled_scenes()) {
      std::vector<Ray> rays = test::troubling_rays(named.scene, 600, out.size());
      test::Expected expected(named.scene, std::move(rays));
      out.push_back({std::move(named), std::move(expected)});
    }
    return out;
  }();
  return all;
}

using Parameters = std::tuple<std::size_t, ChildOrder, bool, TraversalMode>;

class EveryLayout : public testing::TestWithParam<Parameters> {};

TEST_P(EveryLayout, GivesTheAnswersOfBruteForce) {
  const auto& [number, order, cull, mode] = GetParam();
  const test::LayoutCall call = layouts()[number];
  for (const Case& c : cases()) {
    const auto layout = test::encode_scene(c.named.scene, call, {order, cull, mode});
    test::expect_brute_force_answers(*layout, c.expected, call.name() + " over " + c.named.name);
  }
}

std::string name_of(const testing::TestParamInfo<Parameters>& parameters) {
  const auto& [number, order, cull, mode] = parameters.param;
  const test::LayoutCall call = layouts()[number];
  constexpr const char* orders[] = {"None", "Axis", "Near"};
  return call.stage.name + std::to_string(call.stage.arity(call.options)) + orders[static_cast<int>(order)] +
         (cull ? "Cull" : "") + (mode == TraversalMode::recursive ? "Recursive" : "");
}

INSTANTIATE_TEST_SUITE_P(TraceOptions, EveryLayout,
                         testing::Combine(testing::Range(std::size_t{0}, layouts().size()),
                                          testing::Values(ChildOrder::none, ChildOrder::axis, ChildOrder::near),
                                          testing::Bool(),
                                          testing::Values(TraversalMode::iterative, TraversalMode::recursive)),
                         name_of);

TEST(TroublingRays, HitOftenEnoughToProveSomething) {
  for (const Case& c : cases()) {
    std::size_t hits = 0;
    for (const Hit& hit : c.expected.hits) hits += hit.valid() ? 1 : 0;
    if (c.named.name == "none") {
      EXPECT_EQ(hits, 0u);
    } else {
      EXPECT_GT(hits, 10u) << c.named.name;
    }
  }
}

}  // namespace
}  // namespace boxwood
