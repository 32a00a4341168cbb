#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/wide/wide_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <cstring>

#include "layout/walk-inl.h"
#include "layout/wide/wide_nodes.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// A slot is the place of a link in memory, in units of a link's size.
class WideTester {
 public:
  using Slot = std::uint32_t;

  WideTester(const WideNodes& nodes, const PreparedRay& ray) : nodes_(nodes), memory_(nodes.memory.data()), ray_(ray) {
    for (int axis = 0; axis < 3; ++axis) {
      near_[axis] = static_cast<std::uint32_t>(axis + 3 * ray.negative[axis]) * nodes.k;
      far_[axis] = static_cast<std::uint32_t>(axis + 3 * (1 - ray.negative[axis])) * nodes.k;
    }
  }

  const Box& root_box() const { return nodes_.root_box; }
  std::uint32_t root_slot() const { return 0; }
  const Link& root_link() const { return nodes_.root; }
  HWY_INLINE Link link(std::uint32_t slot) const {
    Link link;
    std::memcpy(static_cast<void*>(&link), memory_ + std::size_t{slot} * 2, sizeof link);
    return link;
  }
  static std::uint32_t children(const Link& link) { return link.count; }
  HWY_INLINE std::uint32_t slot_of(std::uint32_t, const Link& link, std::uint32_t child) const {
    return link.first * (4 * nodes_.k) + 3 * nodes_.k + child;
  }
  HWY_INLINE bool test(std::uint32_t, const Link& link, std::uint32_t child, float from, float limit, float& t) const {
    const float* lane = memory_ + std::size_t{link.first} * (8 * nodes_.k) + child;
    float entry = from, exit = limit;
    for (int axis = 0; axis < 3; ++axis) {
      const float t0 = fused(lane[near_[axis]], ray_.inverse[axis], -ray_.near_offset[axis]);
      const float t1 = fused(lane[far_[axis]], ray_.inverse[axis], -ray_.far_offset[axis]);
      entry = t0 > entry ? t0 : entry;
      exit = t1 < exit ? t1 : exit;
    }
    t = entry;
    return entry <= exit;
  }

 private:
  const WideNodes& nodes_;
  const float* memory_;
  const PreparedRay& ray_;
  std::uint32_t near_[3], far_[3];  // planes in a node, in floats
};

Kernels<WideNodes, TriangleLeaves> choose_wide_over_triangles(const TraceOptions& options) {
  return choose_kernels<WideTester, WideNodes, TriangleLeaves>(options);
}

Kernels<WideNodes, InstanceLeaves> choose_wide_over_instances(const TraceOptions& options) {
  return choose_kernels<WideTester, WideNodes, InstanceLeaves>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_wide_over_triangles);
HWY_EXPORT(choose_wide_over_instances);

Kernels<WideNodes, TriangleLeaves> wide_triangle_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_wide_over_triangles)(options);
}

Kernels<WideNodes, InstanceLeaves> wide_instance_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_wide_over_instances)(options);
}

}  // namespace boxwood
#endif
