// The queries of a store of nodes and triangles, from the kernels of this folder. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SIMD_QUERIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_QUERIES_INL_H
#undef BOXWOOD_LAYOUT_SIMD_QUERIES_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_QUERIES_INL_H
#endif

#include "layout/simd/batch-inl.h"
#include "layout/simd/offer-inl.h"
#include "layout/simd/packet-inl.h"
#include "layout/simd/single-inl.h"
#include "layout/simd/steps16-inl.h"
#include "layout/simd/steps8-inl.h"
#include "layout/simd/stream-inl.h"
#include "layout/simd/wide_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

template <class Store>
struct Single {
  static Hit closest(const WideView& view, const Ray& ray) {
    return closest_hit<Store>(view, prepare(ray, view.reach), CountNothing{});
  }
  static bool any(const WideView& view, const Ray& ray) {
    return any_hit<Store>(view, prepare(ray, view.reach), CountNothing{});
  }
  static Hit closest_counted(const WideView& view, const Ray& ray, RayCounters& counters) {
    return closest_hit<Store>(view, prepare(ray, view.reach), CountSteps{counters});
  }
  static bool any_counted(const WideView& view, const Ray& ray, RayCounters& counters) {
    return any_hit<Store>(view, prepare(ray, view.reach), CountSteps{counters});
  }
  static void offer(const WideView& view, const Ray& ray, std::uint32_t instance, HitSink& sink) {
    offer_hits<Store>(view, prepare(ray, view.reach), instance, sink);
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
template <class Steps>
struct InFlight {
  static void closest(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits) {
    if (rays.size() < least_batch) return Single<typename Steps::Store>::closest_each(view, rays, hits);
    alignas(64) std::byte memory[slot_memory];
    if (view.out_of_cache)
      ClosestBatch<Steps, true>(view, rays, hits, memory).run();
    else
      ClosestBatch<Steps, false>(view, rays, hits, memory).run();
  }
  static void any(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    if (rays.size() < least_batch) return Single<typename Steps::Store>::any_each(view, rays, blocked);
    alignas(64) std::byte memory[slot_memory];
    if (view.out_of_cache)
      AnyBatch<Steps, true>(view, rays, blocked, memory).run();
    else
      AnyBatch<Steps, false>(view, rays, blocked, memory).run();
  }
};

/// Coherent groups of 64 go as packets, all between them as rays in flight or, when only whether they are blocked is
/// asked, as streams.
template <class Steps>
struct Batch {
  using Store = typename Steps::Store;

  static void closest(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits) {
    for_each_run(
        view, rays,
        [&](RayGroup& group, std::size_t begin) {
          return closest_hits_of_group<Store>(view, group, hits.data() + begin);
        },
        [&](std::size_t begin, std::size_t size) {
          InFlight<Steps>::closest(view, rays.subspan(begin, size), hits.subspan(begin, size));
        });
  }
  static void any(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    for_each_run(
        view, rays,
        [&](RayGroup& group, std::size_t begin) {
          return any_hits_of_group<Store>(view, group, blocked.data() + begin);
        },
        [&](std::size_t begin, std::size_t size) {
          any_between(view, rays.subspan(begin, size), blocked.subspan(begin, size), size < rays.size());
        });
  }

 private:
  /// As streams where rays share nodes, else in flight.
  static void any_between(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                          bool among_groups) {
    while (!rays.empty()) {
      const std::size_t done = any_by_streams<Store>(view, rays, blocked, among_groups);
      rays = rays.subspan(done), blocked = blocked.subspan(done);
      const std::size_t next = std::min(stream_pause, rays.size());
      InFlight<Steps>::any(view, rays.first(next), blocked.first(next));
      rays = rays.subspan(next), blocked = blocked.subspan(next);
    }
  }

  /// How far ahead the first rays of groups are fetched, which tell that most incoherent groups are: looks take no
  /// time, memory does. All rays only after a coherent group; others are fetched when they go in flight.
  static constexpr std::size_t looked_ahead = 16 * group_size;

  /// Cuts the batch into coherent groups and the runs between them. After a group that was not worth it, ever more are
  /// passed over, so that a batch that only looks coherent loses little.
  template <class OnGroup, class OnRun>
  static void for_each_run(const WideView& view, std::span<const Ray> rays, OnGroup on_group, OnRun on_run) {
    std::size_t done = 0, next = 0;
    std::size_t pass_over = 0, penalty = 1;
    RayGroup group;
    for (std::size_t i = 0; i < std::min(looked_ahead, rays.size()); i += group_size) __builtin_prefetch(&rays[i]);
    for (; next + group_size <= rays.size(); next += group_size) {
      if (pass_over > 0) {
        --pass_over;
        continue;
      }
      __builtin_prefetch(&rays[std::min(next + looked_ahead, rays.size() - 1)]);
      const bool after_group = next != 0 && done == next;
      if (after_group) prefetch_rays(rays, next + group_size, group_size);
      if (!prepare_group(rays.subspan(next, group_size), view.reach, after_group, group)) continue;
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

/// Queries that take rays one by one.
template <class Store>
WideKernels single_kernels() {
  using Each = Single<Store>;
  return {Each::closest,         Each::any,         Each::closest_each, Each::any_each,
          Each::closest_counted, Each::any_counted, Each::offer};
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
