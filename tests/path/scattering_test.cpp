#include "render/scattering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/sampling.h"
#include "render/tone_map.h"

namespace boxwood {
namespace {

SurfacePoint point_of(const Material& material) {
  SurfacePoint point;
  point.normal = {0, 0, 1};
  point.material = &material;
  point.diffuse = material.diffuse;
  return point;
}

const Material glossy{.name = {}, .diffuse = {0.2f, 0.3f, 0.1f}, .specular = {0.5f, 0.5f, 0.5f}, .shininess = 15};
const Vec3 slanted = normalize({1, 0.5f, -1});

TEST(Scattering, DensityIsThatOfTheSamples) {
  // The mean of cosine / density over samples is the integral of the cosine over the hemisphere.
  const Scattering scattering(point_of(glossy), slanted);
  Random random(1);
  double projected = 0, density_sum = 0;
  constexpr int samples = 200'000;
  for (int i = 0; i < samples; ++i) {
    const ScatteredRay ray = scattering.sample(random);
    if (ray.density > 0) projected += static_cast<double>(ray.direction.z / ray.density);
    const float u = random.uniform(), v = random.uniform();
    density_sum += static_cast<double>(scattering.density(uniform_hemisphere(u, v)));
  }
  EXPECT_NEAR(projected / samples, static_cast<double>(pi), 0.03);
  // Some samples of the glossy lobe go below the surface, where the density says nothing.
  EXPECT_NEAR(density_sum / samples * 2 * static_cast<double>(pi), 1, 0.06);
}

TEST(Scattering, SamplesReproduceTheIntegralOfWhatIsEvaluated) {
  const Scattering scattering(point_of(glossy), slanted);
  Random random(2);
  Vec3 sampled, integrated;
  constexpr int samples = 200'000;
  for (int i = 0; i < samples; ++i) {
    sampled += scattering.sample(random).weight / samples;
    const float u = random.uniform(), v = random.uniform();
    integrated += scattering.evaluate(uniform_hemisphere(u, v)) * (2 * pi / samples);
  }
  EXPECT_NEAR(sampled.x, integrated.x, 0.01f);
  EXPECT_NEAR(sampled.y, integrated.y, 0.01f);
  EXPECT_LT(sampled.y, 0.8f) << "no more than the shares";
}

TEST(Scattering, IsReciprocal) {
  const Vec3 back = normalize({-0.3f, 0.6f, 1});
  const Vec3 there = Scattering(point_of(glossy), slanted).evaluate(back) / back.z;
  const Vec3 here = Scattering(point_of(glossy), -back).evaluate(-slanted) / -slanted.z;
  EXPECT_NEAR(there.x, here.x, 1e-5f);
  EXPECT_NEAR(there.y, here.y, 1e-5f);
}

TEST(Fresnel, MatchesKnownReflectances) {
  EXPECT_NEAR(fresnel_reflectance(1, 1 / 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnel_reflectance(1, 1.5f), 0.04f, 1e-6f);
  EXPECT_EQ(fresnel_reflectance(0.5f, 1.5f), 1) << "beyond the critical angle of 41.8 degrees";
  EXPECT_NEAR(fresnel_reflectance(0.0f, 1 / 1.5f), 1, 1e-6f);
  EXPECT_NEAR(fresnel_reflectance(std::cos(pi / 4), 1 / 1.5f), 0.0502f, 1e-4f);
}

TEST(Refraction, FollowsSnellAndComesBackOut) {
  const Material glass{.name = {}, .diffuse = {}, .transmission = {1, 1, 1}, .refraction_index = 1.5f};
  Random random(3);
  const ScatteredRay in = Scattering(point_of(glass), slanted).sample(random);
  ASSERT_EQ(in.lobe, Lobe::refraction);
  const auto sine = [](const Vec3& v) { return std::hypot(v.x, v.y); };
  EXPECT_NEAR(sine(in.direction), sine(slanted) / 1.5f, 1e-6f);
  EXPECT_LT(in.direction.z, 0);
  SurfacePoint below = point_of(glass);
  below.normal = {0, 0, -1};
  const ScatteredRay out = Scattering(below, in.direction).sample(random);
  ASSERT_EQ(out.lobe, Lobe::refraction);
  EXPECT_NEAR(dot(out.direction, slanted), 1, 1e-6f);
}

TEST(Reflection, LeavesAtTheAngleOfIncidence) {
  const Material mirror{.name = {}, .diffuse = {}, .reflection = {0.9f, 0.9f, 0.9f}};
  Random random(4);
  const ScatteredRay ray = Scattering(point_of(mirror), slanted).sample(random);
  EXPECT_EQ(ray.lobe, Lobe::reflection);
  EXPECT_NEAR(dot(ray.direction, Vec3{slanted.x, slanted.y, -slanted.z}), 1, 1e-6f);
  EXPECT_FLOAT_EQ(ray.weight.x, 0.9f);
}

TEST(ToneMap, BringsTheGeometricMeanToTheSamePlaceWhateverTheBrightness) {
  Image dim(2, 1), bright(2, 1);
  dim.pixels = {{0.01f, 0.01f, 0.01f}, {0.04f, 0.04f, 0.04f}};
  bright.pixels = {{10, 10, 10}, {40, 40, 40}};
  const Image a = map_tones(dim, std::nullopt), b = map_tones(bright, std::nullopt);
  EXPECT_NEAR(a.pixels[0].x, b.pixels[0].x, 1e-5f);
  EXPECT_NEAR(a.pixels[1].x, b.pixels[1].x, 1e-5f);
  EXPECT_LT(a.pixels[1].x, 1);
}

TEST(ToneMap, KeepsHueOrderAndTakesStops) {
  Image image(3, 1);
  image.pixels = {{0.2f, 0.1f, 0}, {0.4f, 0.2f, 0}, {0, 0, 0}};
  const Image mapped = map_tones(image, 1.0f);
  EXPECT_NEAR(mapped.pixels[0].x / mapped.pixels[0].y, 2, 1e-5f);
  EXPECT_GT(mapped.pixels[1].x, mapped.pixels[0].x);
  EXPECT_GT(mapped.pixels[0].x, map_tones(image, 0.0f).pixels[0].x);
  EXPECT_EQ(mapped.pixels[2], (Vec3{}));
}

}  // namespace
}  // namespace boxwood
