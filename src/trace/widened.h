#pragma once
#include "boxwood/precise.h"
#include "boxwood/ray.h"

namespace boxwood {

inline DoubleVec3 widened(const Vec3& v) { return {v.x, v.y, v.z}; }
inline PreciseRay widened(const Ray& ray) {
  return {widened(ray.origin), ray.t_near, widened(ray.direction), ray.t_far};
}

/// As the hit of a mesh that stands alone.
inline Hit rounded(const PreciseHit& hit) {
  if (!hit.valid()) return {};
  return {static_cast<float>(hit.t), static_cast<float>(hit.u), static_cast<float>(hit.v), hit.primitive, 0};
}

}  // namespace boxwood
