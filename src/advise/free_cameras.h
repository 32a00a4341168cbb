#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/scene.h"
#include "boxwood/structure.h"

namespace boxwood {

/// Up to `count` cameras in the free space of a scene, far from each other, each looking where there is much to see at
/// a distance: points of the scene's box that are not close to a surface and do not lie inside something closed (most
/// of what they see are backs). Scenes that are seen from outside get none, or few. The same for the same seed.
/// O(samples).
std::vector<Camera> free_cameras(const Scene& scene, const Structure& structure, std::uint32_t count,
                                 std::uint64_t seed = 1);

}  // namespace boxwood
