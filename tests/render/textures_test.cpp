// Colours of textures, and that they appear where the texture coordinates put them.
#include "render/textures.h"

#include <gtest/gtest.h>

#include <limits>

#include "render/render.h"
#include "render/surface.h"
#include "render/test_scenes.h"

namespace boxwood {
namespace {

/// Rows from the top: red and green, then blue and white.
const Texture four_colors{"", 2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
constexpr Vec3 red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1, 1, 1};

TEST(TextureColor, IsThePixelsAtItsCentreAndAMeanBetween) {
  EXPECT_EQ(texture_color(four_colors, 0.25, 0.75), red);
  EXPECT_EQ(texture_color(four_colors, 0.75, 0.75), green);
  EXPECT_EQ(texture_color(four_colors, 0.25, 0.25), blue);
  EXPECT_EQ(texture_color(four_colors, 0.75, 0.25), white);
  EXPECT_EQ(texture_color(four_colors, 0.5, 0.75), (Vec3{0.5f, 0.5f, 0}));
  EXPECT_EQ(texture_color(four_colors, 0.5, 0.5), (Vec3{0.5f, 0.5f, 0.5f}));
}

TEST(TextureColor, RepeatsAndTakesAnyNumber) {
  for (const double turns : {-3.0, -1.0, 1.0, 1000.0}) {
    EXPECT_EQ(texture_color(four_colors, 0.25 + turns, 0.75 - turns), red);
  }
  EXPECT_EQ(texture_color(four_colors, 0, 0.75), (Vec3{0.5f, 0.5f, 0}));  // between the last column and the first
  for (const double odd : {1e300, -1e300, 1e-300, -1e-300, 0x1p-53, -0x1p-60, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    const Vec3 color = texture_color(four_colors, odd, odd);
    EXPECT_TRUE(color.x >= 0 && color.x <= 1 && color.y >= 0 && color.y <= 1 && color.z >= 0 && color.z <= 1) << odd;
  }
}

TEST(TextureColor, IsLinearLight) {
  const Texture grey{"", 1, 1, {188, 188, 188}};
  EXPECT_NEAR(texture_color(grey, 0.5, 0.5).x, 0.5f, 0.005f);
}

TEST(Texture, MultipliesTheDiffuseColourWhereItsCoordinatesPutIt) {
  Scene scene;
  scene.add_mesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.meshes[0].materials = {0, 0};
  scene.materials = {Material{.name = {}, .diffuse = {0.5f, 1, 1}, .texture = 0}};
  scene.textures = {four_colors};
  RenderSettings settings;
  settings.camera = {"front", {0, 0, 100}, {0, 0, -1}, {0, 1, 0}, 1.1459f};  // sees the square and no more
  settings.width = settings.height = 2;                                      // a pixel for each of the texture
  const auto pixel = [&](const char* integrator, std::uint32_t x, std::uint32_t y) {
    settings.integrator = integrator;
    settings.lights = "parallel";
    return render(scene, build(scene, "median > binary"), settings).image.pixels[y * 2 + x];
  };
  const auto is_hue = [](const Vec3& color, const Vec3& hue) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(color[i] > 0.01f, hue[i] > 0);
  };
  for (const char* integrator : {"eyelight", "whitted"}) {
    is_hue(pixel(integrator, 0, 0), red);
    is_hue(pixel(integrator, 1, 0), green);
    is_hue(pixel(integrator, 0, 1), blue);
    is_hue(pixel(integrator, 1, 1), white);
  }
  EXPECT_NEAR(pixel("eyelight", 0, 0).x, 0.5f, 0.01f);
}

TEST(Texture, ThatIsNotThereLeavesTheColourAlone) {
  Scene scene = testing_scenes::plane_scene();
  scene.meshes[0].texture_coordinates.resize(4);
  scene.meshes[0].materials = {0, 1};
  scene.materials = {Material{.name = {}, .diffuse = red, .texture = 0},
                     Material{.name = {}, .diffuse = green, .texture = 7}};
  scene.textures = {{"lost.png", 0, 0, {}}};
  const Surfaces surfaces(scene);
  EXPECT_EQ(surfaces.at(0, 0, 0.2f, 0.2f).diffuse, red);
  EXPECT_EQ(surfaces.at(0, 1, 0.2f, 0.2f).diffuse, green);
  scene.textures[0] = {"short", 2, 2, {1, 2, 3}};
  EXPECT_EQ(surfaces.at(0, 0, 0.2f, 0.2f).diffuse, red);
}

}  // namespace
}  // namespace boxwood
