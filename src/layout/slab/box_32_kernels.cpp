#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/slab/box_32_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/slab/split_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

Kernels<BoxNodes32, TriangleLeaves> choose_box_32_over_triangles(const TraceOptions& options, std::uint32_t packet) {
  return split_kernels_over_triangles<BoxNodes32>(options, packet);
}

Kernels<BoxNodes32, InstanceLeaves> choose_box_32_over_instances(const TraceOptions& options) {
  return split_kernels_over_instances<BoxNodes32>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_box_32_over_triangles);
HWY_EXPORT(choose_box_32_over_instances);

template <>
Kernels<BoxNodes32, TriangleLeaves> split_triangle_kernels(const TraceOptions& options, std::uint32_t packet) {
  return HWY_DYNAMIC_DISPATCH(choose_box_32_over_triangles)(options, packet);
}

template <>
Kernels<BoxNodes32, InstanceLeaves> split_instance_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_box_32_over_instances)(options);
}

}  // namespace boxwood
#endif
