#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/wide/wide_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/rows-inl.h"
#include "layout/walk-inl.h"
#include "layout/wide/wide_nodes.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

class WideTester : public RowReader<WideNodes> {
 public:
  WideTester(const WideNodes& nodes, const PreparedRay& ray) : RowReader(nodes), ray_(ray, nodes.k) {}

  static std::uint32_t children(const Link& link) { return link.count; }
  HWY_INLINE std::uint32_t slot_of(std::uint32_t, const Link& link, std::uint32_t child) const {
    return link.first * (4 * nodes_.k) + 3 * nodes_.k + child;
  }
  HWY_INLINE bool test(std::uint32_t, const Link& link, std::uint32_t child, float from, float limit, float& t) const {
    return ray_.test(memory_ + std::size_t{link.first} * (8 * nodes_.k) + child, from, limit, t);
  }

 private:
  RowRay ray_;
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
