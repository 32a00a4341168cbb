// N lanes of float, in as many registers as the instruction set needs. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_LANES_INL_H
#undef BOXWOOD_LAYOUT_SIMD_LANES_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A register of at most N floats.
template <int N>
using Floats = hn::CappedTag<float, static_cast<std::size_t>(N)>;
template <class D>
constexpr int lanes_of = static_cast<int>(hn::MaxLanes(D()));

/// One bit per lane, lane 0 lowest.
template <class D, class Mask>
HWY_INLINE std::uint32_t bits_of(D d, Mask mask) {
#if HWY_TARGET <= HWY_AVX3
  (void)d;
  return static_cast<std::uint32_t>(mask.raw);
#endif
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  if constexpr (lanes_of<D> <= 8) return bytes[0];
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// a * b + c, rounded once: the same bits on every instruction set.
template <class D, class V>
HWY_INLINE V fused(D d, V a, V b, V c) {
#if HWY_NATIVE_FMA
  (void)d;
  return hn::MulAdd(a, b, c);
#else
  alignas(64) float x[lanes_of<D>], y[lanes_of<D>], z[lanes_of<D>];
  hn::Store(a, d, x);
  hn::Store(b, d, y);
  hn::Store(c, d, z);
  for (int lane = 0; lane < lanes_of<D>; ++lane) z[lane] = __builtin_fmaf(x[lane], y[lane], z[lane]);
  return hn::Load(d, z);
#endif
}

/// c - a * b, rounded once.
template <class D, class V>
HWY_INLINE V fused_negative(D d, V a, V b, V c) {
#if HWY_NATIVE_FMA
  (void)d;
  return hn::NegMulAdd(a, b, c);
#else
  return fused(d, hn::Neg(a), b, c);
#endif
}

/// a * b - c, rounded once.
template <class D, class V>
HWY_INLINE V fused_subtract(D d, V a, V b, V c) {
#if HWY_NATIVE_FMA
  (void)d;
  return hn::MulSub(a, b, c);
#else
  return fused(d, a, b, hn::Neg(c));
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
