// Metrics of trees: by hand, by sampling points, and against one another.
#include <gtest/gtest.h>

#include <cmath>

#include "boxwood/error.h"
#include "boxwood/scene.h"
#include "heuristics/known.h"
#include "measure/correlation.h"
#include "support/scenes.h"
#include "support/trees.h"
#include "tree/end_point_overlap.h"
#include "tree/ray_cost.h"
#include "tree/reference_slots.h"

namespace boxwood::test {
namespace {

CornersOf corners_of(const Mesh& mesh) {
  return [&mesh](std::uint32_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    return std::array{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  };
}

Tree tree_of(const Scene& scene, std::uint32_t k = 2, std::uint32_t leaf_size = 2) {
  return split_tree(triangle_boxes(scene.meshes[0]), {k, leaf_size, false});
}

TEST(Epo, OneLeaf_Zero) {
  const Scene scene = soup(5, 0.5f, 1);
  EXPECT_EQ(end_point_overlap(tree_of(scene, 2, 5), corners_of(scene.meshes[0])).epo, 0);
}

TEST(Epo, TwoTrianglesApart_Zero) {
  const Scene scene =
      scene_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(end_point_overlap(tree_of(scene, 2, 1), corners_of(scene.meshes[0])).epo, 0);
}

TEST(Epo, CrossingTriangles_ByHand) {
  // A lies in z = 0 and fills the lower half of the unit square; B stands on x = 1/4 over y in [0, 1], |z| <= 1/2. Of
  // A, nothing but a segment lies in B's flat box; of B, a segment in A's. Tilting B gives its box room for part of A.
  const Scene scene = scene_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25f, 0, -0.5f}, {0.5f, 0, 0.5f}, {0.25f, 1, -0.5f}},
                               {{0, 1, 2}, {3, 4, 5}});
  const Tree tree = tree_of(scene, 2, 1);
  // A in B's box: x in [1/4, 1/2] under y = 1 - x: (3/4 + 1/2) / 2 / 4.
  const double a_in_b = (0.75 + 0.5) / 2 / 4;
  const double a = 0.5, b = std::sqrt(1 + 0.25 * 0.25) * 1 / 2;
  const EndPointOverlap overlap = end_point_overlap(tree, corners_of(scene.meshes[0]), 0, {7, 3});
  // B meets A's flat box in a segment. Both are leaves of one triangle, and the root owns all.
  EXPECT_NEAR(overlap.epo, 3 * a_in_b / (a + b), 1e-6);
  EXPECT_EQ(overlap.inner_area, 0);
}

TEST(Epo, PointsOnTriangles_TellTheSame) {
  const Scene scene = soup(120, 0.5f, 2);
  const Mesh& mesh = scene.meshes[0];
  const SahConstants constants{1.5, 1};
  for (const std::uint32_t k : {2u, 4u}) {
    const Tree tree = tree_of(scene, k);
    const ReferenceSlots slots(tree);
    double total = 0;
    std::vector<double> up_to;
    const CornersOf corners = corners_of(mesh);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto [a, b, c] = corners(i);
      up_to.push_back(total += double{length(cross(b - a, c - a))} / 2);
    }
    double sum = 0, squared = 0;
    constexpr int points = 40000;
    Random random(3);
    for (int p = 0; p < points; ++p) {
      const double at = double{random.uniform()} * total;
      const auto i = static_cast<std::uint32_t>(std::ranges::upper_bound(up_to, at) - up_to.begin());
      const auto [a, b, c] = corners(i);
      const float root = std::sqrt(random.uniform()), v = random.uniform();
      const Vec3 point = a * (1 - root) + b * (root * (1 - v)) + c * (root * v);
      double weight = 0;
      for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
        const Tree::Node& node = tree.nodes[n];
        if (!node.bounds.contains({point, point}) || slots.owns(n, i)) continue;
        weight += node.is_leaf() ? constants.intersection * node.count : constants.traversal;
      }
      sum += weight, squared += weight * weight;
    }
    const double mean = sum / points, error = std::sqrt((squared / points - mean * mean) / points);
    EXPECT_NEAR(end_point_overlap(tree, corners, 0, constants).epo, mean, 4 * error) << k;
  }
}

TEST(Epo, Sampled_WithinItsError) {
  const Scene scene = soup(3000, 0.2f, 4);
  const Tree tree = tree_of(scene);
  const CornersOf corners = corners_of(scene.meshes[0]);
  const EndPointOverlap exact = end_point_overlap(tree, corners), sampled = end_point_overlap(tree, corners, 700);
  EXPECT_GT(sampled.standard_error, 0);
  EXPECT_NEAR(sampled.epo, exact.epo, 4 * sampled.standard_error);
  EXPECT_LT(sampled.standard_error, 0.1 * exact.epo);
  EXPECT_NEAR(sampled.inner_area, exact.inner_area, 0.2 * exact.inner_area);
  EXPECT_EQ(exact.standard_error, 0);
}

