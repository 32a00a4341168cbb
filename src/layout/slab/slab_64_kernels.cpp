#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/slab/slab_64_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/slab/split_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

Kernels<SlabNodes64, TriangleLeaves> choose_slab_64_over_triangles(const TraceOptions& options, std::uint32_t packet) {
  return split_kernels_over_triangles<SlabNodes64>(options, packet);
}

Kernels<SlabNodes64, InstanceLeaves> choose_slab_64_over_instances(const TraceOptions& options) {
  return split_kernels_over_instances<SlabNodes64>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_slab_64_over_triangles);
HWY_EXPORT(choose_slab_64_over_instances);

template <>
Kernels<SlabNodes64, TriangleLeaves> split_triangle_kernels(const TraceOptions& options, std::uint32_t packet) {
  return HWY_DYNAMIC_DISPATCH(choose_slab_64_over_triangles)(options, packet);
}

template <>
Kernels<SlabNodes64, InstanceLeaves> split_instance_kernels(const TraceOptions& options) {
  return HWY_DYNAMIC_DISPATCH(choose_slab_64_over_instances)(options);
}

}  // namespace boxwood
#endif
