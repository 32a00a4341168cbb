// The triangle's unit normal, each component from [-1, 1] to [0, 1]. Background black.
#include "render/integrators.h"

namespace boxwood {
namespace {

void shade_normals(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance) {
  std::vector<Hit> hits(batch.rays.size());
  tracer.closest_hits("primary", batch.rays, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    radiance[i] = {};
    if (hits[i].valid()) radiance[i] = (context.surfaces.at(hits[i]).normal + Vec3{1, 1, 1}) * 0.5f;
  }
}

}  // namespace

Integrator normals_integrator() {
  return {"normals", "the normal of the triangle seen, as a colour", shade_normals, nullptr};
}

}  // namespace boxwood
