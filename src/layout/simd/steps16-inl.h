// Steps of rays in flight through nodes of sixteen children. With 512-bit registers one holds a ray's box tests, or the
// order of two rays' children; without, a node is two halves. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_STEPS16_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_STEPS16_INL_H
#undef BOXWOOD_LAYOUT_SIMD_STEPS16_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_STEPS16_INL_H
#endif

#include "layout/simd/open_node-inl.h"
#include "layout/simd/slots-inl.h"
#include "layout/simd/sort8-inl.h"
#include "layout/simd/steps8-inl.h"
#include "layout/simd/wide_node.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_TARGET <= HWY_AVX3

template <class StoreType>
struct Steps16 {
  using Store = StoreType;
  using Node = OpenNode<Store>;
  using Floats16 = hn::FixedTag<float, 16>;
  using Ints16 = hn::FixedTag<std::int32_t, 16>;
  using Words16 = hn::FixedTag<std::uint32_t, 16>;
  using Ints8 = hn::FixedTag<std::int32_t, 8>;

  /// Keys are above 0, which marks lanes that hold none.
  static HWY_INLINE std::int32_t key_limit(float t_limit) { return (std::bit_cast<std::int32_t>(t_limit) | 15) + 16; }

  /// The children met, as keys in the first lanes; 0 in the others.
  struct Met {
    hn::Vec<Ints16> keys;
    std::uint32_t count;
  };
  static HWY_INLINE Met meet(const Node& node, const Slot& slot) {
    const Ints16 d;
    const BoxHits<Floats16> hits = node.hit(Floats16(), 0, slot);
    const auto keys = hn::Add(hn::And(hn::BitCast(d, hits.entry), hn::Set(d, ~15)), hn::Iota(d, 16));
    return {hn::Compress(keys, hn::RebindMask(d, hits.hit)),
            static_cast<std::uint32_t>(std::popcount(bits_of(Floats16(), hits.hit)))};
  }

  static HWY_INLINE hn::Vec<Words16> children_of(const Node& node, hn::Vec<Ints16> keys) {
    const Words16 d;
    return hn::TableLookupLanes(node.children(Floats16(), 0),
                                hn::IndicesFromVec(d, hn::And(hn::BitCast(d, keys), hn::Set(d, 15))));
  }

  /// Takes the top after `count` children were pushed; nothing when none was.
  static HWY_INLINE WideReference take(const WideReference* references, std::uint32_t top, std::uint32_t count,
                                       Slot& slot) {
    const std::uint32_t some = (count + 0xff) >> 8;  // 1 when any was; arithmetic, lest the compiler make a branch
    slot.top = top + count - some;
    return slot.next = references[slot.top] & (0u - some);
  }

  /// One ray that met more than eight children: rare, so that branches cost little.
  static HWY_NOINLINE void push_many(const Slots& slots, const Node& node, hn::Vec<Ints16> met, std::uint32_t count,
                                     Slot& slot) {
    const Ints16 d;
    alignas(64) std::int32_t keys[16];
    alignas(64) WideReference children[16];
    hn::Store(met, d, keys);
    std::sort(keys, keys + count, std::greater<>());
    hn::Store(children_of(node, hn::Load(d, keys)), Words16(), children);
    std::copy_n(keys, count, slots.keys(slot) + slot.top);
    std::copy_n(children, count, slots.references(slot) + slot.top);
    take(slots.references(slot), slot.top, count, slot);
  }

