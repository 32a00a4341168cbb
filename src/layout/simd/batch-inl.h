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

#include <algorithm>
#include <span>

#include "layout/simd/leaf_steps-inl.h"
#include "layout/simd/load_rays-inl.h"
#include "layout/simd/single-inl.h"
#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// What the rays of a batch need next, and what the pass at work found out.
struct Lists {
  enum class Pass { none, nodes, leaves, pops };

  SlotList nodes, leaves, pops, free;

  /// Of the rays in the list at work; there is room for whole vectors behind the last, and for `Ahead` before the
  /// first.
  HWY_INLINE WideReference* next() { return next_ + room_before; }

  /// The longest list.
  HWY_INLINE Pass longest() const {
    if (nodes.size + leaves.size + pops.size == 0) return Pass::none;
    if (nodes.size >= leaves.size && nodes.size >= pops.size) return Pass::nodes;
    return pops.size >= leaves.size ? Pass::pops : Pass::leaves;
  }

  static constexpr int room_before = 16;

 private:
  alignas(64) WideReference next_[room_before + most_in_flight + 16];
};

/// Fetches what a pass puts at `next`, for trees that are not in the cache. In the pass's own loop, since the end of
/// another would be mispredicted, but some steps behind, since what is not known yet would hold up what comes after it.
template <class Store, bool Prefetch>
class Ahead {
 public:
  HWY_INLINE Ahead(const WideView& view, WideReference* next) : view_(view), next_(next) {
    if constexpr (Prefetch) std::fill_n(next - behind, behind, WideReference{0});
  }
  /// After a step that put something at next[i], and at what follows if rays take steps together.
  template <int Together>
  HWY_INLINE void stepped(std::uint32_t i) const {
    if constexpr (Prefetch) fetch<Together>(next_ + i);
  }
  /// After the last.
  HWY_INLINE void finish(std::uint32_t size) const {
    if constexpr (Prefetch) fetch<behind>(next_ + size);
  }

 private:
  static constexpr int behind = 8;
  static_assert(behind <= Lists::room_before);

  template <int Count>
  HWY_INLINE void fetch(const WideReference* end) const {
    for (int i = 0; i < Count; ++i) Store::prefetch(view_, end[i - behind]);
  }

  const WideView& view_;
  WideReference* next_;
};

/// Closest hits of a whole batch. Steps: how rays pass nodes.
template <class Steps, bool Prefetch>
class ClosestBatch {
  using Store = typename Steps::Store;

 public:
  ClosestBatch(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits, std::byte* memory)
      : view_(view), rays_(rays), hits_(hits), slots_(memory, view.stack), incoming_(rays, view) {}

  void run() {
    lists_.free.add_all(slots_);
    load();
    for (Lists::Pass longest = lists_.longest(); longest != Lists::Pass::none; longest = lists_.longest()) {
      pass(longest);
      sort_out(longest);
    }
  }

 private:
  /// Puts the next rays that the lists can serve into free slots.
  HWY_INLINE void load() { incoming_.fill(slots_, lists_.free, lists_.nodes, Arrivals{*this}); }

  /// What happens to rays that come.
  struct Arrivals {
    static constexpr StackEntry bottom{wide_finished, -1};
    ClosestBatch& batch;

    /// Keys order by their bits, which negative distances do not do.
    static HWY_INLINE std::uint32_t admitted(const LoadedRays& loaded) { return loaded.valid & loaded.forward; }
    HWY_INLINE void expect(std::uint32_t index) const { __builtin_prefetch(&batch.hits_[index], 1); }
    HWY_INLINE void refuse(std::uint32_t index) const {
      const PreparedRay ray = prepare(batch.rays_[index], batch.view_.reach);
      batch.hits_[index] = closest_hit<Store>(batch.view_, ray, CountNothing{});
    }
  };

  /// All rays of the longest list take a step.
  HWY_NOINLINE void pass(Lists::Pass longest) {
    switch (longest) {
      case Lists::Pass::nodes:
        return pass_nodes(lists_.nodes);
      case Lists::Pass::leaves:
        return LeafSteps<Store>::closest_pass(slots_, view_, lists_.leaves);
      case Lists::Pass::pops:
        return pass_pops(lists_.pops);
      case Lists::Pass::none:
        return;
    }
  }

  HWY_INLINE void pass_nodes(SlotList& list) {
    // Copies stay in registers; members would be read again after every store of a step.
    const WideView view = view_;
    const Slots slots = slots_;
    WideReference* const next = lists_.next();
    const Ahead<Store, Prefetch> ahead(view, next);
    list.repeat_last();
    const std::uint32_t size = list.size;
    const std::uint32_t* offsets = list.offsets;
    std::uint32_t i = 0;
    for (; i < size; i += Steps::together) {
      Steps::closest(slots, view, offsets + i, next + i);
      ahead.template stepped<Steps::together>(i);
    }
    ahead.finish(i);
  }

  HWY_INLINE void pass_pops(const SlotList& list) {
    const WideView view = view_;  // copies, as above
    const Slots slots = slots_;
    const std::uint32_t size = list.size;
    WideReference* const next = lists_.next();
    const Ahead<Store, Prefetch> ahead(view, next);
    for (std::uint32_t i = 0; i < size; ++i) {
      next[i] = pop_step(slots.at(list.offsets[i]));
      ahead.template stepped<1>(i);
    }
    ahead.finish(size);
  }

