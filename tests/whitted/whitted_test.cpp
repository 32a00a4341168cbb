// Pictures of mirrors and glass show what geometry says they must; scheduling changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "boxwood/structure.h"
#include "render/camera_rays.h"
#include "render/render.h"
#include "render/whitted/light_rig.h"
#include "render/whitted/optics.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

constexpr std::uint32_t size = 48;
constexpr Vec3 red{0.8f, 0, 0}, green{0, 0.6f, 0}, blue{0, 0, 0.9f};

/// A huge cube around the origin whose sides glow: x red, y green, z blue, brighter on the upper side. What a ray sees
/// tells where it went.
Vec3 glow_of(int axis, bool upper) {
  const Vec3 color = axis == 0 ? red : axis == 1 ? green : blue;
  return color * (upper ? 1.0f : 0.5f);
}

constexpr float half_side = 50;

/// What a ray that leaves `origin` sees of the cube.
Vec3 seen_from(const Vec3& origin, const Vec3& direction) {
  float nearest = 1e30f;
  Vec3 color;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool upper = direction[axis] > 0;
    const float t = ((upper ? half_side : -half_side) - origin[axis]) / direction[axis];
    if (t > 0 && t < nearest) {
      nearest = t;
      color = glow_of(static_cast<int>(axis), upper);
    }
  }
  return color;
}

Scene in_glowing_cube(Scene inner, const Material& material) {
  Scene cube = test::transformed(test::cube(1), half_side, {});
  Scene scene = std::move(inner);
  Mesh& mesh = scene.meshes[0];
  // Outward: what lies behind the triangles is the glass.
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  mesh.materials.assign(mesh.triangles.size(), 0);
  scene.materials = {material};
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      Material side;
      side.diffuse = {};
      side.emission = glow_of(axis, upper);
      scene.materials.push_back(side);
    }
  }
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const Mesh& walls = cube.meshes[0];
  mesh.positions.insert(mesh.positions.end(), walls.positions.begin(), walls.positions.end());
  for (const auto& [a, b, c] : walls.triangles) {
    mesh.triangles.push_back({base + a, base + b, base + c});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float place = walls.positions[a][axis];
      if (walls.positions[b][axis] != place || walls.positions[c][axis] != place) continue;
      mesh.materials.push_back(static_cast<std::uint16_t>(1 + 2 * axis + (place > 0 ? 1 : 0)));
    }
  }
  return scene;
}

RenderSettings settings_for(float distance) {
  RenderSettings settings;
  settings.camera.eye = Vec3{0.3f, 0.4f, 1} * distance;
  settings.camera.direction = -settings.camera.eye;
  settings.camera.fov = 40;
  settings.width = settings.height = size;
  settings.integrator = "whitted";
  settings.lights = "headlight";
  return settings;
}

/// Distance at which a ray meets the unit sphere; negative: it misses.
float meet_sphere(const Vec3& origin, const Vec3& direction, bool inside) {
  const float b = dot(origin, direction), c = dot(origin, origin) - 1, d = b * b - c;
  if (d < 0) return -1;
  return -b + (inside ? std::sqrt(d) : -std::sqrt(d));
}

/// Share of pixels whose colour is that of `expected(ray)`; rays close to an edge of the cube may fall on either side.
template <class Expected>
double share_that_agrees(const Image& image, const RenderSettings& settings, const Expected& expected) {
  const CameraRays rays(settings.camera, size, size, 1, 1);
  int agree = 0;
  for (std::uint32_t pixel = 0; pixel < size * size; ++pixel) {
    const Vec3 wanted = expected(rays.ray(pixel, 0));
    agree += length(image.pixels[pixel] - wanted) < 0.06f ? 1 : 0;
  }
  return agree / double{size * size};
}

TEST(Whitted, AMirrorBallShowsTheRoomWhereReflectionPutsIt) {
  Material mirror;
  mirror.diffuse = {};
  mirror.reflection = {1, 1, 1};
  const Scene scene = in_glowing_cube(test::sphere(48), mirror);
  const RenderSettings settings = settings_for(3);
  const Image image = render(scene, build(scene), settings).image;
  const double agree = share_that_agrees(image, settings, [](const Ray& ray) {
    const float t = meet_sphere(ray.origin, ray.direction, false);
    if (t < 0) return seen_from(ray.origin, ray.direction);
    const Vec3 point = ray.origin + ray.direction * t;
    return seen_from(point, mirrored(ray.direction, normalize(point)));
  });
  EXPECT_GT(agree, 0.93);  // the ball is made of flat triangles
}

TEST(Whitted, AGlassBallShowsTheRoomWhereSnellsLawPutsIt) {
  Material glass;
  glass.diffuse = {};
  glass.transmission = {1, 1, 1};
  glass.refraction_index = 1.5f;
  const Scene scene = in_glowing_cube(test::sphere(48), glass);
  RenderSettings settings = settings_for(3);
  settings.depth = 2;  // into the ball and out of it
  const Image image = render(scene, build(scene), settings).image;
  const double agree = share_that_agrees(image, settings, [](const Ray& ray) {
    const float t = meet_sphere(ray.origin, ray.direction, false);
    if (t < 0) return seen_from(ray.origin, ray.direction);
    const Vec3 in = ray.origin + ray.direction * t, normal = normalize(in);
    const Refraction enter = refracted(ray.direction, normal, 1 / 1.5f);
    const Vec3 out = in + enter.direction * meet_sphere(in, enter.direction, true);
    const Refraction leave = refracted(enter.direction, -normalize(out), 1.5f);
    // Two reflections at most: off the front, and once inside and out again, which is left out as faint.
    return seen_from(in, mirrored(ray.direction, normal)) * enter.reflectance +
           seen_from(out, leave.direction) * ((1 - enter.reflectance) * (1 - leave.reflectance));
  });
  EXPECT_GT(agree, 0.88);
}

