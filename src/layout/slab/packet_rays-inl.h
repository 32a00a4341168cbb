// N rays side by side, and what they make of planes, boxes and triangles. Compiled once per instruction set; registers
// shorter than N are taken in turn.
#if defined(BOXWOOD_LAYOUT_SLAB_PACKET_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SLAB_PACKET_RAYS_INL_H
#undef BOXWOOD_LAYOUT_SLAB_PACKET_RAYS_INL_H
#else
#define BOXWOOD_LAYOUT_SLAB_PACKET_RAYS_INL_H
#endif

#include <algorithm>
#include <limits>
#include <span>

#include "layout/simd/triangles-inl.h"
#include "layout/slab/split_nodes.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// One value per ray.
template <int N>
struct alignas(4 * N < 64 ? 4 * N : 64) PerRay {
  float lanes[N];
  void fill(float value) { std::fill_n(lanes, N, value); }
};

template <int N>
using PacketTag = hn::CappedTag<float, static_cast<std::size_t>(N)>;
template <int N>
inline constexpr int strip = lanes_of<PacketTag<N>>;

/// The part of each ray inside a node.
template <int N>
struct Parts {
  PerRay<N> from, exit;
};

/// Prepared rays that share the signs of their directions and their dominant axis.
template <int N>
struct PacketRays {
  PerRay<N> origin[3], inverse[3], near_offset[3], far_offset[3];
  PerRay<N> shear_x, shear_y, scale_z, t_near;
  PerRay<N> limit;  ///< what is entered beyond it is skipped
  PerRay<N> zero, endless;
  PerRay<N> minus_endless;
  int negative[3];
  int kx, ky, kz;

  /// False when some ray is invalid or the rays are not alike.
  bool prepare_all(const Ray* rays, float reach, float gain) {
    for (int i = 0; i < N; ++i) {
      const PreparedRay ray = prepare(rays[i], reach, gain);
      if (!ray.valid || !(ray.t_near > -std::numeric_limits<float>::infinity())) return false;
      if (i == 0) {
        std::copy_n(ray.negative, 3, negative);
        kx = ray.kx, ky = ray.ky, kz = ray.kz;
      }
      if (ray.kz != kz || !std::equal(negative, negative + 3, ray.negative)) return false;
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis].lanes[i] = ray.origin[axis];
        inverse[axis].lanes[i] = ray.inverse[axis];
        near_offset[axis].lanes[i] = ray.near_offset[axis];
        far_offset[axis].lanes[i] = ray.far_offset[axis];
      }
      shear_x.lanes[i] = ray.shear_x, shear_y.lanes[i] = ray.shear_y, scale_z.lanes[i] = ray.scale_z;
      t_near.lanes[i] = ray.t_near, limit.lanes[i] = ray.t_far;
    }
    zero.fill(0);
    endless.fill(std::numeric_limits<float>::infinity());
    minus_endless.fill(-std::numeric_limits<float>::infinity());
    return true;
  }
};

/// What is left of `parts` within each ray's limit; false when nothing is.
template <int N>
HWY_INLINE bool limit_parts(const PacketRays<N>& rays, const Parts<N>& parts, Parts<N>& left) {
  const PacketTag<N> d;
  bool met = false;
  for (int i = 0; i < N; i += strip<N>) {
    const auto from = hn::Load(d, parts.from.lanes + i);
    const auto exit = hn::Min(hn::Load(d, parts.exit.lanes + i), hn::Load(d, rays.limit.lanes + i));
    hn::Store(from, d, left.from.lanes + i);
    hn::Store(exit, d, left.exit.lanes + i);
    met |= !hn::AllFalse(d, hn::Le(from, exit));
  }
  return met;
}

