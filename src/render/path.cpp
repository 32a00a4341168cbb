// Unidirectional path tracing (Kajiya 1986) with next event estimation, multiple importance sampling by the power
// heuristic (Veach and Guibas 1995) and Russian roulette. Wavefront: all paths of a batch take a step together, and the
// rays that left one kind of surface are traced in one call, as are all shadow rays.
#include <algorithm>
#include <array>
#include <string>

#include "render/integrators.h"
#include "render/sample_random.h"
#include "render/scattering.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

constexpr std::uint32_t bounces_before_roulette = 3;
constexpr float largest_survival = 0.95f;

/// What a path carries from one hit to the next.
struct Path {
  std::uint32_t owner = 0;   ///< camera ray that it belongs to
  Vec3 throughput{1, 1, 1};  ///< factor for light that it finds
  float density = 0;         ///< with which its direction was picked; 0 at the camera and after mirrors
  Vec3 normal;               ///< of the surface that it left
};

/// Rays of one kind that are traced together, and the paths that they continue.
struct Queue {
  std::vector<Ray> rays;
  std::vector<Path> paths;
};

/// Shadow rays and what arrives where they are not blocked.
struct ShadowQueue {
  std::vector<Ray> rays;
  std::vector<Vec3> light;
  std::vector<std::uint32_t> owners;
};

/// Weight of a sample taken with density `used` that `other` might have found too (power heuristic). A density of 0
/// means that it could not.
float importance(float used, float other) {
  if (other == 0) return 1;
  const float ratio = other / used;
  return 1 / (1 + ratio * ratio);
}

std::string kind_of(Lobe lobe, std::uint32_t bounce) {
  constexpr std::array<std::string_view, lobe_count> names = {"diffuse", "glossy", "reflection", "refraction"};
  const std::string name(names[static_cast<std::size_t>(lobe)]);
  return lobe == Lobe::diffuse ? name + std::to_string(bounce) : name;
}

/// Follows the paths of one batch.
class PathTracer {
 public:
  PathTracer(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance)
      : context_(context), batch_(batch), tracer_(tracer), radiance_(radiance) {}

  void run() {
    Queue camera;
    camera.rays.assign(batch_.rays.begin(), batch_.rays.end());
    camera.paths.resize(camera.rays.size());
    for (std::uint32_t i = 0; i < camera.paths.size(); ++i) camera.paths[i].owner = i;
    std::ranges::fill(radiance_, Vec3{});
    follow("primary", camera, 0);
    for (std::uint32_t bounce = 1; bounce <= context_.settings.depth; ++bounce) {
      std::array<Queue, lobe_count> arrived;
      std::swap(arrived, next_);
      for (std::size_t lobe = 0; lobe < lobe_count; ++lobe) {
        if (arrived[lobe].rays.empty()) continue;
        follow(kind_of(static_cast<Lobe>(lobe), bounce), arrived[lobe], bounce);
      }
    }
  }

 private:
  /// Traces rays that have bounced `bounce` times, adds the light that they find, and queues where they go on.
  void follow(const std::string& kind, const Queue& queue, std::uint32_t bounce) {
    std::vector<Hit> hits(queue.rays.size());
    tracer_.closest_hits(kind, queue.rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Path& path = queue.paths[i];
      const Ray& ray = queue.rays[i];
      if (!hits[i].valid()) {
        add_sky(path, ray);
        continue;
      }
      const SurfacePoint point = context_.surfaces.at(hits[i]);
      add_emission(path, ray, point, hits[i].t);
      if (bounce >= context_.settings.depth) continue;
      const SampleKey& key = batch_.keys[path.owner];
      Random random = sample_random(context_.settings.seed, RandomUse::path, key.pixel, key.sample, bounce);
      const Scattering scattering(point, ray.direction);
      if (scattering.spreads_light()) queue_shadow_ray(path, ray, point, scattering, random);
      go_on(path, ray, point, scattering, bounce, random);
    }
    trace_shadow_rays();
  }

  void add_sky(const Path& path, const Ray& ray) {
    const float other = path.density > 0 ? context_.lights.sky_density(path.normal, ray.direction) : 0;
    radiance_[path.owner] += path.throughput * context_.lights.sky() * importance(path.density, other);
  }

  void add_emission(const Path& path, const Ray& ray, const SurfacePoint& point, float distance) {
    const Vec3 emission = Lights::emission(point, ray.direction);
    if (emission == Vec3{}) return;
    const float other = path.density > 0 ? context_.lights.surface_density(point, ray.direction, distance) : 0;
    radiance_[path.owner] += path.throughput * emission * importance(path.density, other);
  }

  void queue_shadow_ray(const Path& path, const Ray& ray, const SurfacePoint& point, const Scattering& scattering,
                        Random& random) {
    const LightSample sample = context_.lights.sample(point.position, scattering.normal(), random);
    const Vec3 share = scattering.evaluate(sample.direction);
    const float other = sample.density > 0 ? scattering.density(sample.direction) : 0;
    const Vec3 light = path.throughput * share * sample.light * importance(sample.density, other);
    if (!(std::max({light.x, light.y, light.z}) > 0)) return;
    shadows_.rays.push_back(shadow_ray(point, ray.direction, sample));
    shadows_.light.push_back(light);
    shadows_.owners.push_back(path.owner);
  }

  void trace_shadow_rays() {
    if (shadows_.rays.empty()) return;
    std::vector<std::uint8_t> blocked(shadows_.rays.size());
    tracer_.any_hits("shadow", shadows_.rays, blocked);
    for (std::size_t i = 0; i < blocked.size(); ++i) {
      if (!blocked[i]) radiance_[shadows_.owners[i]] += shadows_.light[i];
    }
    shadows_ = {};
  }

  void go_on(const Path& path, const Ray& ray, const SurfacePoint& point, const Scattering& scattering,
             std::uint32_t bounce, Random& random) {
    Path longer = path;
    const ScatteredRay scattered = scattering.sample(random);
    longer.throughput = path.throughput * scattered.weight;
    longer.density = scattered.density;
    longer.normal = scattering.normal();
    const float most = std::max({longer.throughput.x, longer.throughput.y, longer.throughput.z});
    if (!(most > 0)) return;
    if (bounce >= bounces_before_roulette) {
      const float survival = std::min(most, largest_survival);
      if (random.uniform() >= survival) return;
      longer.throughput = longer.throughput / survival;
    }
    const Vec3 side = scattered.lobe == Lobe::refraction ? -ray.direction : ray.direction;
    Queue& queue = next_[static_cast<std::size_t>(scattered.lobe)];
    queue.rays.push_back({.origin = origin_off(point, side), .direction = scattered.direction});
    queue.paths.push_back(longer);
  }

  const ShadingContext& context_;
  const CameraBatch& batch_;
  Tracer& tracer_;
  std::span<Vec3> radiance_;
  std::array<Queue, lobe_count> next_;
  ShadowQueue shadows_;
};

void shade_path(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance) {
  PathTracer(context, batch, tracer, radiance).run();
}

}  // namespace

Integrator path_integrator() {
  return {"path", "path tracing: all light that reaches the camera, over up to 'depth' bounces", shade_path, nullptr,
          true};
}

}  // namespace boxwood
