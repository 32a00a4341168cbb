#pragma once
#include <cstdint>

#include "boxwood/vec3.h"

namespace boxwood {

/// A triangle copied into leaf order. 40 bytes: three vertices, then its number in the mesh.
struct LeafTriangle {
  Vec3 a, b, c;
  std::uint32_t primitive = 0;
};
static_assert(sizeof(LeafTriangle) == 40);

}  // namespace boxwood
