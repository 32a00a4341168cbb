// The one ray-triangle test. Watertight: after Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", with
// exact signs from Kahan's difference of products instead of their fallback to double. Compiled once per instruction
// set.
#if defined(BOXWOOD_TRACE_TRIANGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_TRACE_TRIANGLE_INL_H
#undef BOXWOOD_TRACE_TRIANGLE_INL_H
#else
#define BOXWOOD_TRACE_TRIANGLE_INL_H
#endif

#include "trace/leaf_triangle.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// a*b - c*d, within 1.5 units in the last place, hence with an exact sign (Jeannerod, Louvet, Muller 2013).
template <class Real>
HWY_INLINE Real difference_of_products(Real a, Real b, Real c, Real d) {
  const Real cd = c * d;
  const Real error = fused(-c, d, cd);
  return fused(a, b, -cd) + error;
}

/// Hit of one triangle: t = weighted z of the sheared vertices. Every SIMD form must compute exactly these expressions.
template <class Real>
struct TriangleHitOf {
  Real t, v, w, determinant;  // barycentric u = v / determinant, v = w / determinant (weights of vertices 1 and 2)
};
using TriangleHit = TriangleHitOf<float>;

/// Projected areas below this are too near to the smallest normal float for t to be trusted: such a triangle is seen
/// edge-on, or its sides are below 1e-15.
inline constexpr float least_determinant = 0x1p-100f;
template <class Real>
inline constexpr Real least_determinant_of = least_determinant;
/// Likewise; sides below 1e-144.
template <>
inline constexpr double least_determinant_of<double> = 0x1p-960;

/// Two-sided. Edges and vertices belong to every triangle that has them, so a ray can not slip between two triangles
/// that share them. Triangles seen edge-on are missed; their neighbours are not. The range of t is the caller's to
/// check, with comparisons that NaN fails. `ShearedRay` is a PreparedRay, or a PreciseSheared with points in double.
template <class Point, class ShearedRay, class Real>
HWY_INLINE bool hit_triangle(const Point& a, const Point& b, const Point& c, const ShearedRay& ray,
                             TriangleHitOf<Real>& hit) {
  const int kx = ray.kx, ky = ray.ky, kz = ray.kz;
  const Real az = a[kz] - ray.origin[kz], bz = b[kz] - ray.origin[kz], cz = c[kz] - ray.origin[kz];
  const Real ax = fused(-ray.shear_x, az, a[kx] - ray.origin[kx]);
  const Real ay = fused(-ray.shear_y, az, a[ky] - ray.origin[ky]);
  const Real bx = fused(-ray.shear_x, bz, b[kx] - ray.origin[kx]);
  const Real by = fused(-ray.shear_y, bz, b[ky] - ray.origin[ky]);
  const Real cx = fused(-ray.shear_x, cz, c[kx] - ray.origin[kx]);
  const Real cy = fused(-ray.shear_y, cz, c[ky] - ray.origin[ky]);

  const Real u = difference_of_products(cx, by, cy, bx);
  const Real v = difference_of_products(ax, cy, ay, cx);
  const Real w = difference_of_products(bx, ay, by, ax);
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  const Real determinant = (u + v) + w;
  if (std::fabs(determinant) < least_determinant_of<Real>) return false;

  const Real z = fused(u, az, fused(v, bz, w * cz));
  hit = {(z / determinant) * ray.scale_z, v, w, determinant};
  return true;
}

/// The order in which hits win: smaller t, then smaller instance, then smaller primitive.
HWY_INLINE bool wins(float t, std::uint32_t instance, std::uint32_t primitive, const Hit& best) {
  if (t != best.t) return t < best.t;
  return instance != best.instance ? instance < best.instance : primitive < best.primitive;
}

/// Replaces `best` if the triangle is hit within [ray.t_near, ray.t_far] and wins. A missing `best` has t infinite.
HWY_INLINE bool closest_of(const LeafTriangle& triangle, const PreparedRay& ray, std::uint32_t instance, Hit& best) {
  TriangleHit hit;
  if (!hit_triangle(triangle.a, triangle.b, triangle.c, ray, hit)) return false;
  if (!(hit.t >= ray.t_near && hit.t <= ray.t_far && wins(hit.t, instance, triangle.primitive, best))) return false;
  best = {hit.t, hit.v / hit.determinant, hit.w / hit.determinant, triangle.primitive, instance};
  return true;
}

HWY_INLINE bool blocks(const LeafTriangle& triangle, const PreparedRay& ray) {
  TriangleHit hit;
  return hit_triangle(triangle.a, triangle.b, triangle.c, ray, hit) && hit.t >= ray.t_near && hit.t <= ray.t_far;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
