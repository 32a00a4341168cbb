#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "boxwood/box.h"
#include "boxwood/error.h"
#include "boxwood/transform.h"
#include "math/clip.h"

namespace boxwood {
namespace {

class Points {
 public:
  float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  Vec3 point(float low, float high) { return {(*this)(low, high), (*this)(low, high), (*this)(low, high)}; }

 private:
  std::mt19937 engine_{7};
};

TEST(Box, DefaultBoxIsEmptyAndGrowsToThePointGiven) {
  Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(half_area(box), 0);
  box.grow(Vec3{1, 2, 3});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.lower, box.upper);
}

TEST(Box, HalfAreaIsHalfTheSurface) { EXPECT_EQ(half_area({{0, 0, 0}, {1, 2, 3}}), 1 * 2 + 2 * 3 + 3 * 1); }

TEST(Box, LongestAxisPrefersTheFirstOnATie) {
  EXPECT_EQ(longest_axis({1, 1, 1}), 0);
  EXPECT_EQ(longest_axis({0, 1, 1}), 1);
  EXPECT_EQ(longest_axis({0, 1, 2}), 2);
}

TEST(Transform, InverseUndoesTheMap) {
  Points random;
  for (int i = 0; i < 100; ++i) {
    const Transform map = Transform::translate(random.point(-5, 5)) *
                          Transform::rotate(normalize(random.point(-1, 1)), random(-3, 3)) *
                          Transform::scale(random.point(0.5f, 2));
    const Vec3 p = random.point(-10, 10), q = map.inverse().point(map.point(p));
    EXPECT_LT(length(q - p), 1e-4f);
  }
}

TEST(Transform, SingularMapHasNoInverse) { EXPECT_THROW((void)Transform::scale({1, 0, 1}).inverse(), Error); }

TEST(Transform, MappedBoxHoldsEveryMappedPoint) {
  Points random;
  for (int i = 0; i < 100; ++i) {
    const Transform map = Transform::translate(random.point(-500, 500)) *
                          Transform::rotate(normalize(random.point(-1, 1)), random(-3, 3));
    Box box;
    box.grow(random.point(-10, 10));
    box.grow(random.point(-10, 10));
    const Box mapped = map.box(box);
    const Vec3 s = random.point(0, 1), p = map.point(box.lower + s * box.extent());
    EXPECT_TRUE(mapped.contains({p, p}));
  }
}

/// Largest distance of a point of the box from what it should hold, found by sampling the triangle.
TEST(ClipTriangle, BoxHoldsEverySampleInTheRegionAndLittleElse) {
  Points random;
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random.point(-1, 1), b = random.point(-1, 1), c = random.point(-1, 1);
    Box region;
    region.grow(random.point(-1, 1));
    region.grow(random.point(-1, 1));
    const Box clipped = clip_triangle(a, b, c, region);
    Box sampled;
    for (int u = 0; u <= 60; ++u) {
      for (int v = 0; u + v <= 60; ++v) {
        const float s = static_cast<float>(u) / 60, t = static_cast<float>(v) / 60;
        const Vec3 p = a * (1 - s - t) + b * s + c * t;
        if (region.contains({p, p})) sampled.grow(p);
      }
    }
    if (sampled.empty()) continue;
    EXPECT_TRUE(clipped.contains(sampled));
    EXPECT_TRUE(region.contains(clipped));
    EXPECT_LT(length(clipped.extent() - sampled.extent()), 0.25f);
  }
}

TEST(ClipTriangle, TriangleOutsideTheRegionGivesAnEmptyBox) {
  EXPECT_TRUE(clip_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {{5, 5, 5}, {6, 6, 6}}).empty());
}

TEST(ClipTriangle, TriangleInsideKeepsItsExactBox) {
  const Box box = clip_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f}, {{-9, -9, -9}, {9, 9, 9}});
  EXPECT_EQ(box, (Box{{0, 0, 0}, {1, 1, 0.5f}}));
}

}  // namespace
}  // namespace boxwood
