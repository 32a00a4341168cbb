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

  static HWY_INLINE std::int32_t key_limit(float t_limit) { return std::bit_cast<std::int32_t>(t_limit) | 15; }

  /// The children met, as keys in the first lanes; the least key there is in the others.
  struct Met {
    hn::Vec<Ints16> keys;
    std::uint32_t count;
  };
  static HWY_INLINE Met meet(const Node& node, const Slot& slot) {
    const Ints16 d;
    const BoxHits<Floats16> hits = node.hit(Floats16(), 0, slot);
    const auto keys = hn::OrAnd(hn::Iota(d, 0), hn::BitCast(d, hits.entry), hn::Set(d, ~15));
    return {hn::Compress(keys, hn::RebindMask(d, hits.hit)),
            static_cast<std::uint32_t>(std::popcount(bits_of(Floats16(), hits.hit)))};
  }

  static HWY_INLINE hn::Vec<Words16> children_of(const Node& node, hn::Vec<Ints16> keys) {
    const Words16 d;
    return hn::TableLookupLanes(node.children(Floats16(), 0),
                                hn::IndicesFromVec(d, hn::And(hn::BitCast(d, keys), hn::Set(d, 15))));
  }

  /// One ray that met more than eight children: rare, so that branches cost little.
  static HWY_NOINLINE void push_many(const WideView& view, Slot& slot) {
    const Ints16 d;
    const Node node(view, slot.next);
    const auto [met, count] = meet(node, slot);
    alignas(64) std::int32_t keys[16];
    alignas(64) WideReference children[16];
    hn::Store(met, d, keys);
    std::sort(keys, keys + count, std::greater<>());
    hn::Store(children_of(node, hn::Load(d, keys)), Words16(), children);
    auto* const top = top_of<StackEntry>(slot);
    for (std::uint32_t i = 0; i < count; ++i) top[i] = {children[i], keys[i]};
    take(top, count, slot);
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
  static HWY_INLINE void push(const Node& node_a, const Node& node_b, hn::Vec<Ints16> met_a, hn::Vec<Ints16> met_b,
                              StackEntry* a, StackEntry* b) {
    const hn::FixedTag<std::int32_t, 2 * Most> both;
    const auto sorted = sort_each<Most>(both, hn::Combine(both, first<Most>(met_b), first<Most>(met_a)));
    // Of the children of both nodes, one after the other.
    const auto second_half = hn::And(hn::Iota(both, 0), hn::Set(both, Most));
    constexpr int shift = Most == 4 ? 2 : 1;
    const auto index = hn::Or(hn::And(sorted, hn::Set(both, 15)), hn::ShiftLeft<shift>(second_half));
    const auto children =
        of_both(node_a.children(Floats16(), 0), node_b.children(Floats16(), 0), hn::BitCast(Both<Most>(), index));
    const Both<Most> words;
    const auto keys = hn::BitCast(words, sorted);
    if constexpr (Most == 8) {
      const Words8 half;
      store_eight(hn::LowerHalf(half, children), hn::LowerHalf(half, keys), a);
      store_eight(hn::UpperHalf(half, children), hn::UpperHalf(half, keys), b);
    } else {
      const auto low = hn::InterleaveLower(words, children, keys), high = hn::InterleaveUpper(words, children, keys);
      hn::StoreU(hn::ConcatLowerLower(words, high, low), words, reinterpret_cast<std::uint32_t*>(a));
      hn::StoreU(hn::ConcatUpperUpper(words, high, low), words, reinterpret_cast<std::uint32_t*>(b));
    }
  }

  /// Rays that take a step together. An odd last one is its own partner.
  static constexpr std::uint32_t together = 2;

  /// Two rays: each pushes all children it met, nearest on top, and takes the top.
  static HWY_INLINE void closest(const Slots& slots, const WideView& view, const std::uint32_t* offsets,
                                 WideReference* next) {
    Slot &a = slots.at(offsets[0]), &b = slots.at(offsets[1]);
    const Node node_a(view, a.next), node_b(view, b.next);
    const Met met_a = meet(node_a, a), met_b = meet(node_b, b);
    if (HWY_UNLIKELY(std::max(met_a.count, met_b.count) > 8)) {
      push_many(view, a);
      if (&a != &b) push_many(view, b);
      next[0] = a.next;
      next[1] = b.next;
      return;
    }
    // Read before anything is changed: both may be the same ray.
    auto *const top_a = top_of<StackEntry>(a), *const top_b = top_of<StackEntry>(b);
    if (HWY_LIKELY(std::max(met_a.count, met_b.count) <= 4))
      push<4>(node_a, node_b, met_a.keys, met_b.keys, top_a, top_b);
    else
      push<8>(node_a, node_b, met_a.keys, met_b.keys, top_a, top_b);
    next[0] = take(top_a, met_a.count, a);
    next[1] = take(top_b, met_b.count, b);
  }

  /// Any hit: pushes the children met in no order, and takes the top of the stack.
  static HWY_INLINE WideReference any(const WideView& view, Slot& slot) {
    const Floats16 d;
    const Node node(view, slot.next);
    const auto hit = hn::RebindMask(Words16(), node.hit(d, 0, slot).hit);
    auto* const top = top_of<WideReference>(slot);
    return take_last(top + compress_store<Words16>(node.children(d, 0), hit, top), slot);
  }
};

#elif HWY_MAX_BYTES >= 32

template <class StoreType>
struct Steps16 {
  using Store = StoreType;

  static HWY_INLINE std::int32_t key_limit(float t_limit) { return EightChildren::key_limit(t_limit); }

  static constexpr std::uint32_t together = 1;

  /// Each half in order, and the nearest of both on top.
  static HWY_INLINE void closest(const Slots& slots, const WideView& view, const std::uint32_t* offsets,
                                 WideReference* next) {
    const EightChildren::Floats8 d;
    Slot& slot = slots.at(*offsets);
    const OpenNode<Store> node(view, slot.next);
    auto* const top = top_of<StackEntry>(slot);
    const std::uint32_t first = EightChildren::push(node.hit(d, 0, slot), node.children(d, 0), top);
    const std::uint32_t second = EightChildren::push(node.hit(d, 8, slot), node.children(d, 8), top + first);
    // The last of the first half and the last of all change places when the former is nearer. Where there is none, both
    // are the same.
    const int last = static_cast<int>(first + second) - 1, end_of_first = static_cast<int>(first) - 1;
    const bool swap = (first != 0) & (second != 0) & (top[end_of_first].key < top[last].key);
    std::swap(top[swap ? end_of_first : last], top[last]);
    *next = take(top, first + second, slot);
  }

  static HWY_INLINE WideReference any(const WideView& view, Slot& slot) {
    const EightChildren::Floats8 d;
    const OpenNode<Store> node(view, slot.next);
    const auto met = [&](int begin) { return hn::RebindMask(Words8(), node.hit(d, begin, slot).hit); };
    auto* top = top_of<WideReference>(slot);
    top += compress_store(node.children(d, 0), met(0), top);
    return take_last(top + compress_store(node.children(d, 8), met(8), top), slot);
  }
};

#endif  // HWY_TARGET <= HWY_AVX3
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
