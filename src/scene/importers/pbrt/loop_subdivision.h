#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood::pbrt {

/// `levels` steps of Loop's subdivision (Loop 1987, with the vertex weights of Warren 1995), vertices then moved to the
/// limit surface. Edges with one triangle or more than two are borders: their curve depends on the border only. Every
/// index must be in range. O(4^levels triangles).
Mesh subdivide(Mesh mesh, std::uint32_t levels);

}  // namespace boxwood::pbrt
