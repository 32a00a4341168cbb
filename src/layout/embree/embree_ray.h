#pragma once
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>

#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood {

/// Ray's limits, as the kernels of our own see them.
inline bool is_within_limits(const Ray& ray) {
  const auto size = [](const Vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); };
  return is_finite(ray.origin) && is_finite(ray.direction) && size(ray.origin) <= largest_coordinate &&
         size(ray.direction) <= largest_coordinate && size(ray.direction) >= 1 / largest_coordinate &&
         ray.t_near <= ray.t_far;
}

/// Embree wants t_near >= 0 and takes a negative t_far for a hit; invalid rays become ones that cannot hit.
inline RTCRay to_embree(const Ray& ray) {
  const bool valid = is_within_limits(ray) && ray.t_far >= 0;
  RTCRay out{};
  out.org_x = valid ? ray.origin.x : 0, out.org_y = valid ? ray.origin.y : 0, out.org_z = valid ? ray.origin.z : 0;
  out.dir_x = valid ? ray.direction.x : 1, out.dir_y = valid ? ray.direction.y : 0;
  out.dir_z = valid ? ray.direction.z : 0;
  out.tnear = valid ? std::max(ray.t_near, 0.0f) : 1;
  out.tfar = valid ? ray.t_far : 0;
  out.mask = 0xffffffffu;
  return out;
}

inline RTCRayHit to_query(const Ray& ray) {
  RTCRayHit query{};
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

inline RTCIntersectContext incoherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return context;
}

}  // namespace boxwood
