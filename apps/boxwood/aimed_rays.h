#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood::cli {

/// Rays from around the scene at its weakest places: points on edges and vertices of random triangles. Empty for an
/// empty scene.
std::vector<Ray> rays_at_edges(const Scene& scene, std::uint32_t count, std::uint64_t seed);

/// Rays that start inside closed meshes and aim at their edges and vertices, so that each must hit something.
struct InsideRays {
  std::uint64_t closed_meshes = 0;  ///< meshes whose every edge is used as often in one direction as in the other
  std::vector<Ray> rays;            ///< empty when no mesh is closed, or nothing was found to be inside one
};

/// At most `count` rays. A point is inside when its winding number is not zero; this search costs O(triangles) each and
/// is bounded.
InsideRays rays_from_inside(const Scene& scene, std::uint32_t count, std::uint64_t seed);

}  // namespace boxwood::cli
