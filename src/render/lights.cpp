#include "render/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/sampling.h"

namespace boxwood {
namespace {

/// How much a triangle counts among the surfaces, per area.
float weight_per_area(const Material& material) {
  return luminance(material.emission) * (material.emits_behind ? 2.0f : 1.0f);
}

double world_area(const Mesh& mesh, const Transform& map, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3 u = map.vector(mesh.positions[b] - mesh.positions[a]);
  const Vec3 v = map.vector(mesh.positions[c] - mesh.positions[a]);
  return static_cast<double>(length(cross(u, v))) / 2;
}

/// Share of a spot's intensity at an angle of this cosine from its axis: smooth between its two cones.
float spot_share(const Light& light, float cosine) {
  const float range = std::max(light.full_cosine - light.dark_cosine, 1e-6f);
  const float x = std::clamp((cosine - light.dark_cosine) / range, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace

Lights::Lights(const Scene& scene, const Surfaces& surfaces, const Light& fallback) : surfaces_(surfaces) {
  const auto add = [&](const Light& light) {
    if (!(luminance(light.intensity) > 0)) return;
    light.kind == LightKind::sky ? void(sky_ += light.intensity) : lights_.push_back(light);
  };
  std::ranges::for_each(scene.lights, add);
  add_surfaces(scene);
  if (lights_.empty() && emitters_.empty() && sky_ == Vec3{}) add(fallback);
  families_ = static_cast<std::uint32_t>(!lights_.empty() + !emitters_.empty() + (sky_ != Vec3{}));
}

void Lights::add_surfaces(const Scene& scene) {
  const auto emits = [](const Material& material) { return weight_per_area(material) > 0; };
  if (std::ranges::none_of(scene.materials, emits)) return;
  double weights = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t triangle = 0; triangle < mesh.materials.size(); ++triangle) {
      const Material& material = surfaces_.material(i, triangle);
      if (!emits(material) || !is_usable(mesh, triangle)) continue;
      weights += world_area(mesh, instance.object_to_world, triangle) * static_cast<double>(weight_per_area(material));
      emitters_.push_back({i, triangle, weights});
    }
  }
  if (!std::isfinite(weights) || weights <= 0) emitters_.clear();
}

LightSample Lights::sample(const Vec3& point, const Vec3& normal, Random& random) const {
  if (families_ == 0) return {};
  std::uint32_t family = random.below(families_);
  if (!lights_.empty() && family-- == 0) return sample_lights(point, random);
  if (sky_ != Vec3{} && family-- == 0) return sample_sky(normal, random);
  return sample_surfaces(point, random);
}

LightSample Lights::sample_lights(const Vec3& point, Random& random) const {
  const Light& light = lights_[random.below(static_cast<std::uint32_t>(lights_.size()))];
  LightSample sample;
  sample.light = light.intensity * static_cast<float>(lights_.size() * families_);
  if (light.kind == LightKind::distant) {
    sample.far_away = true;
    sample.target = sample.direction = -light.direction;
    return sample;
  }
  const Vec3 way = light.position - point;
  sample.target = light.position;
  sample.direction = normalize(way);
  sample.light = sample.light / std::max(dot(way, way), std::numeric_limits<float>::min());
  if (light.kind == LightKind::spot) {
    sample.light = sample.light * spot_share(light, -dot(sample.direction, light.direction));
  }
  return sample;
}

LightSample Lights::sample_sky(const Vec3& normal, Random& random) const {
  const float u = random.uniform(), v = random.uniform();
  LightSample sample;
  sample.far_away = true;
  sample.target = sample.direction = Basis(normal).around_normal(cosine_hemisphere(u, v));
  sample.density = sky_density(normal, sample.direction);
  if (sample.density > 0) sample.light = sky_ / sample.density;
  return sample;
}

LightSample Lights::sample_surfaces(const Vec3& point, Random& random) const {
  const double at = static_cast<double>(random.uniform()) * emitters_.back().weights;
  const auto found = std::ranges::upper_bound(emitters_, at, {}, &Emitter::weights);
  const Emitter& emitter = found == emitters_.end() ? emitters_.back() : *found;
  const float root = std::sqrt(random.uniform()), across = random.uniform();
  const SurfacePoint surface = surfaces_.at(emitter.instance, emitter.triangle, root * (1 - across), root * across);
  LightSample sample;
  const Vec3 way = surface.position - point;
  sample.target = surface.position;
  sample.direction = normalize(way);
  sample.density = surface_density(surface, sample.direction, length(way));
  if (sample.density > 0) sample.light = emission(surface, sample.direction) / sample.density;
  return sample;
}

float Lights::sky_density(const Vec3& normal, const Vec3& direction) const {
  if (sky_ == Vec3{}) return 0;
  return std::max(dot(normal, direction), 0.0f) / (pi * static_cast<float>(families_));
}

Vec3 Lights::emission(const SurfacePoint& surface, const Vec3& direction) {
  const bool front = dot(surface.normal, direction) < 0;
  return front || surface.material->emits_behind ? surface.material->emission : Vec3{};
}

float Lights::surface_density(const SurfacePoint& surface, const Vec3& direction, float distance) const {
  if (emitters_.empty()) return 0;
  const auto per_area =
      static_cast<float>(static_cast<double>(weight_per_area(*surface.material)) / emitters_.back().weights);
  const float cosine = std::fabs(dot(surface.normal, direction));
  return cosine > 0 ? per_area * distance * distance / (cosine * static_cast<float>(families_)) : 0;
}

}  // namespace boxwood
