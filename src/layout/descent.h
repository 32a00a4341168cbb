#pragma once
#include <cstdint>

#include "boxwood/ray.h"

namespace boxwood {

/// What a ray brings along on its way down into a level.
struct Descent {
  std::uint32_t first_instance = 0;  ///< the number of the level's first instance; of a level of triangles, its own
  std::uint32_t mask = every_bit;    ///< the ray's
};

}  // namespace boxwood
