// A light at the eye: the diffuse colour times the cosine between the view and the surface. Background black.
#include <cmath>

#include "render/integrators.h"

namespace boxwood {
namespace {

void shade_eyelight(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance) {
  std::vector<Hit> hits(batch.rays.size());
  tracer.closest_hits("primary", batch.rays, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    radiance[i] = {};
    if (!hits[i].valid()) continue;
    const SurfacePoint point = context.surfaces.at(hits[i]);
    radiance[i] = point.diffuse * std::fabs(dot(point.normal, batch.rays[i].direction));
  }
}

}  // namespace

Integrator eyelight_integrator() {
  return {"eyelight", "a light at the eye: colour times the cosine between view and surface", shade_eyelight, nullptr};
}

}  // namespace boxwood
