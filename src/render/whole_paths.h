#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boxwood/ray_set.h"

namespace boxwood {

/// Rays as the path tracer of the SAH alternatives study traces them (its section 1.3), where make_ray_sets() takes the
/// camera's hits only: shadow and ao rays start where the camera's rays and every bounce hit, a shadow ray goes to
/// every light, and bounces are uniform over the hemisphere. In a closed room a path has 1 + bounces closest-hit rays,
/// (1 + bounces) * lights shadow rays and (1 + bounces) * ao_rays ao rays.
struct WholePaths {
  std::uint32_t ao_rays = 3;  ///< from each point, at least 1
};

/// As make_ray_sets(), of whole paths. Every light is one that has a place or a direction; a scene that is lit
/// otherwise (sky, surfaces) gets one shadow ray from each point, to a place picked at random.
std::vector<RaySet> make_path_sets(const Scene& scene, const Structure& structure, const RaySetSettings& settings,
                                   const WholePaths& paths, std::span<const std::string> kinds);

/// As expect_view(), of whole paths.
ExpectedUse expect_paths(const Scene& scene, const RaySetSettings& settings, const WholePaths& paths);

}  // namespace boxwood
