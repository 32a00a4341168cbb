// The rays of a path tracer, as a set: what a renderer asks of a structure when it is not told apart by bounce.
#include <tbb/parallel_for.h>

#include "render/camera_rays.h"
#include "render/integrators.h"
#include "render/lights.h"
#include "render/ray_sets.h"

namespace boxwood {
namespace {

constexpr std::size_t pixels_per_path_block = 1024;

}  // namespace

std::vector<Ray> path_rays(const RaySetContext& context) {
  const RaySetSettings& settings = context.settings;
  RenderSettings render;
  render.camera = settings.camera;
  render.width = settings.width;
  render.height = settings.height;
  render.seed = settings.seed;
  render.depth = path_set_depth;
  Light white_sky;
  white_sky.kind = LightKind::sky;
  const Lights lights(context.scene, context.surfaces, white_sky);
  const ShadingContext shading{context.scene, context.surfaces, lights, {}, render};
  const CameraRays camera(settings.camera, settings.width, settings.height, 1, settings.seed);
  const std::vector<std::uint32_t> pixels =
      pixels_in_blocks(settings.width, settings.height, settings.block, settings.seed);

  const std::size_t blocks = (pixels.size() + pixels_per_path_block - 1) / pixels_per_path_block;
  std::vector<std::vector<Ray>> traced(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t first = block * pixels_per_path_block;
    std::vector<Ray> rays;
    std::vector<SampleKey> keys;
    for (std::size_t i = first; i < std::min(pixels.size(), first + pixels_per_path_block); ++i) {
      rays.push_back(camera.ray(pixels[i], 0));
      keys.push_back({pixels[i], 0});
    }
    Tracer tracer(context.structure);
    tracer.record_closest(traced[block]);
    std::vector<Vec3> radiance(rays.size());
    path_integrator().shade(shading, {rays, keys}, tracer, radiance);
  });
  std::vector<Ray> all;
  for (const std::vector<Ray>& rays : traced) all.insert(all.end(), rays.begin(), rays.end());
  return all;
}

}  // namespace boxwood
