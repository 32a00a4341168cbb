// Ray sets that start at the camera: primary rays and what a renderer would trace from their hits.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "math/sampling.h"
#include "render/camera_rays.h"
#include "render/clear_way.h"
#include "render/ray_sets.h"
#include "render/sample_random.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

constexpr std::size_t chunk = 4096;

/// `fan` rays per hit, in order: make(ray number, which of the fan, point, incoming direction).
template <class Make>
std::vector<Ray> successors(const Surfaces& surfaces, std::span<const Ray> rays, std::span<const Hit> hits,
                            std::uint32_t fan, const Make& make) {
  std::vector<std::uint32_t> alive;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].valid()) alive.push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Ray> out(alive.size() * fan);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, alive.size(), chunk), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::uint32_t parent = alive[i];
      const SurfacePoint point = surfaces.at(hits[parent]);
      for (std::uint32_t which = 0; which < fan; ++which) {
        out[i * fan + which] = make(parent, which, point, rays[parent].direction);
      }
    }
  });
  return out;
}

/// Where a scene without lights is lit from: a tenth of its diagonal above and behind the camera, or, where something
/// is in the way (a ceiling, a wall), most of the way to it.
Light default_light(const RaySetContext& context) {
  const Camera& camera = context.settings.camera;
  const float distance = 0.1f * length(context.bounds.extent());
  const Vec3 way = (normalize(camera.up) - normalize(camera.direction)) * distance;
  return {clear_end(context.structure, camera.eye, way)};
}

/// Those that have a place or a direction; in a scene that is lit by nothing at all, the default one.
std::vector<Light> lights_to_visit(const RaySetContext& context) {
  std::vector<Light> lights;
  const auto shines = [](const Light& light) { return luminance(light.intensity) > 0; };
  for (const Light& light : context.scene.lights) {
    if (shines(light) && light.kind != LightKind::sky) lights.push_back(light);
  }
  const auto emits = [](const Material& material) { return luminance(material.emission) > 0; };
  const bool lit =
      std::ranges::any_of(context.scene.lights, shines) || std::ranges::any_of(context.scene.materials, emits);
  if (!lit) lights.push_back(default_light(context));
  return lights;
}

LightSample way_to(const Light& light) {
  LightSample sample;
  sample.far_away = light.kind == LightKind::distant;
  sample.target = sample.far_away ? -light.direction : light.position;
  return sample;
}

/// Like diffuse_ray, but uniform over the hemisphere.
Ray hemisphere_ray(const SurfacePoint& point, const Vec3& incoming, Random& random) {
  const float u = random.uniform(), v = random.uniform();
  Ray ray;
  ray.origin = origin_off(point, incoming);
  ray.direction = Basis(facing(point.normal, incoming)).around_normal(uniform_hemisphere(u, v));
  return ray;
}

}  // namespace

std::vector<Hit> trace(const Structure& structure, std::span<const Ray> rays) {
  std::vector<Hit> hits(rays.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), chunk), [&](const auto& range) {
    structure.closest_hits(rays.subspan(range.begin(), range.size()),
                           std::span(hits).subspan(range.begin(), range.size()));
  });
  return hits;
}

std::vector<Ray> primary_rays(const RaySetContext& context) {
  const RaySetSettings& settings = context.settings;
  const CameraRays camera(settings.camera, settings.width, settings.height, 1, settings.seed);
  const std::vector<std::uint32_t> pixels =
      pixels_in_blocks(settings.width, settings.height, settings.block, settings.seed);
  std::vector<Ray> rays(pixels.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), chunk), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) rays[i] = camera.ray(pixels[i], 0);
  });
  return rays;
}

std::vector<Ray> shadow_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                             std::uint32_t depth) {
  const Lights lights(context.scene, context.surfaces, default_light(context));
  const std::vector<Light> each = context.whole ? lights_to_visit(context) : std::vector<Light>();
  const auto make = [&](std::uint32_t number, std::uint32_t which, const SurfacePoint& point, const Vec3& incoming) {
    if (!each.empty()) return shadow_ray(point, incoming, way_to(each[which]));
    Random random = sample_random(context.settings.seed, RandomUse::light, number, which, depth);
    return shadow_ray(point, incoming, lights.sample(point.position, facing(point.normal, incoming), random));
  };
  const auto fan = static_cast<std::uint32_t>(std::max<std::size_t>(1, each.size()));
  return successors(context.surfaces, rays, hits, fan, make);
}

std::vector<Ray> ao_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                         std::uint32_t depth) {
  const auto make = [&](std::uint32_t number, std::uint32_t which, const SurfacePoint& point, const Vec3& incoming) {
    Random random = sample_random(context.settings.seed, RandomUse::ao, number, which, depth);
    return ao_ray(point, incoming, context.settings.ao_radius, random);
  };
  return successors(context.surfaces, rays, hits, context.whole ? context.whole->ao_rays : 1, make);
}

std::vector<Ray> diffuse_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                              std::uint32_t bounce) {
  const auto make = [&](std::uint32_t number, std::uint32_t, const SurfacePoint& point, const Vec3& incoming) {
    Random random = sample_random(context.settings.seed, RandomUse::diffuse, number, 0, bounce);
    return context.whole ? hemisphere_ray(point, incoming, random) : diffuse_ray(point, incoming, random);
  };
  return successors(context.surfaces, rays, hits, 1, make);
}

}  // namespace boxwood
