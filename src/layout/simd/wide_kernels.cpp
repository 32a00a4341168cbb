#include "layout/simd/wide_kernels.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/simd/wide_kernels.cpp"
#include <hwy/foreach_target.h>

#include "layout/simd/queries-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

template <int N, int L>
WideKernels kernels() {
  using Store = PlainStore<N, L>;
  WideKernels out = single_kernels<Store>();
#if HWY_MAX_BYTES >= 32
  if constexpr (N > 4) {
    using Steps = std::conditional_t<N == 16, Steps16<Store>, Steps8<Store>>;
    out.closest_hits = Batch<Steps>::closest;
    out.any_hits = Batch<Steps>::any;
  }
#endif
  return out;
}

WideKernels kernels_4_4() { return kernels<4, 4>(); }
WideKernels kernels_8_4() { return kernels<8, 4>(); }
WideKernels kernels_8_8() { return kernels<8, 8>(); }
WideKernels kernels_16_8() { return kernels<16, 8>(); }

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(kernels_4_4);
HWY_EXPORT(kernels_8_4);
HWY_EXPORT(kernels_8_8);
HWY_EXPORT(kernels_16_8);

template <>
WideKernels wide_kernels<4, 4>() {
  return HWY_DYNAMIC_DISPATCH(kernels_4_4)();
}
template <>
WideKernels wide_kernels<8, 4>() {
  return HWY_DYNAMIC_DISPATCH(kernels_8_4)();
}
template <>
WideKernels wide_kernels<8, 8>() {
  return HWY_DYNAMIC_DISPATCH(kernels_8_8)();
}
template <>
WideKernels wide_kernels<16, 8>() {
  return HWY_DYNAMIC_DISPATCH(kernels_16_8)();
}

}  // namespace boxwood
#endif
