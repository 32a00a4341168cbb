// Many rays in flight: every ray waits in one of three lists for what it needs next (a node, a leaf, an entry popped
// from its stack), and each pass serves a whole list with steps free of data-dependent branches. So neither cache
// misses nor mispredictions of one ray hold up the others. Needs eight-lane registers. Compiled once per instruction
// set.
#if defined(BOXWOOD_LAYOUT_SIMD_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_BATCH_INL_H
#undef BOXWOOD_LAYOUT_SIMD_BATCH_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_BATCH_INL_H
#endif

#include <span>

#include "layout/simd/leaf_steps-inl.h"
#include "layout/simd/load_rays-inl.h"
#include "layout/simd/single-inl.h"
#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// What node and leaf steps read next, for trees that are not in the cache.
template <class Store>
HWY_INLINE void prefetch_next(const WideView& view, const std::uint32_t* next, std::uint32_t size) {
  for (std::uint32_t i = 0; i < size; ++i) Store::prefetch(view, next[i]);
}

/// What a group of rays in flight needs next, and what its last pass found out.
struct Lists {
  enum class Pass { none, nodes, leaves, pops };

  SlotList nodes, leaves, pops, free;
  alignas(64) std::uint32_t next[most_in_flight + 16];  // of the rays in the list that was passed last
  Pass last = Pass::none;

  /// The longest list.
  HWY_INLINE Pass longest() const {
    if (nodes.size + leaves.size + pops.size == 0) return Pass::none;
    if (nodes.size >= leaves.size && nodes.size >= pops.size) return Pass::nodes;
    return pops.size >= leaves.size ? Pass::pops : Pass::leaves;
  }
};

/// Two groups of rays take turns: what a pass over one has stored is in the cache when it is read, after a pass over
/// the other. A load of many small stores that are still on their way would wait for all of them.
inline constexpr int ray_groups = 2;

/// Runs passes until no group has rays left. begin(lists) runs a pass over the longest list, end(lists) sorts what
/// that pass found out.
template <class Begin, class End>
HWY_INLINE void take_turns(Lists (&groups)[ray_groups], Begin begin, End end) {
  int at_work = ray_groups;
  while (at_work > 0) {
    at_work = 0;
    for (Lists& lists : groups) {
      end(lists);
      lists.last = lists.longest();
      if (lists.last == Lists::Pass::none) continue;
      begin(lists);
      ++at_work;
    }
  }
}

/// Closest hits of a whole batch. Steps: how rays pass nodes.
template <class Steps, bool Prefetch>
class ClosestBatch {
  using Store = typename Steps::Store;

 public:
  ClosestBatch(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits, std::byte* memory)
      : view_(view), rays_(rays), hits_(hits), slots_(memory, view.stack), incoming_(rays, view) {}

  void run() {
    const int in_flight = slots_.in_flight();
    for (int i = 0; i < in_flight; ++i) groups_[i % ray_groups].free.add(slots_.offset(i));
    for (Lists& lists : groups_) load(lists);
    take_turns(
        groups_, [&](Lists& lists) { begin(lists); }, [&](Lists& lists) { end(lists); });
  }

 private:
  /// Puts the next rays that the lists can serve into free slots.
  HWY_INLINE void load(Lists& lists) {
    const auto skip = [&](const Slot& ray, bool valid, std::uint32_t index) HWY_ATTR {
      __builtin_prefetch(&hits_[index], 1);
      // Keys order by their bits, which negative distances do not do.
      if (HWY_LIKELY(valid && ray.t_near >= 0)) return false;
      hits_[index] = closest_hit<Store>(view_, prepare(rays_[index], view_.reach), CountNothing{});
      return true;
    };
    incoming_.fill(slots_, lists.free, lists.nodes, skip);
  }

  void begin(Lists& lists) {
    switch (lists.last) {
      case Lists::Pass::nodes:
        Steps::closest_pass(slots_, view_, lists.nodes, lists.next);
        if constexpr (Prefetch) prefetch_next<Store>(view_, lists.next, lists.nodes.size);
        break;
      case Lists::Pass::leaves:
        LeafSteps<Store>::closest_pass(slots_, view_, lists.leaves);
        break;
      case Lists::Pass::pops:
        for (std::uint32_t i = 0; i < lists.pops.size; ++i) {
          lists.next[i] = pop_step(slots_.at(lists.pops.offsets[i]));
        }
        if constexpr (Prefetch) prefetch_next<Store>(view_, lists.next, lists.pops.size);
        break;
      case Lists::Pass::none:
        break;
    }
  }

