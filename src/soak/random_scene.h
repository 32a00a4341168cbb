#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"
#include "math/random.h"

namespace boxwood {

/// A small scene of a random kind of trouble: soups, grids, slivers, copies, flat and empty ones, vertices of arbitrary
/// bits; at a random scale and place; sometimes several meshes under random transforms. Its name says which.
Scene random_scene(Random& random);

/// Rays of mixed kinds: anywhere, at vertices, along edges, along axes within faces, with zero, tiny and huge
/// components, limited ranges, and some of arbitrary bits.
std::vector<Ray> random_rays_at(const Scene& scene, std::uint32_t count, Random& random);

/// Any of the 2^32 floats: NaN, infinities and denormals as often as others.
float arbitrary_float(Random& random);

}  // namespace boxwood
