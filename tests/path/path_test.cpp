// The path tracer against cases that have a closed solution.
#include <gtest/gtest.h>

#include <cmath>

#include "boxwood/structure.h"
#include "math/sampling.h"
#include "render/render.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

using namespace testing_scenes;

/// The same material everywhere.
Scene made_of(Scene scene, const Material& material) {
  scene.materials = {material};
  for (Mesh& mesh : scene.meshes) mesh.materials.assign(mesh.triangles.size(), 0);
  return scene;
}

Material diffuse(float share) { return {.name = {}, .diffuse = {share, share, share}}; }

/// A sphere of radius 1 around the origin, normals outward.
Scene sphere_scene() {
  constexpr std::uint32_t rows = 24, columns = 48;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const float theta = pi * static_cast<float>(row) / rows, phi = 2 * pi * static_cast<float>(column) / columns;
      positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
      const std::uint32_t a = row * columns + column, b = row * columns + (column + 1) % columns;
      if (row == rows) continue;
      triangles.push_back({a, b, b + columns});
      triangles.push_back({a, b + columns, a + columns});
    }
  }
  Scene scene;
  scene.add_mesh(positions, triangles);
  return scene;
}

RenderSettings settings_at(const Camera& camera, std::uint32_t spp, std::uint32_t depth) {
  RenderSettings settings;
  settings.camera = camera;
  settings.width = settings.height = 16;
  settings.spp = spp;
  settings.depth = depth;
  settings.integrator = "path";
  return settings;
}

Vec3 mean_of(const Image& image) {
  Vec3 sum;
  for (const Vec3& pixel : image.pixels) sum += pixel;
  return sum / static_cast<float>(image.pixels.size());
}

Vec3 mean_of(const Scene& scene, const RenderSettings& settings) {
  return mean_of(render(scene, build(scene, "median > binary"), settings).image);
}

Light light_of(LightKind kind, const Vec3& intensity) {
  Light light;
  light.kind = kind;
  light.intensity = intensity;
  return light;
}

const Camera inside{"inside", {0.1f, 0.2f, 0.3f}, {1, 0.3f, 0.2f}, {0, 1, 0}, 90};
/// Sees a small spot around the origin from above.
const Camera above{"above", {0, 0.9f, 0.01f}, {0, -1, 0}, {0, 0, -1}, 1};

TEST(FurnaceTest, AClosedRoomThatGlowsAndReflectsIsAGeometricSeries) {
  for (const float share : {0.0f, 0.5f, 0.8f}) {
    Material glowing = diffuse(share);
    glowing.emission = {1, 2, 3};
    const Vec3 mean = mean_of(made_of(box_scene(), glowing), settings_at(inside, 64, 200));
    EXPECT_NEAR(mean.x, 1 / (1 - share), 0.02f / (1 - share)) << share;
    EXPECT_NEAR(mean.z, 3 / (1 - share), 0.06f / (1 - share)) << share;
  }
}

TEST(FurnaceTest, DepthCutsTheSeriesOff) {
  Material glowing = diffuse(0.5f);
  glowing.emission = {1, 1, 1};
  const Scene scene = made_of(box_scene(), glowing);
  EXPECT_FLOAT_EQ(mean_of(scene, settings_at(inside, 4, 0)).x, 1);
  EXPECT_NEAR(mean_of(scene, settings_at(inside, 256, 1)).x, 1.5f, 0.02f);
  EXPECT_NEAR(mean_of(scene, settings_at(inside, 256, 2)).x, 1.75f, 0.02f);
}

struct Lossless {
  const char* name;
  Material material;
};

class LosslessMaterial : public testing::TestWithParam<Lossless> {};

INSTANTIATE_TEST_SUITE_P(
    Path, LosslessMaterial,
    testing::Values(
        Lossless{"diffuse", diffuse(1)}, Lossless{"mirror", {.name = {}, .diffuse = {}, .reflection = {1, 1, 1}}},
        Lossless{
            "glass",
            {.name = {}, .diffuse = {}, .reflection = {1, 1, 1}, .transmission = {1, 1, 1}, .refraction_index = 1.5f}},
        Lossless{"clear", {.name = {}, .diffuse = {}, .transmission = {1, 1, 1}}},
        Lossless{"overfull", {.name = {}, .diffuse = {1, 1, 1}, .reflection = {1, 1, 1}}}),
    [](const auto& each) { return each.param.name; });

TEST_P(LosslessMaterial, CannotBeSeenInAWhiteSky) {
  const Scene scene = made_of(sphere_scene(), GetParam().material);
  const Camera camera{"outside", {0, 0, 4}, {0, 0, -1}, {0, 1, 0}, 25};
  const Image image = render(scene, build(scene, "median > binary"), settings_at(camera, 64, 60)).image;
  EXPECT_NEAR(mean_of(image).x, 1, 0.01f);
}

TEST(EnergyConservation, AGlossySphereNeverGivesMoreThanItGets) {
  for (const float shininess : {0.0f, 1.0f, 20.0f, 1000.0f}) {
    const Material glossy{
        .name = {}, .diffuse = {0.3f, 0.3f, 0.3f}, .specular = {0.7f, 0.7f, 0.7f}, .shininess = shininess};
    const Camera camera{"outside", {0, 0, 4}, {0, 0, -1}, {0, 1, 0}, 25};
    const Scene scene = made_of(sphere_scene(), glossy);
    const float mean = mean_of(scene, settings_at(camera, 64, 20)).x;
    EXPECT_LT(mean, 1.005f) << shininess;
    EXPECT_GT(mean, 0.4f) << shininess;
  }
}

