// The box test of trace/prepared_ray-inl.h on all children of a node at once.
#if defined(BOXWOOD_LAYOUT_SIMD_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_BOXES_INL_H
#undef BOXWOOD_LAYOUT_SIMD_BOXES_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_BOXES_INL_H
#endif

#include "layout/simd/lanes-inl.h"
#include "layout/simd/wide_node.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// The part of a prepared ray that the box test reads, in every lane, and the row of its near planes on each axis; the
/// far ones are in the other row of the pair.
template <class D>
struct SlabRay {
  hn::Vec<D> inverse[3], near_offset[3], far_offset[3];
  hn::Vec<D> t_near;
  int near_row[3];
};

template <class D>
HWY_INLINE SlabRay<D> broadcast_slabs(D d, const PreparedRay& ray) {
  SlabRay<D> out;
  for (int axis = 0; axis < 3; ++axis) {
    out.inverse[axis] = hn::Set(d, ray.inverse[axis]);
    out.near_offset[axis] = hn::Set(d, ray.near_offset[axis]);
    out.far_offset[axis] = hn::Set(d, ray.far_offset[axis]);
    out.near_row[axis] = 2 * axis + ray.negative[axis];
  }
  out.t_near = hn::Set(d, ray.t_near);
  return out;
}

template <class D>
struct BoxHits {
  hn::Vec<D> entry;
  hn::Mask<D> hit;
};

/// Children from `begin` on, as many as a register holds. Not fused where the instruction set has no fused
/// multiply-add: the offsets' widening covers that rounding too.
template <class D, int N>
HWY_INLINE BoxHits<D> hit_boxes(D, const WideNode<N>& node, int begin, const SlabRay<D>& ray, hn::Vec<D> t_limit) {
  const D d;
  const auto near_plane = [&](int axis) {
    return hn::MulSub(hn::Load(d, node.planes[ray.near_row[axis]] + begin), ray.inverse[axis], ray.near_offset[axis]);
  };
  const auto far_plane = [&](int axis) {
    return hn::MulSub(hn::Load(d, node.planes[ray.near_row[axis] ^ 1] + begin), ray.inverse[axis],
                      ray.far_offset[axis]);
  };
  const auto entry = hn::Max(hn::Max(near_plane(0), near_plane(1)), hn::Max(near_plane(2), ray.t_near));
  const auto exit = hn::Min(hn::Min(far_plane(0), far_plane(1)), hn::Min(far_plane(2), t_limit));
  return {entry, hn::Le(entry, exit)};
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
