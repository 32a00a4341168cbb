#include "render/secondary_rays.h"

#include "math/sampling.h"

namespace boxwood {

Ray diffuse_ray(const SurfacePoint& point, const Vec3& incoming, Random& random) {
  const float u = random.uniform(), v = random.uniform();
  Ray ray;
  ray.origin = origin_off(point, incoming);
  ray.direction = Basis(facing(point.normal, incoming)).around_normal(cosine_hemisphere(u, v));
  return ray;
}

Ray ao_ray(const SurfacePoint& point, const Vec3& incoming, float radius, Random& random) {
  Ray ray = diffuse_ray(point, incoming, random);
  ray.t_far = radius;
  return ray;
}

Ray shadow_ray(const SurfacePoint& point, const Vec3& incoming, const LightSample& light) {
  Ray ray;
  ray.origin = origin_off(point, incoming);
  ray.direction = light.far_away ? light.target : light.target - ray.origin;
  if (!light.far_away) ray.t_far = 0.9999f;
  return ray;
}

float default_ao_radius(const Box& scene) { return scene.empty() ? 0 : 0.1f * length(scene.extent()); }

}  // namespace boxwood
