// Ambient occlusion: white where a cosine-distributed ray of limited length leaves freely, black where it is blocked.
// One such ray per camera ray. Background white, since nothing is in its way.
#include "render/integrators.h"
#include "render/sample_random.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

void shade_ao(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance) {
  std::vector<Hit> hits(batch.rays.size());
  tracer.closest_hits("primary", batch.rays, hits);

  std::vector<Ray> rays;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    radiance[i] = {1, 1, 1};
    if (!hits[i].valid()) continue;
    Random random = sample_random(context.settings.seed, RandomUse::ao, batch.keys[i].pixel, batch.keys[i].sample);
    rays.push_back(ao_ray(context.surfaces.at(hits[i]), batch.rays[i].direction, context.settings.ao_radius, random));
    owners.push_back(i);
  }

  std::vector<std::uint8_t> blocked(rays.size());
  tracer.any_hits("ao", rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (blocked[i]) radiance[owners[i]] = {};
  }
}

}  // namespace

Integrator ao_integrator() {
  return {"ao", "ambient occlusion within a radius, one ray per sample", shade_ao, nullptr};
}

}  // namespace boxwood
