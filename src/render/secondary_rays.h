#pragma once
#include "boxwood/ray.h"
#include "math/random.h"
#include "render/lights.h"
#include "render/surface.h"

namespace boxwood {

/// A point off the surface, on the side that `incoming` came from, where a new ray can start without hitting the
/// surface it leaves.
constexpr Vec3 origin_off(const SurfacePoint& point, const Vec3& incoming) {
  return point.position + facing(point.normal, incoming) * point.clearance;
}

/// Cosine-distributed around the normal, on the side that `incoming` came from. Unit direction.
Ray diffuse_ray(const SurfacePoint& point, const Vec3& incoming, Random& random);

/// Like diffuse_ray, but ends after `radius` world units.
Ray ao_ray(const SurfacePoint& point, const Vec3& incoming, float radius, Random& random);

/// From the surface to just short of where `light` was sampled, where t counts in units of the distance between them,
/// or away in its direction.
Ray shadow_ray(const SurfacePoint& point, const Vec3& incoming, const LightSample& light);

/// Reach of ambient occlusion when none is asked for: a tenth of the scene's diagonal.
float default_ao_radius(const Box& scene);

}  // namespace boxwood
