// Single splits against the rules of pbrt and of the PCA study, searched the slow way.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "cost/registry.h"
#include "stages.h"

namespace boxwood {
namespace {

using Primitives = std::vector<std::uint32_t>;

int longest_of_centroids(const std::vector<Box>& boxes, Box& centers) {
  for (const Box& box : boxes) centers.grow(box.lower + box.upper);
  return longest_axis(centers.extent());
}

/// The study's section 2.6, with unions made anew for every candidate.
Primitives cheapest_bucket_border(const std::vector<Box>& boxes, const std::string& model) {
  constexpr int buckets = 12;
  Box centers;
  const auto axis = static_cast<std::size_t>(longest_of_centroids(boxes, centers));
  const auto bucket = [&](const Box& box) {
    const float at = (box.lower + box.upper)[axis] - centers.lower[axis];
    return std::min(buckets - 1, static_cast<int>(buckets * at / centers.extent()[axis]));
  };
  Primitives best_left;
  float best_cost = std::numeric_limits<float>::infinity();
  for (int border = 0; border < buckets - 1; ++border) {
    Box left, right, whole;
    Primitives lefts;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      whole.grow(boxes[i]);
      (bucket(boxes[i]) <= border ? left : right).grow(boxes[i]);
      if (bucket(boxes[i]) <= border) lefts.push_back(i);
    }
    if (lefts.empty() || lefts.size() == boxes.size()) continue;
    const auto left_count = static_cast<float>(lefts.size());
    const float right_count = static_cast<float>(boxes.size()) - left_count;
    float cost = left_count * half_area(left) + right_count * half_area(right);
    const Vec3 e = intersect(left, right).extent();
    const bool overlap = e.x > 0 && e.y > 0 && e.z > 0;
    if (model == "overlap(disjoint=published)" || (model == "overlap" && overlap)) {
      cost += (left_count + right_count) * (e.x * e.y + e.y * e.z + e.z * e.x);
    }
    if (cost / half_area(whole) < best_cost) {
      best_cost = cost / half_area(whole);
      best_left = lefts;
    }
  }
  return best_left;
}

TEST(TwelveBuckets, CutWherePbrtCuts) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const float size : {0.01f, 0.4f}) {
      const std::vector<Box> boxes = random_boxes(60, size, seed);
      for (const std::string model : {"sah", "overlap", "overlap(disjoint=published)"}) {
        const Tree tree = build_study_tree(
            "binned(bins=12, axis=longest, pairs=on, exact=0, leaf=1, coincident=leaf, cost=" + model + ")", boxes);
        EXPECT_EQ(primitives_below(tree, tree.nodes[0].first), cheapest_bucket_border(boxes, model)) << model;
      }
    }
  }
}

/// What the model adds to either side's probability for what both share.
float shared(const std::string& model_text, const Box& parent, const Box& a, const Box& b) {
  const CostChoice choice = CostChoice::parse(model_text);
  const auto model = choice.make({parent, nullptr});
  const Side left{a, 1}, right{b, 1};
  const CostModel::Node node{parent, 2};
  float alone = -1, left_out = -1, right_out = -1;
  model->probabilities(node, {&left, 1}, {&alone, 1});
  model->pair_probabilities(node, {&left, 1}, {&right, 1}, {&left_out, 1}, {&right_out, 1});
  return left_out - alone;
}

TEST(OverlapCost, OfDisjointBoxes_IsTheStudysNumberOrNothing) {
  const std::string published = "overlap(disjoint=published)";
  const Box parent{{0, 0, 0}, {4, 1, 1}}, left{{0, 0, 0}, {1, 1, 1}}, right{{3, 0, 0}, {4, 1, 1}};
  const float area = half_area(parent);
  EXPECT_NEAR(shared(published, parent, left, right), (1 - 2 - 2) / area, 1e-6);  // a gap of 2: rewarded
  EXPECT_EQ(shared("overlap", parent, left, right), 0);
  const Box touching{{1, 0, 0}, {4, 1, 1}};
  EXPECT_NEAR(shared(published, parent, left, touching), 1 / area, 1e-6);  // a whole face, though nothing overlaps
  EXPECT_EQ(shared("overlap", parent, left, touching), 0);
  const Box overlapping{{0.5f, 0, 0}, {4, 1, 1}};
  EXPECT_NEAR(shared(published, parent, left, overlapping), 2 / area, 1e-6);
  EXPECT_NEAR(shared("overlap", parent, left, overlapping), 2 / area, 1e-6);
  EXPECT_NEAR(shared("overlap(weight=0.5)", parent, left, overlapping), 1 / area, 1e-6);
}

