// Which child any-hit rays visit first: never another answer, and by the rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boxwood/boxwood.h"
#include "build/hit_lists.h"
#include "heuristics/known.h"
#include "refine/order/stages.h"
#include "structure/mesh_geometry.h"
#include "structure/object_use.h"
#include "structure/pipeline.h"
#include "support/scenes.h"
#include "support/trees.h"
#include "tree/validate.h"

namespace boxwood::test {
namespace {

/// Any-hit rays through the scene.
ExpectedUse shadow_rays_in(const Scene& scene) {
  ExpectedUse use;
  ExpectedRays rays = scattered_rays(3000, scene.bounds(), 1);
  rays.kind = "shadow";
  rays.query = Query::any_hit;
  for (Ray& ray : rays.rays) ray.t_far = 0.7f;
  use.rays.push_back(std::move(rays));
  return use;
}

std::uint64_t primitive_tests(const Structure& structure, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> blocked(rays.size());
  std::vector<RayCounters> counters(rays.size());
  structure.any_hits_counted(rays, blocked, counters);
  std::uint64_t tests = 0;
  for (const RayCounters& counter : counters) tests += counter.primitive_tests;
  return tests;
}

class Order : public testing::TestWithParam<std::string> {};

TEST_P(Order, AnyScene_SameAnswers) {
  for (const Scene& scene : {soup(500, 0.2f, 2), instances(), sphere(8)}) {
    const ExpectedUse use = shadow_rays_in(scene);
    const std::vector<Ray>& rays = use.rays[0].rays;
    const Structure plain = build(scene, "binned > binary");
    for (const std::string layout : {"binary", "wide(4)"}) {
      const Structure ordered = build(scene, "binned > " + GetParam() + " > " + layout, {.use = &use});
      std::vector<std::uint8_t> a(rays.size()), b(rays.size());
      plain.any_hits(rays, a);
      ordered.any_hits(rays, b);
      EXPECT_EQ(a, b) << layout;
      std::vector<Hit> hits(rays.size()), expected(rays.size());
      plain.closest_hits(rays, expected);
      ordered.closest_hits(rays, hits);
      EXPECT_EQ(hits, expected) << layout;
    }
  }
}

TEST_P(Order, AnyTree_StaysValid) {
  const Scene scene = soup(500, 0.2f, 3);
  const ExpectedUse use = shadow_rays_in(scene);
  const KnownUse known = use_of_mesh(use, scene, 0, {});
  const Tree tree = tree_of(scene.meshes[0], Recipe::parse("binned > " + GetParam() + " > binary"), &known);
  EXPECT_EQ(validate(tree, triangle_boxes(scene.meshes[0])), "");
}

INSTANTIATE_TEST_SUITE_P(Rules, Order,
                         testing::Values("order", "order(lines=64)", "order(by=sato)", "order(by=sato-max)",
                                         "order(by=srdh)", "order(by=srdh) > order(by=sato)"),
                         [](const auto& parameters) { return "Rule" + std::to_string(parameters.index); });

TEST(OrderBySrdh, RepresentativeRays_TestNoMoreThanFromNearToFar) {
  const Scene scene = soup(2000, 0.15f, 4);
  const ExpectedUse use = shadow_rays_in(scene);
  const auto tests = [&](const std::string& recipe) {
    return primitive_tests(build(scene, recipe, {.use = &use}), use.rays[0].rays);
  };
  EXPECT_LT(tests("binned > order(by=srdh) > binary"), tests("binned > binary"));
}

TEST(OrderBySato, LargerTriangles_First) {
  const Scene scene =
      scene_of({{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, {5, 0, 0}, {9, 0, 0}, {5, 4, 0}}, {{0, 1, 2}, {3, 4, 5}});
  for (const std::string rule : {"sato", "sato-max"}) {
    const Tree tree = tree_of(scene.meshes[0], Recipe::parse("sweep(leaf=1) > order(by=" + rule + ") > binary"));
    ASSERT_EQ(tree.nodes.size(), 3u);
    EXPECT_EQ(tree.references[tree.nodes[1].first], 1u);
    EXPECT_TRUE(tree.nodes[0].fixed_order);
    EXPECT_EQ(tree.nodes[0].axis, Tree::mixed_axis);
  }
}

TEST(OrderByRtsah, LikelyAndCheapChild_First) {
  // One large triangle beside many small ones: it ends most rays for one test.
  std::vector<Vec3> positions = {{0, 0, 0}, {4, 0, 0.1f}, {0, 4, 0}};
  std::vector<Triangle> triangles = {{0, 1, 2}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto x = static_cast<float>(i);
    positions.insert(positions.end(), {{6 + x * 0.1f, 0, 0}, {6.1f + x * 0.1f, 0, 0}, {6 + x * 0.1f, 0.1f, 0.1f}});
    triangles.push_back({3 + 3 * i, 4 + 3 * i, 5 + 3 * i});
  }
  const Scene scene = scene_of(positions, triangles);
  const Tree tree = tree_of(scene.meshes[0], Recipe::parse("sweep(leaf=1) > order > binary"));
  const Tree::Node& first = tree.nodes[tree.nodes[0].first];
  ASSERT_TRUE(first.is_leaf());
  EXPECT_EQ(tree.references[first.first], 0u);
}

TEST(Order, WideTree_MadeBinaryFirst) {
  const Scene scene = soup(100, 0.2f, 5);
  const Tree tree = tree_of(scene.meshes[0], Recipe::parse("median(k=4) > order > binary"));
  for (const Tree::Node& node : tree.nodes) {
    EXPECT_TRUE(node.is_leaf() || node.count == 2);
  }
}

/// References leaf by leaf, in the order of the children from the root on.
void visit(const Tree& tree, std::uint32_t number, std::vector<std::uint32_t>& references) {
  const Tree::Node& node = tree.nodes[number];
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    node.is_leaf() ? references.push_back(tree.references[i]) : visit(tree, i, references);
  }
}

TEST(Order, CollapsedAfterwards_KeptWithItsMark) {
  const Scene scene = soup(200, 0.2f, 6);
  const auto visited = [&](const std::string& recipe) {
    const Tree tree = tree_of(scene.meshes[0], Recipe::parse(recipe));
    for (const Tree::Node& node : tree.nodes) EXPECT_TRUE(node.is_leaf() || node.fixed_order) << recipe;
    std::vector<std::uint32_t> references;
    visit(tree, 0, references);
    return references;
  };
  EXPECT_EQ(visited("sweep > order > collapse(4) > wide(4)"), visited("sweep > order > binary"));
}

TEST(SrdhBuilder, RepresentativeRays_FewerTestsThanSurfaceArea) {
  const Scene scene = soup(2000, 0.15f, 7);
  const ExpectedUse use = shadow_rays_in(scene);
  const auto tests = [&](const std::string& recipe) {
    return primitive_tests(build(scene, recipe, {.use = &use}), use.rays[0].rays);
  };
  EXPECT_LT(tests("srdh(leaf=1) > binary"), tests("binned(leaf=1) > binary"));
}

TEST(SrdhBuilder, NoRays_AsValidAsAny) {
  const Scene scene = soup(500, 0.2f, 8);
  const ExpectedUse use;
  const KnownUse known = use_of_mesh(use, scene, 0, {});
  const Tree tree = tree_of(scene.meshes[0], Recipe::parse("srdh > binary"), &known);
  EXPECT_EQ(validate(tree, triangle_boxes(scene.meshes[0])), "");
  for (const Tree::Node& node : tree.nodes) EXPECT_FALSE(node.fixed_order);
}

TEST(SegmentHits, AnyRay_HasEveryPrimitiveItHits) {
  const Scene scene = soup(300, 0.4f, 6);
  const ExpectedUse use = shadow_rays_in(scene);
  const MeshGeometry geometry(scene.meshes[0]);
  const KnownUse known = use_of_mesh(use, scene, 0, {});
  const Tree tree = tree_of(scene.meshes[0], Recipe::parse("binned > binary"));
  const SegmentHits lists = hit_lists(tree, geometry, known);
  const Structure structure = build(scene, "binned > binary");
  std::size_t differing = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    // The chain of closest hits, one after the other, visits them all.
    std::vector<std::uint32_t> found;
    Ray ray = use.rays[0].rays[i];
    for (Hit hit = structure.closest_hit(ray); hit.valid(); hit = structure.closest_hit(ray)) {
      found.push_back(hit.primitive);
      ray.t_near = std::nextafter(hit.t, 1e9f);
      if (ray.t_near > ray.t_far) break;
    }
    std::ranges::sort(found);
    differing += !std::ranges::equal(found, lists.of(i));
  }
  EXPECT_LE(differing, 3u) << "grazing hits may differ in the last bit";
}

}  // namespace
}  // namespace boxwood::test
