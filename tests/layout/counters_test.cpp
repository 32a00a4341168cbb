// Counters mean what they say.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

using Walks = std::vector<RayCounters>;

std::vector<Ray> plain_rays(const Scene& scene, std::uint32_t count) {
  Random random(17);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 origin = test::point_around(scene.bounds(), random, 2);
    rays.push_back({origin, 0, test::point_around(scene.bounds(), random, 0.5f) - origin});
  }
  return rays;
}

Walks count(const Layout& layout, std::span<const Ray> rays) {
  std::vector<Hit> hits(rays.size());
  Walks counters(rays.size());
  layout.closest_hits_counted(rays, hits, counters);
  return counters;
}

Walks count_any(const Layout& layout, std::span<const Ray> rays) {
  std::vector<std::uint8_t> blocked(rays.size());
  Walks counters(rays.size());
  layout.any_hits_counted(rays, blocked, counters);
  return counters;
}

/// The walk of spec 000, section 2.11, over the tree itself, in double: every box whose parent was met is tested
/// against the whole line, and nothing is ever skipped. Boxes are widened by `slack`.
struct ReferenceWalk {
  const Tree& tree;
  const Ray& ray;
  double slack;
  RayCounters counters;

  bool meets(const Box& box) const {
    double entry = -std::numeric_limits<double>::infinity(), exit = -entry;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double inverse = 1 / static_cast<double>(ray.direction[axis]), origin = ray.origin[axis];
      const double a = (static_cast<double>(box.lower[axis]) - slack - origin) * inverse;
      const double b = (static_cast<double>(box.upper[axis]) + slack - origin) * inverse;
      entry = std::max(entry, std::min(a, b));
      exit = std::min(exit, std::max(a, b));
    }
    return entry <= exit;
  }

  void visit(std::uint32_t index) {
    const Tree::Node& node = tree.nodes[index];
    ++counters.node_tests;
    if (!meets(node.bounds)) return;
    ++counters.node_hits;
    if (node.is_leaf()) {
      ++counters.leaves;
      counters.primitive_tests += node.count;
      return;
    }
    ++counters.steps;
    for (std::uint32_t c = 0; c < node.count; ++c) visit(node.first + c);
  }
};

bool at_most(const RayCounters& a, const RayCounters& b) {
  return a.steps <= b.steps && a.leaves <= b.leaves && a.node_tests <= b.node_tests && a.node_hits <= b.node_hits &&
         a.primitive_tests <= b.primitive_tests;
}

TEST(Counters, WithoutOrderAndCullingAreThoseOfTheStudy) {
  const Scene scene = test::soup(300, 0.2f, 7);
  const std::vector<Ray> rays = plain_rays(scene, 300);
  for (const char* k : {"2", "4", "16", "256"}) {
    test::LayoutCall call(wide_stage());
    call.set("k", k);
    const auto layout = test::encode_scene(scene, call, {ChildOrder::none, false, TraversalMode::iterative});
    const Tree tree =
        test::split_tree(test::triangle_boxes(scene.meshes[0]), {call.stage.arity(call.options), 2, true});
    const Walks counted = count(*layout, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ReferenceWalk narrow{tree, rays[i], 0, {}}, wide{tree, rays[i], 1e-4, {}};
      narrow.visit(0);
      wide.visit(0);
      EXPECT_TRUE(at_most(narrow.counters, counted[i]) && at_most(counted[i], wide.counters)) << k << ", ray " << i;
    }
  }
}

TEST(Counters, DoNotDependOnLayoutOrModeOverTheSameTree) {
  const Scene scene = test::soup(300, 0.2f, 7);
  const std::vector<Ray> rays = plain_rays(scene, 300);
  test::LayoutCall wide(wide_stage());
  wide.set("k", "2");
  for (const ChildOrder order : {ChildOrder::none, ChildOrder::axis, ChildOrder::near}) {
    for (const bool cull : {false, true}) {
      const TraceOptions iterative{order, cull, TraversalMode::iterative};
      const TraceOptions recursive{order, cull, TraversalMode::recursive};
      const auto first = test::encode_scene(scene, test::LayoutCall(binary_stage()), iterative);
      for (const auto& other : {test::encode_scene(scene, test::LayoutCall(binary_stage()), recursive),
                                test::encode_scene(scene, wide, iterative)}) {
        EXPECT_EQ(count(*other, rays), count(*first, rays));
        EXPECT_EQ(count_any(*other, rays), count_any(*first, rays));
      }
    }
  }
}

TEST(Counters, OrderAndCullingSaveWork) {
  const Scene scene = test::soup(2000, 0.2f, 7);
  const std::vector<Ray> rays = plain_rays(scene, 300);
  const auto tests = [&](ChildOrder order, bool cull) {
    const auto layout = test::encode_scene(scene, test::LayoutCall(wide_stage()), {order, cull, {}}, 2, false);
    std::uint64_t sum = 0;
    for (const RayCounters& c : count(*layout, rays)) sum += c.node_tests + c.primitive_tests;
    return sum;
  };
  const std::uint64_t nothing = tests(ChildOrder::none, false), cull = tests(ChildOrder::none, true);
  EXPECT_EQ(tests(ChildOrder::near, false), nothing);
  EXPECT_LT(cull, nothing);
  EXPECT_LT(tests(ChildOrder::axis, true), cull);
  EXPECT_LT(tests(ChildOrder::near, true), cull);
}

TEST(Counters, OfOneTriangleAreOneOfEach) {
  const auto layout = test::encode_scene(test::coincident(1), test::LayoutCall(wide_stage()), {.simd = false});
  const std::vector<Ray> rays = {{{0.3f, 0.4f, -2}, 0, {0, 0, 1}}, {{9, 9, 9}, 0, {0, 0, 1}}};
  const Walks counted = count(*layout, rays);
  EXPECT_EQ(counted[0], (RayCounters{.steps = 0, .leaves = 1, .node_tests = 1, .node_hits = 1, .primitive_tests = 1}));
  EXPECT_EQ(counted[1], (RayCounters{.steps = 0, .leaves = 0, .node_tests = 1, .node_hits = 0, .primitive_tests = 0}));
}

TEST(Counters, IncludeWhatInstancesCost) {
  Scene scene = test::coincident(1);
  const std::vector<Ray> rays = {{{0.3f, 0.4f, -2}, 0, {0, 0, 1}}};
  scene.instances.push_back({0, Transform::translate({100, 0, 0})});
  const auto layout = test::encode_scene(scene, test::LayoutCall(binary_stage()), {});
  const RayCounters expected{.steps = 1, .leaves = 2, .node_tests = 4, .node_hits = 3, .primitive_tests = 1};
  EXPECT_EQ(count(*layout, rays)[0], expected);
  EXPECT_EQ(count_any(*layout, rays)[0], expected);
}

}  // namespace
}  // namespace boxwood
