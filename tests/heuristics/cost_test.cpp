// Cost models that know what will be traced: against counting, ray casting, and what they must reduce to.
#include <gtest/gtest.h>

#include <algorithm>

#include "boxwood/error.h"
#include "cost/picture.h"
#include "cost/segments.h"
#include "heuristics/known.h"

namespace boxwood::test {
namespace {

const Box unit_cube{{0, 0, 0}, {1, 1, 1}};

std::unique_ptr<CostModel> model_of(const std::string& text, const KnownUse& use) {
  return CostChoice::parse(text).make({unit_cube, &use});
}

SegmentList all_of(std::size_t count) {
  SegmentList list(count);
  for (std::uint32_t i = 0; i < count; ++i) list[i] = i;
  return list;
}

std::vector<Segment> segments_of(const ExpectedRays& rays) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) segments.emplace_back(rays.rays[i], rays.ends[i]);
  return segments;
}

/// The sides of all cuts through boxes in a row; the first left ones and the last right ones are empty.
void sides_of(const std::vector<Box>& boxes, std::vector<Side>& left, std::vector<Side>& right) {
  left.assign(boxes.size(), {});
  right.assign(boxes.size(), {});
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      (j < i ? left : right)[i].box.grow(boxes[j]);
      ++(j < i ? left : right)[i].count;
    }
  }
}

TEST(Segments, Chains_CountedAsOneByOne) {
  const std::vector<Segment> segments = segments_of(scattered_rays(20000, unit_cube, 1));
  const SegmentList list = all_of(segments.size());
  std::vector<Side> left, right;
  sides_of(small_boxes(17, 0.2f, 2), left, right);
  std::vector<std::uint32_t> counts(left.size()), right_counts(left.size()), either(left.size());
  count_in_chain(segments, list, left, counts);
  count_in_chain(segments, list, right, right_counts);
  count_in_either(segments, list, left, right, either);
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::uint32_t in_left = 0, in_right = 0, in_either = 0;
    for (const Segment& segment : segments) {
      const bool l = left[i].count > 0 && segment.meets(left[i].box),
                 r = right[i].count > 0 && segment.meets(right[i].box);
      in_left += l, in_right += r, in_either += l || r;
    }
    EXPECT_EQ(counts[i], in_left) << i;
    EXPECT_EQ(right_counts[i], in_right) << i;
    EXPECT_EQ(either[i], in_either) << i;
  }
}

TEST(Segments, BeforeAndBehindABox_EndsCount) {
  const Box box{{1, -1, -1}, {2, 1, 1}};
  Ray ray;
  ray.direction = {1, 0, 0};  // parallel to two pairs of planes
  EXPECT_TRUE(Segment(ray, 1).meets(box));
  EXPECT_FALSE(Segment(ray, 0.99f).meets(box));
  ray.origin = {3, 0, 0};
  EXPECT_FALSE(Segment(ray, 10).meets(box));
  ray.origin = {1.5f, 0, 0};
  EXPECT_TRUE(Segment(ray, 0).meets(box));
}

/// Weight of n rays, found from a child that none of them enters.
float weight_of(std::size_t n) {
  KnownUse use;
  use.rays.push_back(scattered_rays(n, Box{{0, 0, 0}, {0.1f, 0.1f, 0.1f}}, 3));
  for (float& end : use.rays[0].ends) end = 0.01f;
  const Box away{{0.5f, 0.5f, 0.5f}, {1, 1, 1}};
  const float by_area = probability(*CostChoice::parse("sah").make({}), unit_cube, {away, 1});
  return 1 - probability(*model_of("rdh(alpha=0.9, beta=0.1)", use), unit_cube, {away, 1}) / by_area;
}

TEST(Rdh, FewRays_SayLittle) {
  EXPECT_EQ(weight_of(0), 0);
  EXPECT_NEAR(weight_of(10), 0.45, 1e-5);
  EXPECT_NEAR(weight_of(100), 0.81818, 1e-5);
}

TEST(Rdh, NoRays_TheSurfaceAreaTree) {
  const std::vector<Box> boxes = small_boxes(3000, 0.05f, 4);
  const KnownUse use;
  for (const std::string builder : {"sweep", "binned"}) {
    EXPECT_TRUE(same_tree(tree_by(builder + "(cost=rdh)", input_of(boxes, &use)), tree_by(builder, input_of(boxes))));
  }
}

