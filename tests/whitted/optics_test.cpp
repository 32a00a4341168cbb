// Mirrors and glass obey the laws they are made of.
#include "render/whitted/optics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

Vec3 unit_against(const Vec3& normal, Random& random) {
  const Vec3 v = normalize(test::random_point(random, 1));
  return dot(v, normal) < 0 ? v : -v;
}

TEST(Optics, MirroredAndRefractedDirectionsAreUnitAndSharesLieInRange) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 normal = normalize(test::random_point(random, 1));
    const Vec3 incoming = unit_against(normal, random);
    const float ratio = random.uniform(0.4f, 2.5f);
    const Refraction r = refracted(incoming, normal, ratio);
    EXPECT_NEAR(length(mirrored(incoming, normal)), 1, 1e-5f);
    EXPECT_NEAR(dot(mirrored(incoming, normal), normal), -dot(incoming, normal), 1e-5f);
    EXPECT_NEAR(length(r.direction), 1, 1e-5f);
    EXPECT_GE(r.reflectance, 0);
    EXPECT_LE(r.reflectance, 1);
  }
}

TEST(Optics, SnellsLawHoldsAndLightGoesBackTheWayItCame) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 normal = normalize(test::random_point(random, 1));
    const Vec3 incoming = unit_against(normal, random);
    const float ratio = random.uniform(0.5f, 1.0f);
    const Refraction r = refracted(incoming, normal, ratio);
    const float sine = length(cross(incoming, normal)), sine_behind = length(cross(r.direction, normal));
    EXPECT_NEAR(sine * ratio, sine_behind, 1e-5f);
    EXPECT_NEAR(dot(cross(incoming, normal), r.direction), 0, 1e-5f);  // one plane
    const Refraction back = refracted(-r.direction, -normal, 1 / ratio);
    EXPECT_LE(length(back.direction + incoming), 2e-3f);
    EXPECT_NEAR(back.reflectance, r.reflectance, 2e-3f);
  }
}

TEST(Optics, EqualIndicesChangeNothing) {
  const Vec3 incoming = normalize(Vec3{0.3f, -1, 0.2f});
  const Refraction r = refracted(incoming, {0, 1, 0}, 1);
  EXPECT_LE(length(r.direction - incoming), 1e-6f);
  EXPECT_NEAR(r.reflectance, 0, 1e-6f);
}

TEST(Optics, FresnelAtRightAnglesAndAtGrazing) {
  EXPECT_NEAR(refracted({0, -1, 0}, {0, 1, 0}, 1 / 1.5f).reflectance, 0.04f, 1e-6f);
  EXPECT_GT(refracted(normalize(Vec3{1, -1e-3f, 0}), {0, 1, 0}, 1 / 1.5f).reflectance, 0.98f);
}

TEST(Optics, TotalReflectionBeyondTheCriticalAngle) {
  const float critical = std::asin(1 / 1.5f);
  const auto at = [&](float angle) { return refracted({std::sin(angle), -std::cos(angle), 0}, {0, 1, 0}, 1.5f); };
  EXPECT_LT(at(critical - 0.01f).reflectance, 1);
  EXPECT_EQ(at(critical + 0.01f).reflectance, 1);
}

}  // namespace
}  // namespace boxwood
