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

/// Largest first.
template <class V>
HWY_INLINE V sort8_descending(V v) {
  const hn::FixedTag<std::int32_t, 8> d;
  const hn::FixedTag<std::int64_t, 4> pairs;
  // The larger of a lane and its partner goes to the lower of the two places.
  const auto neighbours = [&](V partner) { return hn::OddEven(hn::Min(v, partner), hn::Max(v, partner)); };
  const auto across_pairs = [&](V partner) {
    return hn::BitCast(d,
                       hn::OddEven(hn::BitCast(pairs, hn::Min(v, partner)), hn::BitCast(pairs, hn::Max(v, partner))));
  };
  const auto across_halves = [&](V partner) {
    return hn::ConcatUpperLower(d, hn::Min(v, partner), hn::Max(v, partner));
  };
  v = neighbours(hn::Shuffle2301(v));
  v = across_pairs(hn::Shuffle0123(v));
  v = neighbours(hn::Shuffle2301(v));
  v = across_halves(hn::Shuffle0123(hn::ConcatLowerUpper(d, v, v)));
  v = across_pairs(hn::Shuffle1032(v));
  return neighbours(hn::Shuffle2301(v));
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
