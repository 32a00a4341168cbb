#pragma once
#include "boxwood/structure.h"

namespace boxwood {

/// from + way, or, where something is between (a ceiling, a wall), most of the way to it: where a light can be put
/// that is to shine on what is seen from `from`.
inline Vec3 clear_end(const Structure& structure, const Vec3& from, const Vec3& way) {
  Ray ray;
  ray.origin = from;
  ray.direction = way;
  ray.t_far = 1;
  const Hit obstacle = structure.closest_hit(ray);
  return from + way * (obstacle.valid() ? 0.8f * obstacle.t : 1);
}

}  // namespace boxwood
