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
#include "layout/simd/sort-inl.h"
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

  template <int Most>
  using Both = hn::FixedTag<std::uint32_t, 2 * Most>;

  /// The first lanes.
  template <int Most>
  static HWY_INLINE auto first(hn::Vec<Ints16> v) {
    const auto eight = hn::LowerHalf(Ints8(), v);
    if constexpr (Most == 8)
      return eight;
    else
      return hn::LowerHalf(hn::Half<Ints8>(), eight);
  }
  template <int Most, class D>
  static HWY_INLINE hn::Vec<D> sort_each(D d, hn::Vec<D> keys) {
    if constexpr (Most == 8)
      return sort8_descending(d, keys);
    else
      return sort4_descending(d, keys);
  }
  /// Looks lanes up in two registers, those of `b` from 16 on.
  static HWY_INLINE hn::Vec<Both<8>> of_both(hn::Vec<Words16> a, hn::Vec<Words16> b, hn::Vec<Both<8>> index) {
    return hn::Vec<Both<8>>{_mm512_permutex2var_epi32(a.raw, index.raw, b.raw)};
  }
  static HWY_INLINE hn::Vec<Both<4>> of_both(hn::Vec<Words16> a, hn::Vec<Words16> b, hn::Vec<Both<4>> index) {
    const __m512i wide = _mm512_permutex2var_epi32(a.raw, _mm512_castsi256_si512(index.raw), b.raw);
    return hn::Vec<Both<4>>{_mm512_castsi512_si256(wide)};
  }

  /// Puts the children that two rays met above the tops of their stacks, the nearest last: at most `Most` each, which
  /// is how many are stored.
  template <int Most>
  static HWY_INLINE void push(const Slots& slots, const Node& node_a, const Node& node_b, hn::Vec<Ints16> met_a,
                              hn::Vec<Ints16> met_b, Slot& a, Slot& b) {
    const hn::FixedTag<std::int32_t, 2 * Most> both;
    const hn::Half<decltype(both)> each;
    const hn::RebindToUnsigned<decltype(each)> words;
    const auto sorted = sort_each<Most>(both, hn::Combine(both, first<Most>(met_b), first<Most>(met_a)));
    // Of the children of both nodes, one after the other.
    const auto second_half = hn::And(hn::Iota(both, 0), hn::Set(both, Most));
    constexpr int shift = Most == 4 ? 2 : 1;
    const auto index = hn::Or(hn::And(sorted, hn::Set(both, 15)), hn::ShiftLeft<shift>(second_half));
    const auto children =
        of_both(node_a.children(Floats16(), 0), node_b.children(Floats16(), 0), hn::BitCast(Both<Most>(), index));
    hn::StoreU(hn::LowerHalf(each, sorted), each, slots.keys(a) + a.top);
    hn::StoreU(hn::UpperHalf(each, sorted), each, slots.keys(b) + b.top);
    hn::StoreU(hn::LowerHalf(words, children), words, slots.references(a) + a.top);
    hn::StoreU(hn::UpperHalf(words, children), words, slots.references(b) + b.top);
  }

  /// Two rays: each pushes all children it met, nearest on top, and takes the top. Both may be the same ray.
  static HWY_INLINE void closest_pair(const Slots& slots, const WideView& view, Slot& a, Slot& b, std::uint32_t* next) {
    const Node node_a(view, a.next), node_b(view, b.next);
    const Met met_a = meet(node_a, a), met_b = meet(node_b, b);
    if (HWY_UNLIKELY(std::max(met_a.count, met_b.count) > 8)) {
      push_many(slots, node_a, met_a.keys, met_a.count, a);
      if (&a != &b) push_many(slots, node_b, met_b.keys, met_b.count, b);
      next[0] = a.next;
      next[1] = b.next;
      return;
    }
    if (HWY_LIKELY(std::max(met_a.count, met_b.count) <= 4))
      push<4>(slots, node_a, node_b, met_a.keys, met_b.keys, a, b);
    else
      push<8>(slots, node_a, node_b, met_a.keys, met_b.keys, a, b);
    const std::uint32_t top_b = b.top;  // read before a is changed, which may be the same
    next[0] = take(slots.references(a), a.top, met_a.count, a);
    next[1] = take(slots.references(b), top_b, met_b.count, b);
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
