#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/quantized/quantized_free_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/quantized/testers-inl.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

Kernels<QuantizedChunks, TriangleLeaves> choose_quantized_free_over_triangles(const TraceOptions& trace) {
  return choose_kernels<FreeFrameTester, QuantizedChunks, TriangleLeaves>(trace);
}

Kernels<QuantizedChunks, InstanceLeaves> choose_quantized_free_over_instances(const TraceOptions& trace) {
  return choose_kernels<FreeFrameTester, QuantizedChunks, InstanceLeaves>(trace);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_quantized_free_over_triangles);
HWY_EXPORT(choose_quantized_free_over_instances);

Kernels<QuantizedChunks, TriangleLeaves> quantized_free_triangle_kernels(const TraceOptions& trace) {
  return HWY_DYNAMIC_DISPATCH(choose_quantized_free_over_triangles)(trace);
}

Kernels<QuantizedChunks, InstanceLeaves> quantized_free_instance_kernels(const TraceOptions& trace) {
  return HWY_DYNAMIC_DISPATCH(choose_quantized_free_over_instances)(trace);
}

}  // namespace boxwood
#endif
