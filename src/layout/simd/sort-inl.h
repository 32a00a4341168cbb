// Sorting four or eight integers inside a register: bitonic networks of three and six layers, without branches.
// Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_SORT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_SORT_INL_H
#undef BOXWOOD_LAYOUT_SIMD_SORT_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_SORT_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32
namespace hn = hwy::HWY_NAMESPACE;

/// Exchanges the halves of each eight lanes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V swap_halves_of_eight(D d, V v) {
#if HWY_TARGET <= HWY_AVX3
  if constexpr (hn::MaxLanes(D()) == 16)
    return V{_mm512_shuffle_i32x4(v.raw, v.raw, 0xb1)};
  else
#endif
    return hn::ConcatLowerUpper(d, v, v);
}

/// The upper four of each eight lanes from `upper`, the lower four from `lower`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V upper_of_eight(D d, V upper, V lower) {
#if HWY_TARGET <= HWY_AVX3
  if constexpr (hn::MaxLanes(D()) == 16)
    return V{_mm512_mask_blend_epi32(0xf0f0, lower.raw, upper.raw)};
  else
#endif
    return hn::ConcatUpperLower(d, upper, lower);
}

/// Exchanges the larger and the smaller of each lane and its partner, so that the larger gets to the lower place: of
/// two neighbours, of two lanes of different pairs.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V order_neighbours(D, V v) {
  const V partner = hn::Shuffle2301(v);
  return hn::OddEven(hn::Min(v, partner), hn::Max(v, partner));
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE V order_pairs(D d, V v, V partner) {
  const hn::Repartition<std::int64_t, D> pairs;
  return hn::BitCast(d, hn::OddEven(hn::BitCast(pairs, hn::Min(v, partner)), hn::BitCast(pairs, hn::Max(v, partner))));
}

/// Each four lanes on their own, largest first.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sort4_descending(D d, V v) {
  v = order_neighbours(d, v);
  return order_neighbours(d, order_pairs(d, v, hn::Shuffle0123(v)));
}

/// Each eight lanes on their own, largest first.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sort8_descending(D d, V v) {
  v = sort4_descending(d, v);
  const V partner = hn::Shuffle0123(swap_halves_of_eight(d, v));
  v = upper_of_eight(d, hn::Min(v, partner), hn::Max(v, partner));
  return order_neighbours(d, order_pairs(d, v, hn::Shuffle1032(v)));
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