TEST(Whitted, GlassOfTheSameIndexAsItsSurroundingsIsInvisible) {
  Material air;
  air.diffuse = {};
  air.transmission = {1, 1, 1};
  const Scene scene = in_glowing_cube(test::sphere(16), air);
  const RenderSettings settings = settings_for(3);
  const Image image = render(scene, build(scene), settings).image;
  EXPECT_GT(share_that_agrees(image, settings, [](const Ray& ray) { return seen_from(ray.origin, ray.direction); }),
            0.99);
}

Scene table_scene() {
  Scene scene = test::sphere(24);
  Material body;
  body.diffuse = {0.3f, 0.2f, 0.1f};
  body.specular = {0.5f, 0.5f, 0.5f};
  body.shininess = 20;
  body.reflection = {0.3f, 0.3f, 0.3f};
  body.transmission = {0.4f, 0.4f, 0.4f};
  body.refraction_index = 1.3f;
  Material floor;
  floor.reflection = {0.5f, 0.5f, 0.5f};
  scene.materials = {body, floor};
  Mesh& mesh = scene.meshes[0];
  mesh.materials.assign(mesh.triangles.size(), 0);
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {Vec3{-6, -1, -6}, Vec3{6, -1, -6}, Vec3{6, -1, 6}, Vec3{-6, -1, 6}})
    mesh.positions.push_back(p);
  mesh.triangles.push_back({base, base + 2, base + 1});
  mesh.triangles.push_back({base, base + 3, base + 2});
  mesh.materials.insert(mesh.materials.end(), {1, 1});
  return scene;
}

TEST(Whitted, QueuedAndImmediateGiveTheSameBitsOnAnyStructure) {
  const Scene scene = table_scene();
  RenderSettings settings = settings_for(5);
  settings.lights = "studio";
  settings.spp = 2;
  const Image queued = render(scene, build(scene), settings).image;
  settings.secondary = SecondaryRays::immediate;
  EXPECT_EQ(render(scene, build(scene), settings).image, queued);
  EXPECT_EQ(render(scene, build(scene, "middle > slab(packet=8)"), settings).image, queued);
}

TEST(Whitted, ADepthOfZeroHasNoSecondaryRaysButShadows) {
  const Scene scene = table_scene();
  RenderSettings settings = settings_for(5);
  settings.depth = 0;
  for (const RayKindReport& kind : render(scene, build(scene), settings).ray_kinds) {
    EXPECT_TRUE(kind.kind == "primary" || kind.kind == "shadow") << kind.kind;
  }
  settings.depth = 3;
  std::vector<std::string> kinds;
  for (const RayKindReport& kind : render(scene, build(scene), settings).ray_kinds) kinds.push_back(kind.kind);
  EXPECT_NE(std::ranges::find(kinds, "reflection"), kinds.end());
  EXPECT_NE(std::ranges::find(kinds, "refraction"), kinds.end());
}

std::uint64_t shadow_rays(const std::string& lights) {
  const Scene scene = table_scene();
  RenderSettings settings = settings_for(5);
  settings.lights = lights;
  settings.depth = 0;
  for (const RayKindReport& kind : render(scene, build(scene), settings).ray_kinds) {
    if (kind.kind == "shadow") return kind.rays;
  }
  return 0;
}

TEST(Whitted, EveryLightSettingLightsTheSceneAndDiffersFromTheOthers) {
  const Scene scene = table_scene();
  std::vector<Image> images;
  for (const LightSetting& setting : light_settings()) {
    if (setting.name == "scene") continue;
    RenderSettings settings = settings_for(5);
    settings.lights = setting.name;
    const Image image = render(scene, build(scene), settings).image;
    EXPECT_GT(std::ranges::max_element(image.pixels, {}, &Vec3::x)->x, 0.2f) << setting.name;
    for (const Image& other : images) EXPECT_NE(image, other) << setting.name;
    images.push_back(image);
  }
  EXPECT_EQ(images.size(), 6u);
  EXPECT_GT(shadow_rays("area"), 10 * shadow_rays("point"));
}

TEST(Whitted, UnderACeiling_LightsStayBelowIt) {
  const Scene room = test::cube(4);
  RenderSettings settings;
  settings.integrator = "whitted";
  settings.width = settings.height = size;
  settings.camera = {"under the ceiling", {0, 0.95f, 0}, {1, -0.4f, 0}, {0, 1, 0}, 70};
  for (const char* lights : {"scene", "point", "two-points", "area"}) {
    settings.lights = lights;
    std::uint64_t lit = 0;
    for (const RayKindReport& kind : render(room, build(room), settings).ray_kinds) {
      if (kind.kind == "shadow") lit += kind.rays - kind.hits;
    }
    EXPECT_GT(lit, size * size / 2) << lights;
  }
}

TEST(Whitted, AnUnknownLightSettingIsRefusedByName) {
  const Scene scene = table_scene();
  RenderSettings settings = settings_for(5);
  settings.lights = "paralel";
  try {
    render(scene, build(scene), settings);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("parallel"), std::string::npos);
  }
}

}  // namespace
}  // namespace boxwood
