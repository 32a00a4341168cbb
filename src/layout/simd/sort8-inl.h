// Sorting eight integers inside a register: a bitonic network, six layers without branches. Compiled once per
// instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_SORT8_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_SORT8_INL_H
#undef BOXWOOD_LAYOUT_SIMD_SORT8_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_SORT8_INL_H
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

/// Each eight lanes on their own, largest first.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sort8_descending(D d, V v) {
  const hn::Repartition<std::int64_t, D> pairs;
  // The larger of a lane and its partner goes to the lower of the two places.
  const auto neighbours = [&](V partner) { return hn::OddEven(hn::Min(v, partner), hn::Max(v, partner)); };
  const auto across_pairs = [&](V partner) {
    return hn::BitCast(d,
                       hn::OddEven(hn::BitCast(pairs, hn::Min(v, partner)), hn::BitCast(pairs, hn::Max(v, partner))));
  };
  const auto across_halves = [&](V partner) { return upper_of_eight(d, hn::Min(v, partner), hn::Max(v, partner)); };
  v = neighbours(hn::Shuffle2301(v));
  v = across_pairs(hn::Shuffle0123(v));
  v = neighbours(hn::Shuffle2301(v));
  v = across_halves(hn::Shuffle0123(swap_halves_of_eight(d, v)));
  v = across_pairs(hn::Shuffle1032(v));
  return neighbours(hn::Shuffle2301(v));
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