TEST(Distance, PartsByTheTwoFarthestOfSixExtremes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::vector<Box> boxes = random_boxes(100, 0.1f, seed);
    const auto center = [&](std::uint32_t i) { return boxes[i].lower + boxes[i].upper; };
    std::array<std::uint32_t, 6> extremes{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (center(i)[axis] < center(extremes[2 * axis])[axis]) extremes[2 * axis] = i;
        if (center(i)[axis] > center(extremes[2 * axis + 1])[axis]) extremes[2 * axis + 1] = i;
      }
    }
    const auto squared = [&](std::uint32_t i, std::uint32_t j) {
      return dot(center(i) - center(j), center(i) - center(j));
    };
    std::uint32_t first = 0, second = 0;
    float farthest = -1;
    for (const std::uint32_t i : extremes) {
      for (const std::uint32_t j : extremes) {
        if (squared(i, j) < farthest) continue;
        farthest = squared(i, j);
        first = i;
        second = j;
      }
    }
    Primitives nearer;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (squared(i, first) < squared(i, second)) nearer.push_back(i);
    }
    const Tree tree = build_study_tree("distance(order=faithful)", boxes);
    EXPECT_EQ(primitives_below(tree, tree.nodes[0].first), nearer);
  }
}

std::uint32_t morton_code(const Box& box, const Box& centers) {
  std::uint32_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float offset = ((box.lower + box.upper)[axis] - centers.lower[axis]) / centers.extent()[axis];
    const auto cell = std::min(1023u, static_cast<std::uint32_t>(offset * 1024));
    for (std::uint32_t bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1) << (3 * bit + axis);
  }
  return code;
}

TEST(Hlbvh, LeavesAreSmallOrOfOneCode_AndTreeletsPartByTheHighestBit) {
  std::vector<Box> boxes = random_boxes(12000, 0.001f);
  for (std::size_t i = 0; i < 1000; ++i) boxes[i].upper = (boxes[i].lower = boxes[0].lower) + Vec3{1e-4f, 1e-4f, 1e-4f};
  Box centers;
  longest_of_centroids(boxes, centers);
  const Tree tree = build_study_tree("hlbvh", boxes);
  std::size_t treelet_splits = 0;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    std::uint32_t all = ~0u, any = 0;
    for (const std::uint32_t p : primitives_below(tree, i)) {
      all &= morton_code(boxes[p], centers);
      any |= morton_code(boxes[p], centers);
    }
    const std::uint32_t differing = all ^ any;
    if (node.is_leaf()) {
      EXPECT_TRUE(node.count < 4 || differing == 0);
    } else if (differing < (1u << 18)) {  // one treelet
      ++treelet_splits;
      EXPECT_GE(primitives_below(tree, i).size(), 4u);
      const auto highest = static_cast<unsigned>(std::bit_width(differing)) - 1;
      EXPECT_EQ(node.axis, highest % 3);
      for (const std::uint32_t p : primitives_below(tree, node.first))
        EXPECT_EQ(morton_code(boxes[p], centers) >> highest & 1, 0u);
      for (const std::uint32_t p : primitives_below(tree, node.first + 1))
        EXPECT_EQ(morton_code(boxes[p], centers) >> highest & 1, 1u);
    }
  }
  EXPECT_GT(treelet_splits, 50u);
}

}  // namespace
}  // namespace boxwood