template <int N>
HWY_INLINE bool clip_parts(const Box& box, const PacketRays<N>& rays, const Parts<N>& parts, Parts<N>& left) {
  const PacketTag<N> d;
  const Vec3* planes = &box.lower;  // [0] lower, [1] upper
  bool met = false;
  for (int i = 0; i < N; i += strip<N>) {
    auto from = hn::Load(d, parts.from.lanes + i);
    auto exit = hn::Min(hn::Load(d, parts.exit.lanes + i), hn::Load(d, rays.limit.lanes + i));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto inverse = hn::Load(d, rays.inverse[axis].lanes + i);
      const auto near_plane = hn::Set(d, planes[rays.negative[axis]][axis]);
      const auto far_plane = hn::Set(d, planes[1 - rays.negative[axis]][axis]);
      from = hn::Max(hn::MulSub(near_plane, inverse, hn::Load(d, rays.near_offset[axis].lanes + i)), from);
      exit = hn::Min(hn::MulSub(far_plane, inverse, hn::Load(d, rays.far_offset[axis].lanes + i)), exit);
    }
    hn::Store(from, d, left.from.lanes + i);
    hn::Store(exit, d, left.exit.lanes + i);
    met |= !hn::AllFalse(d, hn::Le(from, exit));
  }
  return met;
}

/// As PlaneRows, for all rays of a packet: for each side the rows of values that change one end and leave the other.
template <int N>
class PacketPlanes {
 public:
  explicit PacketPlanes(const PacketRays<N>& rays) : rays_(rays) {
    for (BoxSide side = 0; side < 6; ++side) {
      const BoxSide axis = side >> 1;
      const bool exits = (side & 1) != static_cast<std::uint32_t>(rays.negative[axis]);
      const float* inverse = rays.inverse[axis].lanes;
      rows_[side] = exits ? Row{rays.zero.lanes, rays.endless.lanes, inverse, rays.far_offset[axis].lanes}
                          : Row{inverse, rays.near_offset[axis].lanes, rays.zero.lanes, rays.minus_endless.lanes};
    }
  }

  HWY_INLINE bool narrow(float plane, BoxSide side, const Parts<N>& parts, Parts<N>& left) const {
    const PacketTag<N> d;
    const Row& row = rows_[side];
    const auto planes = hn::Set(d, plane);
    bool met = false;
    for (int i = 0; i < N; i += strip<N>) {
      const auto t0 = hn::MulSub(planes, hn::Load(d, row.near_inverse + i), hn::Load(d, row.near_offset + i));
      const auto t1 = hn::MulSub(planes, hn::Load(d, row.far_inverse + i), hn::Load(d, row.far_offset + i));
      const auto from = hn::Max(t0, hn::Load(d, parts.from.lanes + i));
      const auto limit = hn::Min(hn::Load(d, parts.exit.lanes + i), hn::Load(d, rays_.limit.lanes + i));
      const auto exit = hn::Min(t1, limit);
      hn::Store(from, d, left.from.lanes + i);
      hn::Store(exit, d, left.exit.lanes + i);
      met |= !hn::AllFalse(d, hn::Le(from, exit));
    }
    return met;
  }

 private:
  struct Row {
    const float *near_inverse, *near_offset, *far_inverse, *far_offset;
  };
  const PacketRays<N>& rays_;
  Row rows_[6];
};

/// Calls found(first lane of a strip, hits) where some ray of the strip hits the triangle within its limit.
template <int N, class Found>
HWY_INLINE void hit_by_packet(const LeafTriangle& triangle, const PacketRays<N>& rays, Found found) {
  using D = PacketTag<N>;
  const D d;
  const auto vertex = [&](const Vec3& v) {
    return Vertices<D>{hn::Set(d, v[static_cast<std::size_t>(rays.kx)]),
                       hn::Set(d, v[static_cast<std::size_t>(rays.ky)]),
                       hn::Set(d, v[static_cast<std::size_t>(rays.kz)])};
  };
  const Vertices<D> vertices[3] = {vertex(triangle.a), vertex(triangle.b), vertex(triangle.c)};
  for (int i = 0; i < N; i += strip<N>) {
    const auto of = [&](const PerRay<N>& values) { return hn::Load(d, values.lanes + i); };
    const ShearedRays<D> sheared{of(rays.origin[rays.kx]), of(rays.origin[rays.ky]), of(rays.origin[rays.kz]),
                                 of(rays.shear_x),         of(rays.shear_y),         of(rays.scale_z)};
    TriangleHits<D> hits = hit_triangles(d, vertices, sheared);
    hits.hit = hn::And(hits.hit, hn::And(hn::Ge(hits.t, of(rays.t_near)), hn::Le(hits.t, of(rays.limit))));
    if (!hn::AllFalse(d, hits.hit)) found(i, hits);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
