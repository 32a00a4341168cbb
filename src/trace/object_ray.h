#pragma once
#include "boxwood/ray.h"
#include "boxwood/transform.h"

namespace boxwood {

/// The ray as an instance sees it. Its direction is not normalised again, so t means the same on both sides.
inline Ray object_ray(const Transform& world_to_object, const Ray& ray) {
  return {world_to_object.point(ray.origin), ray.t_near, world_to_object.vector(ray.direction), ray.t_far};
}

}  // namespace boxwood
