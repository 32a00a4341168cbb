// The one ray-triangle test of trace/triangle-inl.h, expression by expression, on several triangles or rays at once.
#if defined(BOXWOOD_LAYOUT_SIMD_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_TRIANGLES_INL_H
#undef BOXWOOD_LAYOUT_SIMD_TRIANGLES_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_TRIANGLES_INL_H
#endif

#include "layout/simd/lanes-inl.h"
#include "layout/simd/wide_node.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// The part of a prepared ray that the triangle test reads, in every lane. Axes in the ray's own order: x, y, z stand
/// for kx, ky, kz, the dominant axis last.
template <class D>
struct ShearedRays {
  hn::Vec<D> origin_x, origin_y, origin_z;
  hn::Vec<D> shear_x, shear_y, scale_z;
};

/// The same of one ray, as it is kept.
struct TriangleRay {
  float origin[3], shear_x, shear_y, scale_z;
  std::uint32_t axes[3];
};

HWY_INLINE TriangleRay triangle_ray(const PreparedRay& ray) {
  return {{ray.origin[ray.kx], ray.origin[ray.ky], ray.origin[ray.kz]},
          ray.shear_x,
          ray.shear_y,
          ray.scale_z,
          {static_cast<std::uint32_t>(ray.kx), static_cast<std::uint32_t>(ray.ky), static_cast<std::uint32_t>(ray.kz)}};
}

template <class D>
HWY_INLINE ShearedRays<D> broadcast_sheared(D d, const TriangleRay& ray) {
  return {hn::Set(d, ray.origin[0]), hn::Set(d, ray.origin[1]), hn::Set(d, ray.origin[2]),
          hn::Set(d, ray.shear_x),   hn::Set(d, ray.shear_y),   hn::Set(d, ray.scale_z)};
}

/// One vertex per lane, in the ray's axis order.
template <class D>
struct Vertices {
  hn::Vec<D> x, y, z;
};

template <class D>
struct TriangleHits {
  hn::Mask<D> hit;  // inside the triangle; the range of t is not yet checked
  hn::Vec<D> t, v, w, determinant;
};

/// The numbers of TriangleHits in memory, a triangle per lane. Hits come as they like, and are taken lane by lane.
template <class D>
struct StoredHits {
  alignas(64) float t[lanes_of<D>], v[lanes_of<D>], w[lanes_of<D>], determinant[lanes_of<D>];

  HWY_INLINE void store(const TriangleHits<D>& hits) {
    const D d;
    hn::Store(hits.t, d, t);
    hn::Store(hits.v, d, v);
    hn::Store(hits.w, d, w);
    hn::Store(hits.determinant, d, determinant);
  }
  HWY_INLINE Hit hit(int lane, std::uint32_t primitive, std::uint32_t instance) const {
    return {t[lane], v[lane] / determinant[lane], w[lane] / determinant[lane], primitive, instance};
  }
};

template <class D, class V>
HWY_INLINE V difference_of_products(D d, V a, V b, V c, V e) {
  const V ce = hn::Mul(c, e);
  return hn::Add(fused_subtract(d, a, b, ce), fused_negative(d, c, e, ce));
}

/// Relative to the origin, sheared so that the ray runs along z.
template <class D>
HWY_INLINE Vertices<D> shear(D d, const Vertices<D>& p, const ShearedRays<D>& ray) {
  const auto z = hn::Sub(p.z, ray.origin_z);
  return {fused_negative(d, ray.shear_x, z, hn::Sub(p.x, ray.origin_x)),
          fused_negative(d, ray.shear_y, z, hn::Sub(p.y, ray.origin_y)), z};
}

/// Of triangles whose vertices are sheared.
template <class D>
HWY_INLINE TriangleHits<D> hit_sheared(D d, const Vertices<D>& a, const Vertices<D>& b, const Vertices<D>& c,
                                       hn::Vec<D> scale_z) {
  const auto u = difference_of_products(d, c.x, b.y, c.y, b.x);
  const auto v = difference_of_products(d, a.x, c.y, a.y, c.x);
  const auto w = difference_of_products(d, b.x, a.y, b.y, a.x);
  const auto zero = hn::Zero(d);
  const auto least = hn::Min(u, hn::Min(v, w)), most = hn::Max(u, hn::Max(v, w));
  const auto determinant = hn::Add(hn::Add(u, v), w);
  const auto inside = hn::And(hn::Or(hn::Ge(least, zero), hn::Le(most, zero)),
                              hn::Ge(hn::Abs(determinant), hn::Set(d, least_determinant)));
  const auto z = fused(d, u, a.z, fused(d, v, b.z, hn::Mul(w, c.z)));
  return {inside, hn::Mul(hn::Div(z, determinant), scale_z), v, w, determinant};
}

template <class D>
HWY_INLINE TriangleHits<D> hit_triangles(D d, const Vertices<D> (&triangle)[3], const ShearedRays<D>& ray) {
  return hit_sheared(d, shear(d, triangle[0], ray), shear(d, triangle[1], ray), shear(d, triangle[2], ray),
                     ray.scale_z);
}

/// One vertex of a block's triangles from `begin` on, in the ray's axis order.
template <class D, int L>
HWY_INLINE Vertices<D> load_vertices(D d, const LeafBlock<L>& block, int vertex, int begin,
                                     const std::uint32_t (&axes)[3]) {
  const float(&planes)[3][L] = block.vertices[vertex];
  return {hn::Load(d, planes[axes[0]] + begin), hn::Load(d, planes[axes[1]] + begin),
          hn::Load(d, planes[axes[2]] + begin)};
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
