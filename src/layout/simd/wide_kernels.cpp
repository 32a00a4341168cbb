#include "layout/simd/wide_kernels.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/simd/wide_kernels.cpp"
#include <hwy/foreach_target.h>

#include "layout/simd/batch-inl.h"
#include "layout/simd/packet-inl.h"
#include "layout/simd/single-inl.h"
#include "layout/simd/steps16-inl.h"
#include "layout/simd/steps8-inl.h"

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

#if HWY_MAX_BYTES >= 32
/// Fewer rays than this do not fill the lists of rays in flight.
inline constexpr std::size_t least_batch = 16;

/// Rays in flight through nodes as `Steps` says.
template <class Steps, int L>
struct InFlight {
  static void closest(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits) {
    if (rays.size() < least_batch) return Single<Steps::width, L>::closest_each(view, rays, hits);
    alignas(64) std::byte memory[slot_memory];
    if (view.out_of_cache)
      ClosestBatch<Steps, L, true>(view, rays, hits, memory).run();
    else
      ClosestBatch<Steps, L, false>(view, rays, hits, memory).run();
  }
  static void any(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    if (rays.size() < least_batch) return Single<Steps::width, L>::any_each(view, rays, blocked);
    alignas(64) std::byte memory[slot_memory];
    if (view.out_of_cache)
      AnyBatch<Steps, L, true>(view, rays, blocked, memory).run();
    else
      AnyBatch<Steps, L, false>(view, rays, blocked, memory).run();
  }
};

/// Coherent groups of 64 go as packets, all between them as rays in flight.
template <class Steps, int L>
struct Batch {
  static void closest(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits) {
    for_each_run(
        view, rays,
        [&](RayGroup& group, std::size_t begin) {
          return closest_hits_of_group<Steps::width, L>(view, group, hits.data() + begin);
        },
        [&](std::size_t begin, std::size_t size) {
          InFlight<Steps, L>::closest(view, rays.subspan(begin, size), hits.subspan(begin, size));
        });
  }
  static void any(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    for_each_run(
        view, rays,
        [&](RayGroup& group, std::size_t begin) {
          return any_hits_of_group<Steps::width, L>(view, group, blocked.data() + begin);
        },
        [&](std::size_t begin, std::size_t size) {
          InFlight<Steps, L>::any(view, rays.subspan(begin, size), blocked.subspan(begin, size));
        });
  }

 private:
  /// Cuts the batch into coherent groups and the runs between them. After a group that was not worth it, ever more are
  /// passed over, so that a batch that only looks coherent loses little.
  template <class OnGroup, class OnRun>
  static void for_each_run(const WideView& view, std::span<const Ray> rays, OnGroup on_group, OnRun on_run) {
    std::size_t done = 0, next = 0;
    std::size_t pass_over = 0, penalty = 1;
    RayGroup group;
    for (; next + group_size <= rays.size(); next += group_size) {
      if (pass_over > 0) {
        --pass_over;
        continue;
      }
      if (!prepare_group(rays.subspan(next, group_size), view.reach, group)) continue;
      if (!on_group(group, next)) {
        pass_over = penalty;
        penalty = std::min<std::size_t>(2 * penalty, 64);
        continue;
      }
      penalty = std::max<std::size_t>(penalty / 2, 1);
      if (done != next) on_run(done, next - done);
      done = next + group_size;
    }
    if (done != rays.size()) on_run(done, rays.size() - done);
  }
};
#endif

template <int N, int L>
WideKernels kernels() {
  using Each = Single<N, L>;
  WideKernels out{Each::closest,         Each::any,        Each::closest_each, Each::any_each,
                  Each::closest_counted, Each::any_counted};
#if HWY_MAX_BYTES >= 32
  if constexpr (N == 8) {
    out.closest_hits = Batch<Steps8, L>::closest;
    out.any_hits = Batch<Steps8, L>::any;
  }
#endif
#if HWY_TARGET <= HWY_AVX3
  if constexpr (N == 16) {
    out.closest_hits = Batch<Steps16, L>::closest;
    out.any_hits = Batch<Steps16, L>::any;
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
