#include "layout/compressed/compressed_kernels.h"

/// Takes bits out of registers of bytes, which plain AVX-512 cannot.
#define HWY_WANT_AVX3_DL

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/compressed/compressed_kernels.cpp"
#include <hwy/foreach_target.h>

#include "layout/compressed/open_quantized-inl.h"
#include "layout/compressed/packed_pass-inl.h"
#include "layout/compressed/quantized_store-inl.h"
#include "layout/simd/queries-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

template <class Node, int N>
WideKernels kernels() {
  using Store = QuantizedStore<Node, N>;
  WideKernels out = single_kernels<Store>();
#if HWY_MAX_BYTES >= 32
  using Steps = std::conditional_t<N == 16, Steps16<Store>, Steps8<Store>>;
  out.closest_hits = Batch<Steps>::closest;
  out.any_hits = Batch<Steps>::any;
#endif
  return out;
}

WideKernels compressed_kernels_8() { return kernels<QuantizedNode8, 8>(); }
WideKernels compressed_kernels_16() { return kernels<QuantizedNode16, 16>(); }

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(compressed_kernels_8);
HWY_EXPORT(compressed_kernels_16);

template <>
WideKernels compressed_kernels<8>() {
  return HWY_DYNAMIC_DISPATCH(compressed_kernels_8)();
}
template <>
WideKernels compressed_kernels<16>() {
  return HWY_DYNAMIC_DISPATCH(compressed_kernels_16)();
}

}  // namespace boxwood
#endif
