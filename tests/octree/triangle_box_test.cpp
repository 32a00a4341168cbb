// The overlap test never misses a contact, and says no where triangles only pass by.
#include "math/triangle_box.h"

#include <gtest/gtest.h>

#include "math/clip.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

struct Corners {
  Vec3 a, b, c;
};

Corners random_triangle(Random& random, float size) {
  const Vec3 center = test::random_point(random, 1);
  return {center + test::random_point(random, size), center + test::random_point(random, size),
          center + test::random_point(random, size)};
}

Box random_box(Random& random) {
  const Vec3 center = test::random_point(random, 1);
  Vec3 half = test::random_point(random, 0.4f);
  half = max(half, -half);
  return {center - half, center + half};
}

bool boxes_meet(const Corners& t, const Box& box) {
  Box own;
  for (const Vec3& corner : {t.a, t.b, t.c}) own.grow(corner);
  return !intersect(own, box).empty();
}

TEST(TriangleBox, AnyPointInside_IsAnOverlap) {
  Random random(1);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners t = random_triangle(random, i % 2 ? 1.0f : 0.1f);
    const Box box = random_box(random);
    const float u = random.uniform(), v = random.uniform() * (1 - u);
    const Vec3 point = t.a + (t.b - t.a) * u + (t.c - t.a) * v;
    if (!box.contains({point, point})) continue;
    ++inside;
    ASSERT_TRUE(triangle_meets_box(t.a, t.b, t.c, box, 1e-6f)) << i;
  }
  EXPECT_GT(inside, 50);
}

TEST(TriangleBox, AgreesWithClipping) {
  Random random(2);
  int met = 0, passed_by = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners t = random_triangle(random, 0.8f);
    const Box box = random_box(random);
    if (!boxes_meet(t, box)) continue;
    const bool meets = triangle_meets_box(t.a, t.b, t.c, box, 1e-6f);
    const bool clipped = !clip_triangle(t.a, t.b, t.c, box).empty();
    // Within the slack either may be right.
    const Box larger{box.lower - Vec3{1e-5f, 1e-5f, 1e-5f}, box.upper + Vec3{1e-5f, 1e-5f, 1e-5f}};
    ASSERT_TRUE(meets || !clipped) << i;
    ASSERT_TRUE(!meets || !clip_triangle(t.a, t.b, t.c, larger).empty()) << i;
    ++(meets ? met : passed_by);
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(passed_by, 500);
}

TEST(TriangleBox, TouchingACornerOrAFace_IsAnOverlap) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(triangle_meets_box({1, 1, 1}, {2, 1, 3}, {1, 2, 3}, box, 0));
  EXPECT_TRUE(triangle_meets_box({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, box, 0));
  EXPECT_FALSE(triangle_meets_box({3, 0, 0.5f}, {0, 3, 0.5f}, {3, 3, 0.5f}, box, 0));
}

}  // namespace
}  // namespace boxwood
