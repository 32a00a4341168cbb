#include "render/render.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "render/camera_rays.h"
#include "render/integrator.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

constexpr std::size_t pixels_per_block = 1024;   // what one task renders
constexpr std::uint32_t samples_per_batch = 16;  // bounds the memory of a batch to a few MB

void check_not_negative(float value, const char* name) {
  if (!(value >= 0 && std::isfinite(value))) throw UsageError(fmt::format("{} must be 0 or more, not {}", name, value));
}

/// Mean radiance of each pixel of a block, batch by batch, samples summed in their order.
void render_block(const Integrator& integrator, const ShadingContext& context, const CameraRays& camera,
                  std::span<const std::uint32_t> pixels, Tracer& tracer, Image& image) {
  const std::uint32_t spp = context.settings.spp;
  std::vector<Ray> rays;
  std::vector<SampleKey> keys;
  std::vector<Vec3> radiance;
  for (std::uint32_t first = 0; first < spp; first += samples_per_batch) {
    const std::uint32_t count = std::min(samples_per_batch, spp - first);
    rays.clear();
    keys.clear();
    for (const std::uint32_t pixel : pixels) {
      for (std::uint32_t sample = first; sample < first + count; ++sample) {
        rays.push_back(camera.ray(pixel, sample));
        keys.push_back({pixel, sample});
      }
    }
    radiance.assign(rays.size(), {});
    integrator.shade(context, {rays, keys}, tracer, radiance);
    for (std::size_t i = 0; i < keys.size(); ++i) image.pixels[keys[i].pixel] += radiance[i];
  }
  for (const std::uint32_t pixel : pixels) image.pixels[pixel] = image.pixels[pixel] / static_cast<float>(spp);
}

}  // namespace

RenderResult render(const Scene& scene, const Structure& structure, const RenderSettings& asked,
                    ProgressSink* progress) {
  RenderSettings settings = asked;
  check_not_negative(settings.ao_radius, "ao_radius");
  check_not_negative(settings.heatmap_scale, "heatmap_scale");
  const Integrator& integrator = find_integrator(settings.integrator);
  const CameraRays camera(settings.camera, settings.width, settings.height, settings.spp, settings.seed);
  if (settings.ao_radius == 0) settings.ao_radius = default_ao_radius(scene.bounds());
  const Surfaces surfaces(scene);
  Light white_sky;
  white_sky.kind = LightKind::sky;
  const Lights lights(scene, surfaces, white_sky);
  const LightRig rig = make_light_rig(settings.lights, scene, structure, surfaces, settings.camera);
  const ShadingContext context{scene, surfaces, lights, rig, settings};

  RenderResult result;
  result.image = Image(settings.width, settings.height);
  const std::vector<std::uint32_t> pixels = pixels_in_tiles(settings.width, settings.height);
  const std::size_t blocks = (pixels.size() + pixels_per_block - 1) / pixels_per_block;
  std::vector<Tracer> tracers(blocks, Tracer(structure));
  std::mutex progress_mutex;
  std::size_t blocks_done = 0;
  report_progress(progress, 0, "rendering");
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t first = block * pixels_per_block;
    const auto part = std::span(pixels).subspan(first, std::min(pixels_per_block, pixels.size() - first));
    render_block(integrator, context, camera, part, tracers[block], result.image);
    const std::lock_guard lock(progress_mutex);
    report_progress(progress, static_cast<double>(++blocks_done) / static_cast<double>(blocks), "rendering");
  });

  for (const Tracer& tracer : tracers) {
    for (const RayKindReport& report : tracer.reports()) add_report(result.ray_kinds, report);
  }
  if (integrator.develop) integrator.develop(settings, result);
  return result;
}

}  // namespace boxwood
