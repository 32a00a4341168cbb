#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cost/registry.h"
#include "inputs.h"

namespace boxwood {
namespace {

const Box scene{{0, 0, 0}, {4, 2, 1}};

float probability(const CostModel& model, const Box& parent, const Box& child) {
  const Side side{child, 1, 1};
  float out = -1;
  const auto memory = model.enter(parent, nullptr);
  model.probabilities({parent, 3, 1, memory.get()}, {&side, 1}, {&out, 1});
  return out;
}

/// By default with something known of the rays to come.
std::unique_ptr<CostModel> model_of(const std::string& choice, const Box& of = scene) {
  static const KnownUse use = use_of(std::vector<Box>(10, scene));
  return CostChoice::parse(choice).make({of, &use});
}

TEST(CostModels, All_ProbabilitiesThatGrowWithTheBox) {
  for (const CostModelEntry& entry : cost_models()) {
    const auto model = model_of(entry.name);
    for (const Box& part : random_boxes(200, 1)) {
      const Box child = intersect(part, scene), parent = unite(child, {{0, 0, 0}, {1, 1, 1}});
      const Box half{child.lower, child.center()};
      const float p = probability(*model, parent, child);
      EXPECT_GE(p, 0) << entry.name;
      EXPECT_LE(p, 1) << entry.name;
      EXPECT_LE(probability(*model, parent, half), p) << entry.name;
      EXPECT_EQ(probability(*model, child, child), 1) << entry.name;
    }
  }
}

TEST(CostModels, ParentWithoutMeasure_One) {
  const Box point{{1, 1, 1}, {1, 1, 1}};
  for (const CostModelEntry& entry : cost_models()) {
    EXPECT_EQ(probability(*model_of(entry.name), point, point), 1) << entry.name;
  }
}

TEST(CostModels, FlatOrEmptyScene_StillProbabilities) {
  for (const CostModelEntry& entry : cost_models()) {
    const Box flat{{0, 0, 5}, {4, 2, 5}}, part{{1, 1, 5}, {2, 2, 5}};
    const float p = probability(*model_of(entry.name, flat), flat, part);
    EXPECT_GT(p, 0) << entry.name;
    EXPECT_LT(p, 1) << entry.name;
    EXPECT_NO_THROW(model_of(entry.name, Box{})) << entry.name;
  }
}

/// Share of rays from random points of the scene in random directions that meet the box.
double measured(const Box& box) {
  Random random(7);
  const int rays = 200000;
  int met = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 origin = scene.lower + random_point(random) * scene.extent();
    const float z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi_v<float>);
    const float r = std::sqrt(1 - z * z);
    const Vec3 direction{r * std::cos(angle), r * std::sin(angle), z};
    float enter = 0, leave = 1e9f;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float a = (box.lower[axis] - origin[axis]) / direction[axis];
      const float b = (box.upper[axis] - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter <= leave) ++met;
  }
  return met / static_cast<double>(rays);
}

TEST(CostModels, InteriorHq_CloseToTracedRays) {
  const auto model = model_of("interior-hq");
  for (const Box& box : {Box{{1.5f, 0.5f, 0.3f}, {2.5f, 1.5f, 0.7f}}, Box{{0, 0, 0}, {1, 1, 1}}}) {
    EXPECT_NEAR(probability(*model, scene, box), measured(box), 0.25 * measured(box));
  }
}

}  // namespace
}  // namespace boxwood