TEST(Rdh, UniformLines_AgreeWithSurfaceArea) {
  // Lines between uniform points of a sphere around the box are uniform.
  KnownUse use;
  ExpectedRays rays{"random", Query::closest_hit, {}, {}};
  Random random(5);
  for (int i = 0; i < 200000; ++i) {
    const Vec3 a = uniform_sphere(random.uniform(), random.uniform()),
               b = uniform_sphere(random.uniform(), random.uniform());
    Ray ray;
    ray.origin = unit_cube.center() + a, ray.direction = b - a;
    rays.rays.push_back(ray);
    rays.ends.push_back(1);
  }
  use.rays.push_back(std::move(rays));
  const auto rdh = model_of("rdh(alpha=1, beta=1000000)", use), sah = CostChoice::parse("sah").make({});
  for (const Box& part : small_boxes(10, 0.9f, 6)) {
    const float expected = probability(*sah, unit_cube, {part, 1});
    EXPECT_NEAR(probability(*rdh, unit_cube, {part, 1}), expected, 5 * std::sqrt(expected / 100000));
  }
}

TEST(Rdh, FirstSplit_IsTheCheapestByCounting) {
  const std::vector<Box> boxes = small_boxes(40, 0.3f, 7);
  KnownUse use;
  use.rays.push_back(scattered_rays(500, Box{{0, 0, 0}, {0.2f, 0.5f, 1}}, 8));
  const std::vector<Segment> segments = segments_of(use.rays[0]);
  Box root;
  for (const Box& box : boxes) root.grow(box);
  double entering = 0;
  for (const Segment& s : segments) entering += s.meets(root);
  const double weight = 0.9 * (1 - 1 / (1 + 0.1 * entering));
  const auto price = [&](const Box& box, double count) {
    double met = 0;
    for (const Segment& s : segments) met += s.meets(box);
    return count * (weight * met / entering + (1 - weight) * half_area(box) / half_area(root));
  };
  double best = 1e30;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<Box> sorted = boxes;
    std::ranges::sort(sorted, {}, [&](const Box& box) { return box.lower[axis] + box.upper[axis]; });
    for (std::size_t cut = 1; cut < sorted.size(); ++cut) {
      Box left, right;
      for (std::size_t i = 0; i < sorted.size(); ++i) (i < cut ? left : right).grow(sorted[i]);
      best = std::min(best,
                      price(left, static_cast<double>(cut)) + price(right, static_cast<double>(sorted.size() - cut)));
    }
  }
  for (const std::string among : {"parent", "children"}) {
    const Tree tree = tree_by("sweep(leaf=1, cost=rdh(among=" + among + "))", input_of(boxes, &use));
    // References below a node are contiguous: count those of the left child.
    std::uint32_t left_count = 0;
    std::vector<std::uint32_t> stack{tree.nodes[0].first};
    while (!stack.empty()) {
      const Tree::Node node = tree.nodes[stack.back()];
      stack.pop_back();
      if (node.is_leaf()) {
        left_count += node.count;
      } else {
        stack.insert(stack.end(), {node.first, node.first + 1});
      }
    }
    const double found = price(tree.nodes[tree.nodes[0].first].bounds, left_count) +
                         price(tree.nodes[tree.nodes[0].first + 1].bounds, 40.0 - left_count);
    if (among == "parent") {
      EXPECT_NEAR(found, best, 1e-3);
    } else {
      EXPECT_GE(found, best - 1e-3);  // it minds other things
    }
  }
}

Window window_at(Vec3 eye) { return {eye, {0.3f, 0.1f, 1}, {0.8f, 0, -0.2f}, {0, 0.6f, -0.1f}}; }

TEST(Picture, AnyBox_CoversAsManyPixelsAsRaysHit) {
  const Window window = window_at({0.5f, 0.5f, -0.2f});
  const Picture picture(window);
  constexpr int side = 200;
  for (const Box& box : small_boxes(20, 0.7f, 9)) {
    int hits = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const float across = (2 * (static_cast<float>(x) + 0.5f) / side) - 1,
                    up = (2 * (static_cast<float>(y) + 0.5f) / side) - 1;
        Ray ray;
        ray.origin = window.eye;
        ray.direction = window.forward + window.right * across + window.up * up;
        hits += Segment(ray, 1e9f).meets(box);
      }
    }
    const double pixels = hits / double{side * side};
    EXPECT_NEAR(picture.area_covered(box) / Picture::area, pixels, 0.012);
  }
}