  void end(Lists& lists) {
    if (lists.last == Lists::Pass::nodes) {
      const std::uint32_t size = std::exchange(lists.nodes.size, 0);
      split(lists.nodes.offsets, size, lists.next, lists.nodes, lists.leaves, lists.pops);
    } else if (lists.last == Lists::Pass::leaves) {
      append(lists.leaves, lists.pops);
    } else if (lists.last == Lists::Pass::pops) {
      const std::uint32_t size = std::exchange(lists.pops.size, 0);
      const std::uint32_t free = lists.free.size;
      split(lists.pops.offsets, size, lists.next, lists.nodes, lists.leaves, lists.free);
      for (std::uint32_t i = free; i < lists.free.size; ++i) {
        const Slot& slot = slots_.at(lists.free.offsets[i]);
        hits_[slot.index] = slot.best;
      }
      load(lists);
    }
  }

  /// Takes the topmost entry that is not behind the limit, a register of them looked at at once.
  HWY_INLINE WideReference pop_step(Slot& slot) {
    using D = hn::CappedTag<std::int32_t, 8>;
    const D d;
    constexpr std::uint32_t lanes = lanes_of<D>;
    const auto limit = hn::Set(d, Steps::key_limit(slot.t_limit));
    const std::int32_t* keys = slots_.keys(slot);
    std::uint32_t top = slot.top;
    std::uint32_t keep = 0;
    while (true) {
      keep = ~bits_of(d, hn::Gt(hn::LoadU(d, keys + top - lanes), limit)) & ((1u << lanes) - 1);
      if (HWY_LIKELY(keep != 0)) break;
      top -= lanes;
    }
    top = top - lanes + static_cast<std::uint32_t>(std::bit_width(keep)) - 1;
    slot.top = top;
    slot.next = slots_.references(slot)[top];
    return slot.next;
  }

  const WideView& view_;
  std::span<const Ray> rays_;
  std::span<Hit> hits_;
  Slots slots_;
  IncomingRays<Store::row_bytes> incoming_;
  Lists groups_[ray_groups];
};

/// Any hits of a whole batch: no order, no distances; the top of the stack is always what comes next.
template <class Steps, bool Prefetch>
class AnyBatch {
  using Store = typename Steps::Store;

 public:
  AnyBatch(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked, std::byte* memory)
      : view_(view), blocked_(blocked), slots_(memory, view.stack), incoming_(rays, view) {}

  void run() {
    const int in_flight = slots_.in_flight();
    for (int i = 0; i < in_flight; ++i) groups_[i % ray_groups].free.add(slots_.offset(i));
    for (Lists& lists : groups_) load(lists);
    take_turns(
        groups_, [&](Lists& lists) { begin(lists); }, [&](Lists& lists) { end(lists); });
  }

 private:
  HWY_INLINE void load(Lists& lists) {
    const auto skip = [&](const Slot&, bool valid, std::uint32_t index) HWY_ATTR {
      blocked_[index] = 0;
      return !valid;
    };
    incoming_.fill(slots_, lists.free, lists.nodes, skip);
  }

  void begin(Lists& lists) {
    const bool at_nodes = lists.last == Lists::Pass::nodes;
    if (at_nodes) {
      Steps::any_pass(slots_, view_, lists.nodes, lists.next);
    } else {
      LeafSteps<Store>::any_pass(slots_, view_, lists.leaves, [&](std::uint32_t i, Slot& slot, bool found) HWY_ATTR {
        blocked_[slot.index] = found ? 1 : 0;
        slot.top -= found ? 0 : 1;
        slot.next = slots_.references(slot)[slot.top];
        lists.next[i] = found ? wide_finished : slot.next;
      });
    }
    if constexpr (Prefetch) prefetch_next<Store>(view_, lists.next, at_nodes ? lists.nodes.size : lists.leaves.size);
  }

  void end(Lists& lists) {
    if (lists.last == Lists::Pass::none) return;
    SlotList& from = lists.last == Lists::Pass::nodes ? lists.nodes : lists.leaves;
    const std::uint32_t size = std::exchange(from.size, 0);
    split(from.offsets, size, lists.next, lists.nodes, lists.leaves, lists.free);
    load(lists);
  }

  const WideView& view_;
  std::span<std::uint8_t> blocked_;
  Slots slots_;
  IncomingRays<Store::row_bytes> incoming_;
  Lists groups_[ray_groups];
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
