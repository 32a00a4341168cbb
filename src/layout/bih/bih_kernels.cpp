#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/bih/bih_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/bih/bih_nodes.h"
#include "layout/slab/plane_rows-inl.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

class BihTester {
 public:
  static constexpr bool segments = true, binary = true;

  BihTester(const BihNodes& nodes, const PreparedRay& ray) : nodes_(nodes), memory_(nodes.nodes.data()), rows_(ray) {}

  const Box& root_box() const { return nodes_.root_box; }
  static std::uint32_t root_slot() { return 0; }
  Link root_link() const { return nodes_.link_of(memory_[0]); }
  HWY_INLINE Link link(std::uint32_t slot) const { return nodes_.link_of(memory_[slot]); }
  static constexpr std::uint32_t children(const Link&) { return 2; }
  static HWY_INLINE std::uint32_t slot_of(std::uint32_t, const Link& link, std::uint32_t child) {
    return 2 * link.first + 1 + child;
  }
  HWY_INLINE Part test(std::uint32_t slot, const Link& link, std::uint32_t child, Part part, float limit) const {
    part.exit = limit < part.exit ? limit : part.exit;
    // The first child has an upper bound, the second a lower one.
    return rows_.narrow(memory_[slot].planes[child], 2 * link.axis + 1 - child, part);
  }

 private:
  const BihNodes& nodes_;
  const BihNode* memory_;
  PlaneRows rows_;
};

Kernels<BihNodes, TriangleLeaves> choose_bih_over_triangles(const TraceOptions& options) {
  return choose_kernels<BihTester, BihNodes, TriangleLeaves>(options);
}

Kernels<BihNodes, InstanceLeaves> choose_bih_over_instances(const TraceOptions& options) {
  return choose_kernels<BihTester, BihNodes, InstanceLeaves>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_bih_over_triangles);
HWY_EXPORT(choose_bih_over_instances);

Kernels<BihNodes, TriangleLeaves> bih_triangle_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_bih_over_triangles)(options);
}

Kernels<BihNodes, InstanceLeaves> bih_instance_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_bih_over_instances)(options);
}

}  // namespace boxwood
#endif