TEST(Picture, PartsOfABox_CoverLess) {
  Random random(10);
  for (int i = 0; i < 2000; ++i) {
    const Picture picture(window_at(point_in(random, {{-1, -1, -1}, {2, 2, 2}})));
    Box outer;
    outer.grow(point_in(random, unit_cube)), outer.grow(point_in(random, unit_cube));
    Box inner;
    inner.grow(point_in(random, outer)), inner.grow(point_in(random, outer));
    EXPECT_LE(picture.area_covered(inner), picture.area_covered(outer) + 1e-5);
    EXPECT_LE(picture.area_covered(outer), Picture::area);
  }
}

TEST(Picture, WhollyInFront_BothFormsAgree) {
  const Picture picture(window_at({0.5f, 0.5f, -3}));
  for (const Box& box : small_boxes(100, 0.5f, 11)) {
    EXPECT_NEAR(picture.area_of_projected_corners(box), picture.area_covered(box), 1e-6);
  }
}

TEST(Perspective, EyeInTheNode_One) {
  KnownUse use;
  use.windows.push_back(window_at({0.5f, 0.5f, 0.5f}));
  const Box part{{0.4f, 0.4f, 0.4f}, {0.6f, 0.6f, 0.6f}};
  for (const std::string model : {"perspective", "perspective(literal=on)"}) {
    EXPECT_EQ(probability(*model_of(model, use), unit_cube, {part, 1}), 1) << model;
  }
}

TEST(Perspective, OutOfSight_SurfaceAreaOrNoSplitAtAll) {
  KnownUse use;
  use.windows.push_back(window_at({0, 0, 5}));  // looks away
  const std::vector<Box> boxes = small_boxes(500, 0.1f, 12);
  EXPECT_TRUE(
      same_tree(tree_by("binned(cost=perspective)", input_of(boxes, &use)), tree_by("binned", input_of(boxes))));
  use.windows = {{{50, 50, 9}, {0, 0, 1}, {0.1f, 0, 0}, {0, 0.1f, 0}}};
  const std::string literal = "binned(leaf=1000, cost=perspective(literal=on))";
  EXPECT_EQ(tree_by(literal, input_of(boxes, &use)).nodes.size(), 1u);
}

TEST(Parallel, AnyBox_OutlineAsCounted) {
  KnownUse use;
  const Vec3 direction{1, -2, 0.5f};
  use.windows.push_back({{0, 0, 0}, direction, {1, 0, 0}, {0, 1, 0}});
  const auto model = model_of("parallel", use);
  // Parallel rays from a plane before the unit_cube.
  Random random(13);
  std::vector<Segment> segments;
  const Basis basis(normalize(direction));
  for (int i = 0; i < 100000; ++i) {
    Ray ray;
    ray.origin =
        unit_cube.center() - basis.normal * 3 + basis.x * random.uniform(-1, 1) + basis.y * random.uniform(-1, 1);
    ray.direction = basis.normal;
    segments.emplace_back(ray, 1e9f);
  }
  const auto met = [&](const Box& box) {
    return static_cast<double>(std::ranges::count_if(segments, [&](const Segment& s) { return s.meets(box); }));
  };
  for (const Box& box : small_boxes(5, 0.9f, 14)) {
    EXPECT_NEAR(probability(*model, unit_cube, {box, 1}), met(box) / met(unit_cube), 0.01);
  }
}

/// Boxes in two rows behind each other, alike along x: `visible` in front, `hidden` behind.
std::vector<Box> two_rows(std::uint32_t visible, std::uint32_t hidden, KnownUse& use) {
  std::vector<Box> boxes;
  Random random(15);
  for (std::uint32_t i = 0; i < visible + hidden; ++i) {
    const float x = random.uniform(0, 40), z = i < visible ? 0.0f : 1.0f;
    boxes.push_back({{x, 0, z}, {x + 0.1f, 1, z + 0.1f}});
    use.seen.push_back(i < visible ? 1 : 0);
  }
  return boxes;
}

/// Whether the root's children hold seen primitives and unseen ones apart.
bool parts_seen_from_unseen(const Tree& tree) {
  const Tree::Node& root = tree.nodes[0];
  return tree.nodes[root.first].bounds.upper.z < tree.nodes[root.first + 1].bounds.lower.z;
}

TEST(Osah, HiddenRowBehindSeenOne_PartedFirst) {
  KnownUse use;
  const std::vector<Box> boxes = two_rows(80, 120, use);
  EXPECT_FALSE(parts_seen_from_unseen(tree_by("sweep", input_of(boxes))));
  for (const std::string builder : {"sweep", "binned"}) {
    EXPECT_TRUE(parts_seen_from_unseen(tree_by(builder + "(cost=osah)", input_of(boxes, &use)))) << builder;
  }
}

