// Ray sets that start at the camera: primary rays and what a renderer would trace from their hits.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/camera_rays.h"
#include "render/ray_sets.h"
#include "render/sample_random.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

constexpr std::size_t chunk = 4096;

/// One ray per hit, in order: make(ray number, point, incoming direction).
template <class Make>
std::vector<Ray> successors(const Surfaces& surfaces, std::span<const Ray> rays, std::span<const Hit> hits,
                            const Make& make) {
  std::vector<std::uint32_t> alive;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].valid()) alive.push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Ray> out(alive.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, alive.size(), chunk), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::uint32_t parent = alive[i];
      out[i] = make(parent, surfaces.at(hits[parent]), rays[parent].direction);
    }
  });
  return out;
}

/// Where a scene without lights is lit from: a tenth of its diagonal above and behind the camera, or, where something
/// is in the way (a ceiling, a wall), most of the way to it.
Light default_light(const RaySetContext& context) {
  const Camera& camera = context.settings.camera;
  const float distance = 0.1f * length(context.bounds.extent());
  Ray way;
  way.origin = camera.eye;
  way.direction = (normalize(camera.up) - normalize(camera.direction)) * distance;
  way.t_far = 1;
  const Hit obstacle = context.structure.closest_hit(way);
  return {camera.eye + way.direction * (obstacle.valid() ? 0.8f * obstacle.t : 1)};
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

std::vector<Ray> shadow_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits) {
  const Lights lights(context.scene, context.surfaces, default_light(context));
  return successors(
      context.surfaces, rays, hits, [&](std::uint32_t number, const SurfacePoint& point, const Vec3& incoming) {
        Random random = sample_random(context.settings.seed, RandomUse::light, number);
        return shadow_ray(point, incoming, lights.sample(point.position, facing(point.normal, incoming), random));
      });
}

std::vector<Ray> ao_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits) {
  return successors(context.surfaces, rays, hits,
                    [&](std::uint32_t number, const SurfacePoint& point, const Vec3& incoming) {
                      Random random = sample_random(context.settings.seed, RandomUse::ao, number);
                      return ao_ray(point, incoming, context.settings.ao_radius, random);
                    });
}

std::vector<Ray> diffuse_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                              std::uint32_t bounce) {
  return successors(context.surfaces, rays, hits,
                    [&](std::uint32_t number, const SurfacePoint& point, const Vec3& incoming) {
                      Random random = sample_random(context.settings.seed, RandomUse::diffuse, number, 0, bounce);
                      return diffuse_ray(point, incoming, random);
                    });
}

}  // namespace boxwood
