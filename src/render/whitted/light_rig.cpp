#include "render/whitted/light_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "boxwood/error.h"
#include "math/sampling.h"
#include "options/suggest.h"
#include "render/clear_way.h"
#include "render/lights.h"

namespace boxwood {
namespace {

constexpr Vec3 faint{0.1f, 0.1f, 0.1f};
constexpr int grid = 4;                         // an area light is grid x grid point lights
constexpr std::size_t most_scene_samples = 16;  // point lights that stand for all glowing surfaces of a scene

/// The camera's frame, scaled by the scene.
struct Stage {
  const Structure& structure;
  Vec3 eye, ahead, right, up, center;
  float size;

  Stage(const Scene& scene, const Structure& of_scene, const Camera& camera) : structure(of_scene) {
    const Box bounds = scene.bounds();
    center = bounds.empty() ? Vec3{} : bounds.center();
    size = bounds.empty() ? 1 : length(bounds.extent());
    eye = camera.eye;
    ahead = normalize(camera.direction);
    right = normalize(cross(ahead, camera.up));
    if (right == Vec3{}) right = normalize(cross(ahead, std::fabs(ahead.x) < 0.5f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    up = cross(right, ahead);
  }
  /// A little off the eye, on its side of ceilings and walls.
  Vec3 beside_eye(float to_right, float upward) const {
    return clear_end(structure, eye, (right * to_right + up * upward) * (0.05f * size));
  }
};

RigLight point_light(const Vec3& position, float strength) {
  RigLight light;
  light.position = position;
  light.intensity = Vec3{1, 1, 1} * strength;
  return light;
}

RigLight parallel_light(const Vec3& direction, float strength) {
  RigLight light;
  light.parallel = true;
  light.direction = normalize(direction);
  light.intensity = Vec3{1, 1, 1} * strength;
  return light;
}

/// A square of that side around a place, facing the centre of the scene.
void add_area_light(const Stage& stage, const Vec3& position, float side, float strength, LightRig& rig) {
  const Vec3 towards = normalize(stage.center - position);
  const Vec3 reference = towards == Vec3{} ? stage.ahead : towards;
  const Vec3 u = normalize(cross(reference, std::fabs(reference.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
  const Vec3 v = cross(u, reference);
  for (int row = 0; row < grid; ++row) {
    for (int column = 0; column < grid; ++column) {
      const float x = (static_cast<float>(column) + 0.5f) / grid - 0.5f;
      const float y = (static_cast<float>(row) + 0.5f) / grid - 0.5f;
      rig.lights.push_back(point_light(position + (u * x + v * y) * side, strength / (grid * grid)));
    }
  }
}

LightRig preset(std::string_view name, const Stage& stage) {
  LightRig rig{faint, {}};
  const Vec3 above = stage.beside_eye(1, 2);
  if (name == "headlight") {
    rig.lights.push_back(point_light(stage.eye, 0.9f));
  } else if (name == "point") {
    rig.lights.push_back(point_light(above, 0.9f));
  } else if (name == "two-points") {
    rig.lights.push_back(point_light(above, 0.6f));
    rig.lights.push_back(point_light(stage.beside_eye(-3, 0.5f), 0.3f));
  } else if (name == "parallel") {
    rig.lights.push_back(parallel_light(stage.ahead * 0.6f - stage.up + stage.right * 0.4f, 0.9f));
  } else if (name == "area") {
    add_area_light(stage, above, 0.1f * stage.size, 0.9f, rig);
  } else {
    add_area_light(stage, above, 0.1f * stage.size, 0.5f, rig);
    rig.lights.push_back(point_light(stage.beside_eye(-3, 0.5f), 0.2f));
    rig.lights.push_back(parallel_light(stage.ahead * 0.6f - stage.up, 0.2f));
  }
  return rig;
}

/// Irradiance to what a white diffuse surface shows is a division by pi.
void add_scene_light(const Light& light, LightRig& rig) {
  RigLight out;
  out.position = light.position;
  out.direction = light.direction;
  out.intensity = light.intensity / pi;
  switch (light.kind) {
    case LightKind::sky:
      rig.ambient += light.intensity;
      return;
    case LightKind::distant:
      out.parallel = true;
      break;
    case LightKind::spot:
      out.full_cosine = light.full_cosine;
      out.dark_cosine = light.dark_cosine;
      [[fallthrough]];
    case LightKind::point:
      out.fades = true;
      break;
  }
  rig.lights.push_back(out);
}

struct GlowingTriangle {
  std::uint32_t instance, triangle;
  float power, area;
};

std::vector<GlowingTriangle> glowing_triangles(const Scene& scene, const Surfaces& surfaces) {
  std::vector<GlowingTriangle> out;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t t = 0; t < mesh.materials.size(); ++t) {
      if (mesh.materials[t] >= scene.materials.size()) continue;
      const Vec3& glow = scene.materials[mesh.materials[t]].emission;
      if (glow == Vec3{} || !is_usable(mesh, t)) continue;
      const auto corner = [&](float u, float v) { return surfaces.at(i, t, u, v).position; };
      const Vec3 a = corner(0, 0);
      const float area = length(cross(corner(1, 0) - a, corner(0, 1) - a)) / 2;
      out.push_back({i, t, area * (glow.x + glow.y + glow.z), area});
    }
  }
  return out;
}

/// Places evenly by power over all glowing triangles, each with an equal share of it.
void add_glowing_surfaces(const Scene& scene, const Surfaces& surfaces, LightRig& rig) {
  const std::vector<GlowingTriangle> triangles = glowing_triangles(scene, surfaces);
  float total = 0;
  for (const GlowingTriangle& triangle : triangles) total += triangle.power;
  if (!(total > 0)) return;
  const float step = total / static_cast<float>(most_scene_samples);
  float next = step / 2, sum = 0;
  std::size_t number = 0;
  for (const GlowingTriangle& triangle : triangles) {
    while (next < sum + triangle.power) {
      // Where on the triangle: the R2 sequence (Roberts 2018), folded into it.
      float u = std::fmod(0.5f + 0.7548776662f * static_cast<float>(number), 1.0f);
      float v = std::fmod(0.5f + 0.5698402910f * static_cast<float>(number), 1.0f);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const SurfacePoint point = surfaces.at(triangle.instance, triangle.triangle, u, v);
      const Vec3& glow = point.material->emission;
      RigLight light;
      light.position = point.position + point.normal * point.clearance;
      light.fades = true;
      light.normal = point.material->emits_behind ? Vec3{} : point.normal;
      // The sample stands for step / (sum of colours) of area.
      light.intensity = glow * (step / (glow.x + glow.y + glow.z) / pi);
      rig.lights.push_back(light);
      next += step;
      ++number;
    }
    sum += triangle.power;
  }
}

void scale_to_show(const Vec3& center, LightRig& rig) {
  float sum = luminance(rig.ambient);
  for (const RigLight& light : rig.lights) {
    const Vec3 way = light.position - center;
    const float fading = light.fades ? std::max(dot(way, way), 1e-20f) : 1;
    sum += luminance(light.intensity) / fading;
  }
  if (!(sum > 0 && std::isfinite(sum))) return;
  const float scale = 0.9f / sum;
  rig.ambient = rig.ambient * scale;
  for (RigLight& light : rig.lights) light.intensity = light.intensity * scale;
}

}  // namespace

std::span<const LightSetting> light_settings() {
  static constexpr std::array<LightSetting, 7> table{{
      {"scene", "the lights and glowing surfaces of the scene; 'point' where there are none"},
      {"headlight", "a point light at the eye"},
      {"point", "a point light above the eye"},
      {"two-points", "a strong point light above the eye and a weak one to the left"},
      {"parallel", "parallel light from behind and above"},
      {"area", "a square light above the eye: soft shadows from 16 rays"},
      {"studio", "area, point and parallel light together"},
  }};
  return table;
}

LightRig make_light_rig(std::string_view setting, const Scene& scene, const Structure& structure,
                        const Surfaces& surfaces, const Camera& camera) {
  if (std::ranges::find(light_settings(), setting, &LightSetting::name) == light_settings().end()) {
    std::vector<std::string> names;
    for (const LightSetting& known : light_settings()) names.emplace_back(known.name);
    throw UsageError(fmt::format("unknown light setting '{}': {}", setting, suggest(setting, names)));
  }
  const Stage stage(scene, structure, camera);
  if (setting != "scene") return preset(setting, stage);
  LightRig rig;
  for (const Light& light : scene.lights) add_scene_light(light, rig);
  add_glowing_surfaces(scene, surfaces, rig);
  if (rig.lights.empty() && rig.ambient == Vec3{}) return preset("point", stage);
  scale_to_show(stage.center, rig);
  return rig;
}

}  // namespace boxwood
