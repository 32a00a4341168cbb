// Gathering selected lanes at the front. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_COMPRESS_INL_H
#undef BOXWOOD_LAYOUT_SIMD_COMPRESS_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_COMPRESS_INL_H
#endif

#include <bit>

#include "layout/simd/compress_table.h"
#include "layout/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

using Words8 = hn::FixedTag<std::uint32_t, 8>;
using WidestWords = hn::CappedTag<std::uint32_t, 16>;

/// Writes the selected lanes one after another, and unspecified ones behind them: a whole register. Returns how many
/// were selected. Neither of Highway's ways: its masked store is slow on some machines, and without AVX-512 GCC copies
/// the table that its Compress declares to the stack at every call.
template <class D = Words8>
HWY_INLINE std::uint32_t compress_store(hn::Vec<D> v, hn::Mask<D> selected, std::uint32_t* place) {
  const D d;
  const std::uint32_t bits = bits_of(d, selected);
#if HWY_TARGET <= HWY_AVX3
  hn::StoreU(hn::Compress(v, selected), d, place);
#else
  const hn::FixedTag<std::uint8_t, 8> bytes;
  const auto lanes = hn::PromoteTo(d, hn::Load(bytes, compress_table[bits].data()));
  hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes)), d, place);
#endif
  return static_cast<std::uint32_t>(std::popcount(bits));
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
