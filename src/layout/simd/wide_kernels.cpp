#include "layout/simd/wide_kernels.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/simd/wide_kernels.cpp"
#include <hwy/foreach_target.h>

#include "layout/simd/batch-inl.h"
#include "layout/simd/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

template <int N, int L>
struct Single {
  static Hit closest(const WideView& view, const Ray& ray) {
    return closest_hit<N, L>(view, prepare(ray, view.reach), CountNothing{});
  }
  static bool any(const WideView& view, const Ray& ray) {
    return any_hit<N, L>(view, prepare(ray, view.reach), CountNothing{});
  }
  static Hit closest_counted(const WideView& view, const Ray& ray, RayCounters& counters) {
    return closest_hit<N, L>(view, prepare(ray, view.reach), CountSteps{counters});
  }
  static bool any_counted(const WideView& view, const Ray& ray, RayCounters& counters) {
    return any_hit<N, L>(view, prepare(ray, view.reach), CountSteps{counters});
  }
  static void closest_each(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits) {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(view, rays[i]);
  }
  static void any_each(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any(view, rays[i]) ? 1 : 0;
  }
};

template <int N, int L>
WideKernels kernels() {
  using Kernels = Single<N, L>;
  return {Kernels::closest,         Kernels::any,        Kernels::closest_each, Kernels::any_each,
          Kernels::closest_counted, Kernels::any_counted};
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