  /// Puts the rays that were in the longest list into those of what they need now, and those that are done out.
  HWY_INLINE void sort_out(Lists::Pass longest) {
    if (longest == Lists::Pass::leaves) return append(lists_.leaves, lists_.pops);
    if (longest == Lists::Pass::nodes) {
      const std::uint32_t size = std::exchange(lists_.nodes.size, 0);
      return split(lists_.nodes.offsets, size, lists_.next(), lists_.nodes, lists_.leaves, lists_.pops);
    }
    const std::uint32_t size = std::exchange(lists_.pops.size, 0);
    const std::uint32_t free = lists_.free.size;
    split(lists_.pops.offsets, size, lists_.next(), lists_.nodes, lists_.leaves, lists_.free);
    for (std::uint32_t i = free; i < lists_.free.size; ++i) {
      const Slot& slot = slots_.at(lists_.free.offsets[i]);
      hits_[slot.index] = slot.best;
    }
    load();
  }

  /// Takes the topmost entry that is not behind the limit, a register of them looked at at once.
  static HWY_INLINE WideReference pop_step(Slot& slot) {
    const hn::CappedTag<std::int64_t, 8> d;
    constexpr auto lanes = static_cast<std::uint32_t>(lanes_of<decltype(d)>);
    // Keys are the upper halves.
    const auto limit = hn::Set(d, (std::int64_t{Steps::key_limit(slot.t_limit)} << 32) | 0xffffffff);
    auto* top = top_of<StackEntry>(slot);
    std::uint32_t keep = 0;
    while (true) {
      const auto looked_at = hn::LoadU(d, reinterpret_cast<const std::int64_t*>(top - lanes));
      keep = ~bits_of(d, hn::Gt(looked_at, limit)) & ((1u << lanes) - 1);
      if (HWY_LIKELY(keep != 0)) break;
      top -= lanes;
    }
    top = top - lanes + std::bit_width(keep) - 1;
    slot.top = top;
    return slot.next = top->reference;
  }

  const WideView& view_;
  std::span<const Ray> rays_;
  std::span<Hit> hits_;
  Slots slots_;
  IncomingRays<Store::row_bytes, StackEntry> incoming_;
  Lists lists_;
};

/// Any hits of a whole batch: no order, no distances; the top of the stack is always what comes next.
template <class Steps, bool Prefetch>
class AnyBatch {
  using Store = typename Steps::Store;

 public:
  AnyBatch(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked, std::byte* memory)
      : view_(view), blocked_(blocked), slots_(memory, view.stack), incoming_(rays, view) {}

  void run() {
    std::ranges::fill(blocked_, std::uint8_t{0});
    lists_.free.add_all(slots_);
    load();
    while (true) {
      const Lists::Pass longest = lists_.longest();
      if (longest == Lists::Pass::none) return;
      SlotList& list = longest == Lists::Pass::nodes ? lists_.nodes : lists_.leaves;
      if (longest == Lists::Pass::nodes)
        pass_nodes();
      else
        pass_leaves();
      const std::uint32_t size = std::exchange(list.size, 0);
      split(list.offsets, size, lists_.next(), lists_.nodes, lists_.leaves, lists_.free);
      load();
    }
  }

 private:
  HWY_INLINE void load() { incoming_.fill(slots_, lists_.free, lists_.nodes, Arrivals()); }

  struct Arrivals {
    static constexpr WideReference bottom = wide_finished;

    static HWY_INLINE std::uint32_t admitted(const LoadedRays& loaded) { return loaded.valid; }
    HWY_INLINE void expect(std::uint32_t) const {}
    HWY_INLINE void refuse(std::uint32_t) const {}
  };

  HWY_INLINE void pass_nodes() {
    WideReference* const next = lists_.next();
    const Ahead<Store, Prefetch> ahead(view_, next);
    for (std::uint32_t i = 0; i < lists_.nodes.size; ++i) {
      next[i] = Steps::any(view_, slots_.at(lists_.nodes.offsets[i]));
      ahead.template stepped<1>(i);
    }
    ahead.finish(lists_.nodes.size);
  }

  HWY_INLINE void pass_leaves() {
    WideReference* const next = lists_.next();
    const Ahead<Store, Prefetch> ahead(view_, next);
    LeafSteps<Store>::any_pass(slots_, view_, lists_.leaves, [&](std::uint32_t i, Slot& slot, bool found) HWY_ATTR {
      // Arithmetic, lest the compiler make a branch that goes as the hits do.
      static_assert(wide_finished == 1);
      const auto done = static_cast<std::uint32_t>(found);
      blocked_[slot.index] = static_cast<std::uint8_t>(done);
      next[i] = (take_last(top_of<WideReference>(slot) + done, slot) & (done - 1)) | done;
      ahead.template stepped<1>(i);
    });
    ahead.finish(lists_.leaves.size);
  }

  const WideView& view_;
  std::span<std::uint8_t> blocked_;
  Slots slots_;
  IncomingRays<Store::row_bytes, WideReference> incoming_;
  Lists lists_;
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
