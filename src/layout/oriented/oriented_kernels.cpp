#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/oriented/oriented_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <cmath>

#include "layout/oriented/oriented_nodes.h"
#include "layout/rows-inl.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// In a turned frame the same t belongs to the same point, but more is rounded. With u = 2^-24 and m the largest
/// coordinate involved: a triangle's hit is within 17 u m of the ray (see PreparedRay), 30 u m in a frame whose rows
/// have absolute sums below sqrt(3); turning the origin and the direction, itself the reciprocal of a reciprocal, adds
/// 5 and 9 u m; the box test on coordinates up to sqrt(3) m adds 12 u m. Boxes are widened by 128 u m, twice all that.
class OrientedTester : public RowReader<OrientedNodes> {
 public:
  OrientedTester(const OrientedNodes& nodes, const PreparedRay& ray) : RowReader(nodes), world_(ray, nodes.k) {
    float magnitude = 0x1p-26f;
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = ray.origin[axis];
      direction_[axis] = 1.0f / ray.inverse[axis];
      const float size = std::fabs(direction_[axis]);
      largest_ = size > largest_ ? size : largest_;
      const float extent = std::fabs(ray.origin[axis]) + nodes.reach;
      magnitude = extent > magnitude ? extent : magnitude;
    }
    bound_ = magnitude * 0x1p-17f;
  }

  /// What the walk asks first of a node that it opens: the ray is turned here, once for all children.
  HWY_INLINE std::uint32_t children(const Link& link) const {
    node_ = memory_ + place_of(link);
    ray_ = &world_;
    if (is_turned(link)) {
      turn(node_ + 8 * std::size_t{nodes_.k});
      ray_ = &turned_;
    }
    return link.count;
  }
  HWY_INLINE std::uint32_t slot_of(std::uint32_t, const Link& link, std::uint32_t child) const {
    return (link.first >> 1) * static_cast<std::uint32_t>(oriented_unit / 2) + 3 * nodes_.k + child;
  }
  HWY_INLINE bool test(std::uint32_t, const Link&, std::uint32_t child, float from, float limit, float& t) const {
    return ray_->test(node_ + child, from, limit, t);
  }

 private:
  HWY_INLINE void turn(const float* frame) const {
    const float least = largest_ * 1e-9f;
    for (int axis = 0; axis < 3; ++axis, frame += 4) {
      const float origin = fused(frame[0], origin_[0], fused(frame[1], origin_[1], frame[2] * origin_[2]));
      const float direction = fused(frame[0], direction_[0], fused(frame[1], direction_[1], frame[2] * direction_[2]));
      const float size = std::fabs(direction) < least ? least : std::fabs(direction);
      const int negative = std::signbit(direction) ? 1 : 0;
      const float reciprocal = 1.0f / size;
      turned_.inverse[axis] = negative ? -reciprocal : reciprocal;
      const float center = origin * turned_.inverse[axis], slack = bound_ * reciprocal;
      turned_.near_offset[axis] = center + slack;
      turned_.far_offset[axis] = center - slack;
      turned_.set_planes(axis, negative, nodes_.k);
    }
  }

  RowRay world_;
  float origin_[3], direction_[3];
  float largest_ = 0, bound_ = 0;
  // Of the node opened last.
  mutable const float* node_ = nullptr;
  mutable const RowRay* ray_ = nullptr;
  mutable RowRay turned_;
};

Kernels<OrientedNodes, TriangleLeaves> choose_oriented_over_triangles(const TraceOptions& options) {
  return choose_kernels<OrientedTester, OrientedNodes, TriangleLeaves>(options);
}

Kernels<OrientedNodes, InstanceLeaves> choose_oriented_over_instances(const TraceOptions& options) {
  return choose_kernels<OrientedTester, OrientedNodes, InstanceLeaves>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_oriented_over_triangles);
HWY_EXPORT(choose_oriented_over_instances);

Kernels<OrientedNodes, TriangleLeaves> oriented_triangle_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_oriented_over_triangles)(options);
}

Kernels<OrientedNodes, InstanceLeaves> oriented_instance_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_oriented_over_instances)(options);
}

}  // namespace boxwood
#endif