TEST(DirectLight, OfAPointFollowsTheInverseSquareAndTheCosine) {
  Scene scene = made_of(plane_scene(), diffuse(0.5f));
  scene.lights = {light_of(LightKind::point, {8, 8, 8})};
  scene.lights[0].position = {3, 4, 0};
  EXPECT_NEAR(mean_of(scene, settings_at(above, 4, 1)).x, 0.5f / pi * 8 * (4.0f / 5) / 25, 1e-3f);
}

TEST(DirectLight, OfADistantLightFollowsTheCosine) {
  Scene scene = made_of(plane_scene(), diffuse(0.5f));
  scene.lights = {light_of(LightKind::distant, {2, 2, 2})};
  scene.lights[0].direction = normalize({3, -4, 0});
  EXPECT_NEAR(mean_of(scene, settings_at(above, 4, 1)).x, 0.5f / pi * 2 * 0.8f, 1e-4f);
}

TEST(DirectLight, OfASpotStaysInItsCone) {
  Scene scene = made_of(plane_scene(), diffuse(0.5f));
  scene.lights = {light_of(LightKind::spot, {2, 2, 2})};
  scene.lights[0].position = {0, 2, 0};
  scene.lights[0].direction = {0, -1, 0};
  scene.lights[0].full_cosine = 0.9f;
  scene.lights[0].dark_cosine = 0.8f;
  EXPECT_NEAR(mean_of(scene, settings_at(above, 4, 1)).x, 0.5f / pi * 2 / 4, 1e-3f);
  scene.lights[0].direction = {0, 1, 0};
  EXPECT_EQ(mean_of(scene, settings_at(above, 4, 1)).x, 0);
}

TEST(DirectLight, OfTheSkyOnAPlaneIsItsAlbedo) {
  Scene scene = made_of(plane_scene(), diffuse(0.4f));
  scene.lights = {light_of(LightKind::sky, {3, 3, 3})};
  EXPECT_NEAR(mean_of(scene, settings_at(above, 16, 1)).x, 1.2f, 1e-4f);
}

/// A square lamp of side 2 at height `height` over a plane, and the irradiance below its centre per radiance
/// (a quarter of it is the configuration factor of a rectangle seen from below its corner, times pi).
Scene lamp_scene(float height, bool facing_down, bool emits_behind) {
  Scene scene = made_of(plane_scene(), diffuse(0.5f));
  Mesh lamp = plane_scene(height).meshes[0];
  if (facing_down) {
    for (Triangle& t : lamp.triangles) std::swap(t[1], t[2]);
  }
  scene.materials.push_back({.name = {}, .diffuse = {}, .emission = {5, 5, 5}, .emits_behind = emits_behind});
  lamp.materials.assign(lamp.triangles.size(), 1);
  scene.meshes.push_back(lamp);
  scene.instances.push_back({1, {}});
  return scene;
}

float lamp_irradiance(float height) {
  const float x = 1 / height, slant = x / std::sqrt(1 + x * x);
  return 4 * slant * std::atan(slant);
}

TEST(DirectLight, OfASquareLampIsItsConfigurationFactor) {
  for (const float height : {0.95f, 3.0f}) {
    const float expected = 0.5f / pi * 5 * lamp_irradiance(height);
    EXPECT_NEAR(mean_of(lamp_scene(height, true, false), settings_at(above, 256, 1)).x, expected, 0.02f * expected);
    EXPECT_NEAR(mean_of(lamp_scene(height, false, true), settings_at(above, 256, 1)).x, expected, 0.02f * expected);
    EXPECT_EQ(mean_of(lamp_scene(height, false, false), settings_at(above, 16, 1)).x, 0);
  }
}

TEST(DirectLight, OfASquareLampBesideASkyAddsUp) {
  Scene scene = lamp_scene(3, true, false);
  scene.lights = {light_of(LightKind::sky, {1, 1, 1}), light_of(LightKind::distant, {2, 2, 2})};
  scene.lights[1].direction = normalize({6, -4, 0});
  // The black lamp covers its share of the sky; the distant light passes beside it.
  const float lamp = lamp_irradiance(3);
  const float expected = 0.5f / pi * (5 * lamp + (pi - lamp) + 2 * 4 / std::sqrt(52.0f));
  EXPECT_NEAR(mean_of(scene, settings_at(above, 256, 1)).x, expected, 0.02f * expected);
}

TEST(PathTracer, KeepsAccountOfBothQueriesByKind) {
  const Scene scene = lamp_scene(3, true, false);
  const RenderResult result = render(scene, build(scene, "median > binary"), settings_at(above, 4, 2));
  ASSERT_GE(result.ray_kinds.size(), 3u);
  EXPECT_EQ(result.ray_kinds[0].kind, "primary");
  EXPECT_EQ(result.ray_kinds[0].query, Query::closest_hit);
  EXPECT_EQ(result.ray_kinds[0].rays, 16u * 16 * 4);
  EXPECT_EQ(result.ray_kinds[1].kind, "shadow");
  EXPECT_EQ(result.ray_kinds[1].query, Query::any_hit);
  EXPECT_EQ(result.ray_kinds[2].kind, "diffuse1");
}

TEST(PathTracer, SeedsGiveDifferentNoiseAndTheSameSeedTheSame) {
  const Scene scene = lamp_scene(3, true, false);
  const Structure structure = build(scene, "median > binary");
  RenderSettings settings = settings_at(above, 2, 3);
  const Image first = render(scene, structure, settings).image;
  EXPECT_EQ(render(scene, structure, settings).image, first);
  settings.seed = 2;
  EXPECT_NE(render(scene, structure, settings).image, first);
}

}  // namespace
}  // namespace boxwood
