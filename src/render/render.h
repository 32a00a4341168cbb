#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/ray_set.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "render/image.h"
#include "render/progress.h"

namespace boxwood {

/// When rays that follow from others are traced: all of one kind together, or as soon as 16 camera rays have hit.
enum class SecondaryRays { queued, immediate };

struct RenderSettings {
  Camera camera;
  std::uint32_t width = 512, height = 512;          ///< pixels, at least 1
  std::uint32_t spp = 1;                            ///< samples per pixel, at least 1; 1 goes through the pixel centre
  std::string integrator = "eyelight";              ///< a name of integrators()
  std::uint32_t depth = 8;                          ///< path, whitted: most bounces of a path; 0: none
  std::string lights = "scene";                     ///< whitted: a name of light_settings()
  SecondaryRays secondary = SecondaryRays::queued;  ///< whitted; the picture is the same
  float ao_radius = 0;                              ///< world units; 0: a tenth of the scene's diagonal
  float heatmap_scale = 0;  ///< tests per ray shown at full brightness; 0: the most that any pixel has
  std::uint64_t seed = 1;
};

/// What the rays of one kind cost a rendering.
struct RayKindReport {
  std::string kind;  ///< "primary", "ao", "shadow", "diffuse1", "reflection", …
  Query query = Query::closest_hit;
  std::uint64_t rays = 0;    ///< traced
  std::uint64_t hits = 0;    ///< of those, how many hit something
  double trace_seconds = 0;  ///< CPU time spent inside the structure, summed over threads
};

struct RenderResult {
  Image image;  ///< what to look at
  /// Heat maps only: mean tests per ray of each pixel, red primitive tests, green steps (inner nodes visited).
  Image counts;
  float heatmap_scale = 0;               ///< heat maps only: the scale that was used
  std::vector<RayKindReport> ray_kinds;  ///< in order of first use
};

/// Renders in parallel tiles. The image depends on the scene and the settings only, to the last bit: not on the number
/// of threads, and not on which structure traces (heat maps excepted, which show it). A scene without lights has a
/// white sky. Runs in the caller's TBB arena. Throws UsageError on bad settings, Cancelled when `progress` asks for it.
RenderResult render(const Scene& scene, const Structure& structure, const RenderSettings& settings,
                    ProgressSink* progress = nullptr);

}  // namespace boxwood
