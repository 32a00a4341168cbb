#pragma once
#include <algorithm>
#include <cmath>

#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood::test {

/// Whether a ray is within the limits of Ray.
inline bool is_valid(const Ray& ray) {
  float longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(std::fabs(ray.direction[axis]) <= largest_coordinate)) return false;
    if (!(std::fabs(ray.origin[axis]) <= largest_coordinate)) return false;
    longest = std::max(longest, std::fabs(ray.direction[axis]));
  }
  return longest >= 1 / largest_coordinate && ray.t_near <= ray.t_far;
}

}  // namespace boxwood::test
