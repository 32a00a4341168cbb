// A ray in double precision, with what the triangle test needs. Compiled once per instruction set.
#if defined(BOXWOOD_TRACE_PRECISE_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_TRACE_PRECISE_RAY_INL_H
#undef BOXWOOD_TRACE_PRECISE_RAY_INL_H
#else
#define BOXWOOD_TRACE_PRECISE_RAY_INL_H
#endif

#include <cmath>

#include "boxwood/precise.h"
#include "trace/precise_triangle.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// The ray's own space, as in PreparedRay.
struct PreciseSheared {
  double origin[3];
  int kx, ky, kz;
  double shear_x, shear_y, scale_z;
  double t_near, t_far;
};

HWY_INLINE double largest_of(const DoubleVec3& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

HWY_INLINE bool within_limits(const PreciseRay& ray) {
  constexpr double limit = largest_double_coordinate;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(std::fabs(ray.origin[axis]) <= limit && std::fabs(ray.direction[axis]) <= limit)) return false;
  }
  return largest_of(ray.direction) >= 1 / limit && ray.t_near <= ray.t_far;
}

/// Of a ray within limits.
HWY_INLINE PreciseSheared shear(const PreciseRay& ray) {
  const DoubleVec3& d = ray.direction;
  PreciseSheared out;
  const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  out.kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  out.kx = out.kz == 2 ? 0 : out.kz + 1;
  out.ky = out.kx == 2 ? 0 : out.kx + 1;
  const double dominant = d[out.kz];
  out.shear_x = d[out.kx] / dominant;
  out.shear_y = d[out.ky] / dominant;
  out.scale_z = 1 / dominant;
  for (std::size_t axis = 0; axis < 3; ++axis) out.origin[axis] = ray.origin[axis];
  out.t_near = ray.t_near;
  out.t_far = ray.t_far;
  return out;
}

/// Replaces `best` if the triangle is hit within the ray's range and wins: by smaller t, then smaller primitive.
HWY_INLINE bool closest_of(const PreciseTriangle& triangle, const PreciseSheared& ray, PreciseHit& best) {
  TriangleHitOf<double> hit;
  if (!hit_triangle(triangle.a, triangle.b, triangle.c, ray, hit)) return false;
  if (!(hit.t >= ray.t_near && hit.t <= ray.t_far)) return false;
  if (!(hit.t < best.t || (hit.t == best.t && triangle.primitive < best.primitive))) return false;
  best = {hit.t, hit.v / hit.determinant, hit.w / hit.determinant, triangle.primitive};
  return true;
}

HWY_INLINE bool blocks(const PreciseTriangle& triangle, const PreciseSheared& ray) {
  TriangleHitOf<double> hit;
  return hit_triangle(triangle.a, triangle.b, triangle.c, ray, hit) && hit.t >= ray.t_near && hit.t <= ray.t_far;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
