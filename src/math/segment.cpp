#include "math/segment.h"

#include <cmath>

namespace boxwood {

Segment::Segment(const Ray& ray, float end)
    : origin_{ray.origin.x, ray.origin.y, ray.origin.z, ray.t_near}, inverse_{0, 0, 0, end} {
  constexpr float least = 1e-30f;  // keeps the inverse finite: products with it are never 0 * infinity
  for (int axis = 0; axis < 3; ++axis) {
    const float d = ray.direction[static_cast<std::size_t>(axis)];
    inverse_[axis] = 1 / (std::fabs(d) < least ? std::copysign(least, d) : d);
  }
}

}  // namespace boxwood
