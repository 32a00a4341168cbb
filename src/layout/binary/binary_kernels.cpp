#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/binary/binary_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/binary/binary_nodes.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

class BinaryTester {
 public:
  using Slot = std::uint32_t;

  BinaryTester(const BinaryNodes& nodes, const PreparedRay& ray) : nodes_(nodes.nodes.data()), ray_(ray) {}

  const Box& root_box() const { return nodes_[0].bounds; }
  std::uint32_t root_slot() const { return 0; }
  const Link& root_link() const { return nodes_[0].link; }
  HWY_INLINE const Link& link(std::uint32_t slot) const { return nodes_[slot].link; }
  static constexpr std::uint32_t children(const Link&) { return 2; }
  HWY_INLINE std::uint32_t slot_of(std::uint32_t slot, const Link& link, std::uint32_t child) const {
    return child == 0 ? slot + 1 : link.first;
  }
  HWY_INLINE bool test(std::uint32_t slot, const Link& link, std::uint32_t child, float from, float limit,
                       float& t) const {
    return hit_box(nodes_[slot_of(slot, link, child)].bounds, ray_, from, limit, t);
  }

 private:
  const BinaryNode* nodes_;
  const PreparedRay& ray_;
};

Kernels<BinaryNodes, TriangleLeaves> choose_binary_over_triangles(const TraceOptions& options) {
  return choose_kernels<BinaryTester, BinaryNodes, TriangleLeaves>(options);
}

Kernels<BinaryNodes, InstanceLeaves> choose_binary_over_instances(const TraceOptions& options) {
  return choose_kernels<BinaryTester, BinaryNodes, InstanceLeaves>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_binary_over_triangles);
HWY_EXPORT(choose_binary_over_instances);

Kernels<BinaryNodes, TriangleLeaves> binary_triangle_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_binary_over_triangles)(options);
}

Kernels<BinaryNodes, InstanceLeaves> binary_instance_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_binary_over_instances)(options);
}

}  // namespace boxwood
#endif
