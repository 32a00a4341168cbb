// What primary rays cost: red primitive tests, green steps (inner nodes visited), both on one linear scale.
#include <algorithm>

#include "render/integrators.h"

namespace boxwood {
namespace {

void shade_heatmap(const ShadingContext&, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance) {
  std::vector<Hit> hits(batch.rays.size());
  std::vector<RayCounters> counters(batch.rays.size());
  tracer.closest_hits_counted("primary", batch.rays, hits, counters);
  std::ranges::transform(counters, radiance.begin(), [](const RayCounters& counted) {
    return Vec3{static_cast<float>(counted.primitive_tests), static_cast<float>(counted.steps), 0};
  });
}

void develop(const RenderSettings& settings, RenderResult& result) {
  result.counts = result.image;
  result.heatmap_scale = settings.heatmap_scale;
  if (result.heatmap_scale == 0) {
    for (const Vec3& pixel : result.counts.pixels) {
      result.heatmap_scale = std::max({result.heatmap_scale, pixel.x, pixel.y});
    }
  }
  if (result.heatmap_scale == 0) return;
  for (Vec3& pixel : result.image.pixels) pixel = pixel / result.heatmap_scale;
}

}  // namespace

Integrator heatmap_integrator() {
  return {"heatmap", "what primary rays cost: red primitive tests, green inner nodes visited", shade_heatmap, develop};
}

}  // namespace boxwood
