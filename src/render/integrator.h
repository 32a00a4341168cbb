#pragma once
#include <span>
#include <string_view>

#include "render/lights.h"
#include "render/render.h"
#include "render/surface.h"
#include "render/tracer.h"
#include "render/whitted/light_rig.h"

namespace boxwood {

/// What an integrator may look at besides its rays. `settings.ao_radius` is resolved to world units here.
struct ShadingContext {
  const Scene& scene;
  const Surfaces& surfaces;
  const Lights& lights;
  const LightRig& rig;  ///< of `settings.lights`
  const RenderSettings& settings;
};

/// Camera rays of one batch. sample_of[i] says which random numbers belong to ray i.
struct SampleKey {
  std::uint32_t pixel = 0;   ///< y * width + x
  std::uint32_t sample = 0;  ///< 0 … spp - 1
};
struct CameraBatch {
  std::span<const Ray> rays;
  std::span<const SampleKey> keys;
};

/// One way to turn camera rays into light. A new one is a file with a function and a line in integrators().
struct Integrator {
  std::string_view name;
  std::string_view summary;
  /// radiance[i] = what camera ray i sees. Rays of one kind are traced in one call. Thread safe.
  void (*shade)(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance);
  /// Turns pixel means into a picture, once, at the end; null when they are one already.
  void (*develop)(const RenderSettings& settings, RenderResult& result);
  /// Pixels are radiance, of any brightness: what shows them has to map their tones.
  bool radiance = false;
};

/// All integrators, in the order in which they are listed to users.
std::span<const Integrator> integrators();

/// Throws UsageError naming the valid ones.
const Integrator& find_integrator(std::string_view name);

}  // namespace boxwood