TEST(Epo, NothingToJudge_Zero) {
  for (const Scene& scene : {scene_of({}, {}), scene_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}})}) {
    EXPECT_EQ(end_point_overlap(tree_of(scene), corners_of(scene.meshes[0])).epo, 0);
  }
}

TEST(RayCost, UniformLines_CostWhatTheSurfaceAreaModelSays) {
  const Scene scene = soup(200, 0.3f, 5);
  const Tree tree = tree_of(scene);
  const SahConstants constants{1.2, 1};
  const std::vector<Segment> lines = uniform_lines(tree.nodes[0].bounds, 200000);
  std::vector<Segment> entering;
  for (const Segment& line : lines) {
    if (line.meets(tree.nodes[0].bounds)) entering.push_back(line);
  }
  const double expected = sah_cost(tree, constants);
  EXPECT_NEAR(ray_cost(tree, entering, constants).cost, expected, 0.01 * expected);
}

TEST(RayCost, HalfOfTheRaysMeetOneLeaf_HalfThree) {
  Tree tree;
  tree.references = {0, 1, 2};
  Tree::Node root;
  root.bounds = {{0, 0, 0}, {3, 2, 1}};
  root.first = 1, root.count = 3;
  tree.nodes.push_back(root);
  for (std::uint32_t i = 0; i < 3; ++i) {
    Tree::Node leaf;
    const auto x = static_cast<float>(i);
    leaf.bounds = {{x, 0, 0}, {x + 0.5f, i == 0 ? 2.0f : 1.0f, 1}};
    leaf.first = i, leaf.count = 1, leaf.leaf = 1;
    tree.nodes.push_back(leaf);
  }
  Ray low, high, short_one;
  low.origin = {-1, 0.5f, 0.5f}, low.direction = {1, 0, 0};
  high = low, high.origin.y = 1.5f;
  const std::vector<Segment> rays = {{low, 100}, {high, 100}};
  const RayCost cost = ray_cost(tree, rays, {2, 1});
  EXPECT_EQ(cost.lcv, 1);
  EXPECT_EQ(cost.leaves, 2);
  EXPECT_EQ(cost.inner_nodes, 1);
  EXPECT_EQ(cost.cost, 2 + 2);
  const std::vector<Segment> ended = {{low, 1.2f}};  // within the first leaf
  EXPECT_EQ(ray_cost(tree, ended).leaves, 1);
  EXPECT_EQ(ray_cost(tree, ended).lcv, 0);
}

TEST(Correlation, KnownPairs) {
  const std::vector<double> x = {1, 2, 3, 4}, up = {2, 4, 6, 8}, down = {3, 2, 1, 0}, curved = {1, 10, 100, 1000};
  EXPECT_NEAR(pearson(x, up), 1, 1e-12);
  EXPECT_NEAR(pearson(x, down), -1, 1e-12);
  EXPECT_LT(pearson(x, curved), 0.9);
  EXPECT_NEAR(spearman(x, curved), 1, 1e-12);
  EXPECT_EQ(pearson(x, std::vector<double>(4, 7)), 0);
  // By hand: ranks of y are 0.5 0.5 2 3.
  EXPECT_NEAR(spearman(x, std::vector<double>{5, 5, 6, 7}), 4.5 / std::sqrt(5 * 4.5), 1e-12);
  EXPECT_THROW(pearson(x, std::vector<double>{1}), UsageError);
}

TEST(Correlation, TimeMadeOfABlend_FindsItsWeights) {
  Random random(6);
  std::vector<double> sah, epo, lcv, time;
  for (int i = 0; i < 20; ++i) {
    sah.push_back(50 + 20 * double{random.uniform()});
    epo.push_back(20 * double{random.uniform()});
    lcv.push_back(5 * double{random.uniform()});
    time.push_back(3 * (0.2 * sah.back() + 0.71 * epo.back() + 0.09 * lcv.back()) + 10);
  }
  const FittedBlend fitted = fit_blend(sah, epo, lcv, time);
  EXPECT_NEAR(fitted.blend.alpha, 0.71, 1e-9);
  EXPECT_NEAR(fitted.blend.beta, 0.09, 1e-9);
  EXPECT_NEAR(fitted.correlation, 1, 1e-9);
  EXPECT_EQ(fit_blend(sah, epo, {}, sah).blend.alpha, 0);
}

}  // namespace
}  // namespace boxwood::test