TEST(Osah, SplitThatHidesNoMoreThanSurfaceAreas_Refused) {
  KnownUse use;
  const std::vector<Box> boxes = two_rows(120, 80, use);
  EXPECT_FALSE(parts_seen_from_unseen(tree_by("sweep(cost=osah)", input_of(boxes, &use))));
}

TEST(Osah, AllOrNoneSeen_TheSurfaceAreaTree) {
  const std::vector<Box> boxes = small_boxes(2000, 0.05f, 16);
  const Tree by_area = tree_by("binned", input_of(boxes));
  for (const std::uint8_t seen : {std::uint8_t{0}, std::uint8_t{1}}) {
    KnownUse use;
    use.seen.assign(boxes.size(), seen);
    EXPECT_TRUE(same_tree(tree_by("binned(cost=osah)", input_of(boxes, &use)), by_area));
  }
  KnownUse use;
  use.seen.assign(boxes.size(), 0);
  for (std::size_t i = 0; i < boxes.size(); i += 2) use.seen[i] = 1;
  EXPECT_TRUE(same_tree(tree_by("binned(cost=osah(depth=0))", input_of(boxes, &use)), by_area));
}

TEST(LeafTest, ByArea_SplitsWhatRaysGiveNoReasonTo) {
  const std::vector<Box> boxes = small_boxes(1000, 0.1f, 17);
  KnownUse use;
  use.rays.push_back(scattered_rays(2000, Box{{0.4f, 0.4f, 0.4f}, {0.6f, 0.6f, 0.6f}}, 18));
  const auto largest_leaf = [](const Tree& tree) {
    std::uint32_t most = 0;
    for (const Tree::Node& node : tree.nodes) most = std::max<std::uint32_t>(most, node.is_leaf() ? node.count : 0);
    return most;
  };
  const std::string options = "binned(leaf=1000, traversal_cost=1.2, cost=rdh(alpha=1)";
  EXPECT_LE(largest_leaf(tree_by(options + ", leaf_test=area)", input_of(boxes, &use))),
            largest_leaf(tree_by(options + ")", input_of(boxes, &use))));
}

TEST(CostChoice, AnyText_ReadBackAsPrinted) {
  for (const std::string text : {"sah", "rdh", "rdh(alpha=0.5, rays=shadow)", "blend(sah, interior-hq, 0.5)",
                                 "blend(rdh(beta=1), blend(osah, perspective(literal=on), 0.25), 0.75)"}) {
    EXPECT_EQ(CostChoice::parse(text).text(), text);
  }
  EXPECT_EQ(CostChoice::parse("blend(weight=0.1, second=rdh)").text(), "blend(sah, rdh, 0.1)");
  EXPECT_TRUE(CostChoice::parse("blend(sah, rdh)").needs_use());
  EXPECT_FALSE(CostChoice::parse("blend(sah, interior-hq)").needs_use());
}

TEST(CostChoice, WrongText_SaysWhatIsRight) {
  for (const std::string text : {"nope", "rdh(gamma=1)", "rdh(alpha=2)", "blend(sah, nope)", "rdh(", "sah(1)"}) {
    EXPECT_THROW(CostChoice::parse(text), UsageError) << text;
  }
}

TEST(CostChoice, NothingKnown_Refused) {
  for (const std::string text : {"rdh", "osah", "perspective", "parallel", "blend(sah, rdh)"}) {
    EXPECT_THROW(CostChoice::parse(text).make({unit_cube, nullptr}), UsageError) << text;
  }
}

TEST(Blend, Ends_AreItsParts) {
  const std::vector<Box> boxes = small_boxes(800, 0.1f, 19);
  KnownUse use;
  use.rays.push_back(scattered_rays(1000, unit_cube, 20));
  const auto tree = [&](const std::string& cost) {
    return tree_by("binned(cost=" + cost + ")", input_of(boxes, &use));
  };
  EXPECT_TRUE(same_tree(tree("blend(rdh, interior-hq, 0)"), tree("rdh")));
  EXPECT_TRUE(same_tree(tree("blend(rdh, interior-hq, 1)"), tree("interior-hq")));
  EXPECT_FALSE(same_tree(tree("blend(rdh, interior-hq, 0.5)"), tree("rdh")));
}

}  // namespace
}  // namespace boxwood::test