  /// Two rays: each pushes all children it met, nearest on top, and takes the top. Both may be the same ray.
  static HWY_INLINE void closest_pair(const Slots& slots, const WideView& view, Slot& a, Slot& b, std::uint32_t* next) {
    const Ints16 d;
    const Ints8 half;
    const hn::Half<Words16> half_words;
    const Node node_a(view, a.next), node_b(view, b.next);
    const Met met_a = meet(node_a, a), met_b = meet(node_b, b);
    if (HWY_UNLIKELY(std::max(met_a.count, met_b.count) > 8)) {
      push_many(slots, node_a, met_a.keys, met_a.count, a);
      if (&a != &b) push_many(slots, node_b, met_b.keys, met_b.count, b);
      next[0] = a.next;
      next[1] = b.next;
      return;
    }
    const auto sorted =
        sort8_descending(d, hn::Combine(d, hn::LowerHalf(half, met_b.keys), hn::LowerHalf(half, met_a.keys)));
    const std::uint32_t top_a = a.top, top_b = b.top;
    WideReference* references_a = slots.references(a);
    WideReference* references_b = slots.references(b);
    hn::StoreU(hn::LowerHalf(half, sorted), half, slots.keys(a) + top_a);
    hn::StoreU(hn::UpperHalf(half, sorted), half, slots.keys(b) + top_b);
    hn::StoreU(hn::LowerHalf(half_words, children_of(node_a, sorted)), half_words, references_a + top_a);
    hn::StoreU(hn::UpperHalf(half_words, children_of(node_b, sorted)), half_words, references_b + top_b);
    next[0] = take(references_a, top_a, met_a.count, a);
    next[1] = take(references_b, top_b, met_b.count, b);
  }

  /// Any hit: pushes the children met in no order, and takes the top of the stack.
  static HWY_INLINE WideReference any(const Slots& slots, const WideView& view, Slot& slot) {
    const Floats16 d;
    const Node node(view, slot.next);
    const auto hit = hn::RebindMask(Words16(), node.hit(d, 0, slot).hit);
    WideReference* references = slots.references(slot);
    slot.top += compress_store<Words16>(node.children(d, 0), hit, references + slot.top) - 1;
    return slot.next = references[slot.top];
  }

  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, SlotList& list, std::uint32_t* next) {
    // An odd last ray is its own partner.
    list.offsets[list.size] = list.offsets[list.size - 1];
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      closest_pair(slots, view, slots.at(list.offsets[i]), slots.at(list.offsets[i + 1]), next + i);
    }
  }
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, SlotList& list, std::uint32_t* next) {
    for (std::uint32_t i = 0; i < list.size; ++i) next[i] = any(slots, view, slots.at(list.offsets[i]));
  }
};

#elif HWY_MAX_BYTES >= 32

template <class StoreType>
struct Steps16 {
  using Store = StoreType;

  static HWY_INLINE std::int32_t key_limit(float t_limit) { return EightChildren::key_limit(t_limit); }

  /// Each half in order, and the nearest of both on top.
  static HWY_INLINE WideReference closest(const Slots& slots, const WideView& view, Slot& slot) {
    const EightChildren::Floats8 d;
    const OpenNode<Store> node(view, slot.next);
    std::int32_t* keys = slots.keys(slot) + slot.top;
    WideReference* references = slots.references(slot) + slot.top;
    const std::uint32_t first = EightChildren::push(node.hit(d, 0, slot), node.children(d, 0), keys, references);
    const std::uint32_t second =
        EightChildren::push(node.hit(d, 8, slot), node.children(d, 8), keys + first, references + first);
    // The last of the first half and the last of all change places when the former is nearer. Where there is none, both
    // are the same.
    const int last = static_cast<int>(first + second) - 1, end_of_first = static_cast<int>(first) - 1;
    const bool swap = (first != 0) & (second != 0) & (keys[end_of_first] < keys[last]);
    const int other = swap ? end_of_first : last;
    std::swap(keys[other], keys[last]);
    std::swap(references[other], references[last]);
    return EightChildren::take(slots.references(slot), first + second, slot);
  }

  static HWY_INLINE WideReference any(const Slots& slots, const WideView& view, Slot& slot) {
    const EightChildren::Floats8 d;
    const OpenNode<Store> node(view, slot.next);
    const auto met = [&](int begin) { return hn::RebindMask(Words8(), node.hit(d, begin, slot).hit); };
    WideReference* references = slots.references(slot);
    slot.top += compress_store(node.children(d, 0), met(0), references + slot.top);
    slot.top += compress_store(node.children(d, 8), met(8), references + slot.top) - 1;
    return slot.next = references[slot.top];
  }

  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, SlotList& list, std::uint32_t* next) {
    for (std::uint32_t i = 0; i < list.size; ++i) next[i] = closest(slots, view, slots.at(list.offsets[i]));
  }
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, SlotList& list, std::uint32_t* next) {
    for (std::uint32_t i = 0; i < list.size; ++i) next[i] = any(slots, view, slots.at(list.offsets[i]));
  }
};

#endif  // HWY_TARGET <= HWY_AVX3
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
