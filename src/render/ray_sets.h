#pragma once
#include <span>
#include <vector>

#include "boxwood/ray_set.h"
#include "render/surface.h"
#include "render/whole_paths.h"

namespace boxwood {

/// What the makers of ray sets share. `settings.ao_radius` is resolved to world units here.
struct RaySetContext {
  const Scene& scene;
  const Structure& structure;
  const RaySetSettings& settings;
  const Surfaces& surfaces;
  Box bounds;
  const WholePaths* whole = nullptr;  ///< null: shadow and ao rays from the camera's hits only, one each
};

/// Leaves about `most` rays, or all if they are fewer: whole runs of `run` rays, so that they stay as coherent as they
/// are, from all over the set.
void keep_spread_runs(std::vector<Ray>& rays, std::size_t run, std::size_t most);

/// Closest hits of `rays`, in parallel.
std::vector<Hit> trace(const Structure& structure, std::span<const Ray> rays);

// Sets that follow the camera's rays, in tile order; rays that hit nothing have no successor.

std::vector<Ray> primary_rays(const RaySetContext& context);
/// `depth`: bounces before the hits.
std::vector<Ray> shadow_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                             std::uint32_t depth);
std::vector<Ray> ao_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                         std::uint32_t depth);
/// `bounce` counts from 1.
std::vector<Ray> diffuse_rays(const RaySetContext& context, std::span<const Ray> rays, std::span<const Hit> hits,
                              std::uint32_t bounce);

/// Most bounces of the paths whose rays are the set "path".
inline constexpr std::uint32_t path_set_depth = 20;

/// All closest-hit rays of a path tracer with one path through each pixel and at most path_set_depth bounces, blocks of
/// pixels one after the other, in each bounce by bounce.
std::vector<Ray> path_rays(const RaySetContext& context);

// Sets of settings.random_rays rays that know the scene only; none when the scene is empty.

/// Uniform origins in the scene's box, uniform directions.
std::vector<Ray> random_rays(const RaySetContext& context);
/// Uniform origins in the scene's box, along one axis; the other components are 0 or -0.
std::vector<Ray> axis_rays(const RaySetContext& context);
/// From just off random triangles, all equally likely, within 0.01 radians of their plane, to either side of it.
std::vector<Ray> grazing_rays(const RaySetContext& context);

}  // namespace boxwood
