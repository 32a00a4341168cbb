// Steps of rays in flight through nodes of eight children. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_STEPS8_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_STEPS8_INL_H
#undef BOXWOOD_LAYOUT_SIMD_STEPS8_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_STEPS8_INL_H
#endif

#include "layout/simd/open_node-inl.h"
#include "layout/simd/slots-inl.h"
#include "layout/simd/sort-inl.h"
#include "layout/simd/wide_node.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// Writes eight entries.
HWY_INLINE void store_eight(hn::Vec<Words8> references, hn::Vec<Words8> keys, StackEntry* place) {
  const Words8 d;
  const auto low = hn::InterleaveLower(d, references, keys), high = hn::InterleaveUpper(d, references, keys);
  auto* const words = reinterpret_cast<std::uint32_t*>(place);
  hn::StoreU(hn::ConcatLowerLower(d, high, low), d, words);
  hn::StoreU(hn::ConcatUpperUpper(d, high, low), d, words + 8);
}

/// What one register does: eight children of a node.
struct EightChildren {
  using Floats8 = hn::FixedTag<float, 8>;
  using Ints8 = hn::FixedTag<std::int32_t, 8>;

  static HWY_INLINE std::int32_t key_limit(float t_limit) { return std::bit_cast<std::int32_t>(t_limit) | 7; }

  /// Stores eight children at the top of a stack, those met first, the nearest of them last. Returns how many were met.
  static HWY_INLINE std::uint32_t push(const BoxHits<Floats8>& hits, hn::Vec<Words8> children, StackEntry* top) {
    const Ints8 di;
    const Words8 dw;
    // Missed children become the least of all keys: they end behind the others and are never read.
    const auto key = hn::Or(hn::And(hn::BitCast(di, hits.entry), hn::Set(di, ~7)), hn::Iota(di, 0));
    const auto miss = hn::Set(di, std::numeric_limits<std::int32_t>::min());
    const auto sorted = sort8_descending(di, hn::IfThenElse(hn::RebindMask(di, hits.hit), key, miss));
    const auto lanes = hn::IndicesFromVec(dw, hn::BitCast(dw, hn::And(sorted, hn::Set(di, 7))));
    store_eight(hn::TableLookupLanes(children, lanes), hn::BitCast(dw, sorted), top);
    return static_cast<std::uint32_t>(std::popcount(bits_of(Floats8(), hits.hit)));
  }
};

/// Takes the top after `count` children were pushed at `top`; nothing when none was.
HWY_INLINE WideReference take(StackEntry* top, std::size_t count, Slot& slot) {
  const std::size_t some = (count + 0xff) >> 8;  // 1 when any was; arithmetic, lest the compiler make a branch
  top += count - some;
  slot.top = top;
  return slot.next = top->reference & (0u - static_cast<std::uint32_t>(some));
}

template <class StoreType>
struct Steps8 {
  using Store = StoreType;

  static HWY_INLINE std::int32_t key_limit(float t_limit) { return EightChildren::key_limit(t_limit); }

  /// Rays that take a step together.
  static constexpr std::uint32_t together = 1;

  /// Pushes all children met, nearest on top, and takes the top; nothing when none was met. One step of some 80
  /// instructions: cut into three shorter passes it was a tenth slower.
  static HWY_INLINE void closest(const Slots& slots, const WideView& view, const std::uint32_t* offsets,
                                 WideReference* next) {
    Slot& slot = slots.at(*offsets);
    const EightChildren::Floats8 d;
    const OpenNode<Store> node(view, slot.next);
    StackEntry* const top = top_of<StackEntry>(slot);
    *next = take(top, EightChildren::push(node.hit(d, 0, slot), node.children(d, 0), top), slot);
  }

  /// Any hit: pushes the children met in no order, and takes the top of the stack.
  static HWY_INLINE WideReference any(const WideView& view, Slot& slot) {
    const EightChildren::Floats8 d;
    const OpenNode<Store> node(view, slot.next);
    const auto hits = node.hit(d, 0, slot);
    auto* const top = top_of<WideReference>(slot);
    return take_last(top + compress_store(node.children(d, 0), hn::RebindMask(Words8(), hits.hit), top), slot);
  }
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
