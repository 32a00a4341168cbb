// The cost-driven builders against slow searches straight from the definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "build/best_cuts.h"
#include "cost/surface_area.h"
#include "inputs.h"

namespace boxwood {
namespace {

using Primitives = std::vector<std::uint32_t>;

Primitives primitives_below(const Tree& tree, std::uint32_t node) {
  const Tree::Node& n = tree.nodes[node];
  if (n.is_leaf()) return {tree.references.begin() + n.first, tree.references.begin() + n.first + n.count};
  Primitives all;
  for (std::uint32_t i = 0; i < n.count; ++i) {
    const Primitives part = primitives_below(tree, n.first + i);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

Box bounds_of(const std::vector<Box>& boxes, const Primitives& primitives) {
  Box bounds;
  for (const std::uint32_t p : primitives) bounds.grow(boxes[p]);
  return bounds;
}

double price(const std::vector<Box>& boxes, const Primitives& part) {
  return static_cast<double>(half_area(bounds_of(boxes, part))) * static_cast<double>(part.size());
}

/// Area times count of the children of an inner node.
double price_of_children(const Tree& tree, const std::vector<Box>& boxes, const Tree::Node& node) {
  double sum = 0;
  for (std::uint32_t i = 0; i < node.count; ++i) sum += price(boxes, primitives_below(tree, node.first + i));
  return sum;
}

float center2(const Box& box, std::size_t axis) { return box.lower[axis] + box.upper[axis]; }

/// The least price of two parts, over all axes, where `group(primitive, axis)` must not decrease from left to right.
template <class Group>
double cheapest(const std::vector<Box>& boxes, Primitives primitives, const Group& group) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::sort(primitives.begin(), primitives.end(),
              [&](std::uint32_t a, std::uint32_t b) { return group(a, axis) < group(b, axis); });
    for (auto cut = primitives.begin() + 1; cut != primitives.end(); ++cut) {
      if (group(*(cut - 1), axis) == group(*cut, axis)) continue;
      best = std::min(best, price(boxes, {primitives.begin(), cut}) + price(boxes, {cut, primitives.end()}));
    }
  }
  return best;
}

TEST(Sweep, EveryNode_CheapestGapOfAll) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Box> boxes = random_boxes(120, 0.2f, seed);
    const Tree tree = build_tree("sweep(stop=count, leaf=1)", boxes);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
      if (tree.nodes[i].is_leaf()) continue;
      const double brute = cheapest(boxes, primitives_below(tree, i),
                                    [&](std::uint32_t p, std::size_t axis) { return center2(boxes[p], axis); });
      EXPECT_NEAR(price_of_children(tree, boxes, tree.nodes[i]), brute, brute * 1e-5);
    }
  }
}

TEST(Binned, EveryNode_CheapestBorderOfAll) {
  for (const std::uint32_t bins : {4u, 10u, 16u, 200u}) {
    const std::vector<Box> boxes = random_boxes(300, 0.2f, bins);
    const Tree tree = build_tree("binned(stop=count, leaf=1, exact=0, bins=" + std::to_string(bins) + ")", boxes);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
      if (tree.nodes[i].is_leaf()) continue;
      const Primitives primitives = primitives_below(tree, i);
      Box centers;
      for (const std::uint32_t p : primitives) centers.grow(boxes[p].lower + boxes[p].upper);
      const auto bin = [&](std::uint32_t p, std::size_t axis) {
        const float scale = static_cast<float>(bins) / centers.extent()[axis];
        return std::min(static_cast<int>((center2(boxes[p], axis) - centers.lower[axis]) * scale),
                        static_cast<int>(bins) - 1);
      };
      const double brute = cheapest(boxes, primitives, bin);
      EXPECT_NEAR(price_of_children(tree, boxes, tree.nodes[i]), brute, brute * 1e-5);
    }
  }
}

TEST(Sweep, KWays_NeverDearerThanTwo) {
  const std::vector<Box> boxes = random_boxes(200, 0.1f);
  double last = std::numeric_limits<double>::infinity();
  for (const std::uint32_t k : {2u, 3u, 4u, 8u, 16u}) {
    const Tree tree = build_tree("sweep(axis=longest, stop=count, leaf=1, k=" + std::to_string(k) + ")", boxes);
    EXPECT_EQ(tree.nodes[0].count, k);
    const double price = price_of_children(tree, boxes, tree.nodes[0]);
    EXPECT_LT(price, last);
    last = price;
  }
}

TEST(Binned, SixteenWaysSixteenBins_EveryFilledBinIsAChild) {
  const std::vector<Box> boxes = random_boxes(5000, 0.01f);
  const Tree tree = build_tree("binned(k=16, bins=16, axis=longest, stop=count, leaf=16, exact=0)", boxes);
  EXPECT_EQ(tree.nodes[0].count, 16u);
}

struct BoxItems {
  std::vector<Box4> boxes;
  std::vector<std::uint32_t> counts;
  Box4 box(std::uint32_t i) const { return boxes[i]; }
  std::uint32_t count(std::uint32_t i) const { return counts[i]; }
  std::uint32_t seen(std::uint32_t) const { return 0; }
};

/// What pricing needs to know of a node.
ReferenceSet set_in(const Box4& bounds) {
  ReferenceSet set;
  set.bounds = bounds;
  return set;
}

TEST(BestCuts, InlinedSurfaceArea_SamePricesAsTheModel) {
  const std::vector<Box> boxes = random_boxes(100);
  BoxItems items;
  Box4 bounds;
  for (const Box& box : boxes) {
    items.boxes.push_back(box4(Reference{box.lower, 0, box.upper}));
    items.counts.push_back(static_cast<std::uint32_t>(items.counts.size() % 3));
    bounds.grow(items.boxes.back());
  }
  const SurfaceArea model;
  SurfaceAreaPricing inlined;
  ModelPricing asked(model);
  ASSERT_TRUE(inlined.begin(set_in(bounds)));
  ASSERT_TRUE(asked.begin(set_in(bounds)));
  for (const std::uint32_t k : {2u, 4u, 16u}) {
    const BestCuts a = best_cuts(items, inlined, 100, k), b = best_cuts(items, asked, 100, k);
    ASSERT_EQ(a.count, b.count);
    EXPECT_TRUE(std::equal(a.at.begin(), a.at.begin() + a.count, b.at.begin()));
    EXPECT_NEAR(a.price, b.price, 1e-4f * b.price);
  }
}

TEST(BestCuts, OnlyOneItemHoldsReferences_NoCut) {
  BoxItems items;
  items.boxes.assign(8, Box4{});
  items.counts.assign(8, 0);
  items.boxes[3] = box4(Reference{{0, 0, 0}, 0, {1, 1, 1}});
  items.counts[3] = 5;
  SurfaceAreaPricing pricing;
  ASSERT_TRUE(pricing.begin(set_in(items.boxes[3])));
  EXPECT_EQ(best_cuts(items, pricing, 8, 4).count, 0u);
}

}  // namespace
}  // namespace boxwood
