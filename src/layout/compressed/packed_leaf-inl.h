// Unpacks leaves that hold their own corners. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H
#undef BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H
#else
#define BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H
#endif

#include <cstring>

#include "layout/compressed/packed_leaf.h"
#include "layout/simd/lanes-inl.h"
#include "layout/simd/wide_node.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// `value` shifted to the left by 32 less `shift`, which is below 32: by 0 to nothing.
template <class D>
HWY_INLINE hn::Vec<D> shift_from_above(D d, hn::Vec<D> value, hn::Vec<D> shift) {
#if HWY_TARGET <= HWY_AVX2
  return hn::Shl(value, hn::Sub(hn::Set(d, 32), shift));
#else
  return hn::ShiftLeft<1>(hn::Shl(value, hn::Sub(hn::Set(d, 31), shift)));
#endif
}

/// A register full of numbers, each from the bit `place` of a stream on. Two words hold any of them: the one it begins
/// in and the next.
template <class D>
HWY_INLINE hn::Vec<D> unpack_at(D d, const std::uint32_t* words, hn::Vec<D> place, hn::Vec<D> mask) {
  const auto word = hn::IndicesFromVec(d, hn::ShiftRight<5>(place));
  const auto shift = hn::And(place, hn::Set(d, 31));
  const auto low = hn::Shr(hn::TableLookupLanes(hn::LoadU(d, words), word), shift);
  const auto high = shift_from_above(d, hn::TableLookupLanes(hn::LoadU(d, words + 1), word), shift);
  return hn::And(hn::Or(low, high), mask);
}

/// A register full of numbers of `bits` bits each, from bit `begin` of a stream on.
template <class D>
HWY_INLINE hn::Vec<D> unpack_bits(D d, const std::uint32_t* words, std::uint32_t begin, std::uint32_t bits) {
  const auto place = hn::Add(hn::Mul(hn::Iota(d, 0), hn::Set(d, bits)), hn::Set(d, begin & 31));
  return unpack_at(d, words + (begin >> 5), place,
                   hn::Set(d, static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1)));
}

/// Which corner is vertex `vertex` of each triangle from `begin` on.
template <class D>
HWY_INLINE hn::Vec<D> unpack_indices(D d, const std::uint32_t* words, int vertex, std::uint32_t begin) {
  const auto packed = hn::Set(d, words[PackedLeafHead::begin_of_indices / 32 + vertex] >> 4 * begin);
  return hn::And(hn::Shr(packed, hn::ShiftLeft<2>(hn::Iota(d, 0))), hn::Set(d, 15));
}

/// The base of an axis in every lane: the upper half of the word that ends with it.
template <class D>
HWY_INLINE hn::Vec<D> base_of(D d, const std::uint32_t* words, int axis) {
  std::uint32_t word;
  constexpr std::size_t before = PackedLeafHead::begin_of_bases / 8 - 2;
  std::memcpy(&word, reinterpret_cast<const std::byte*>(words) + before + 2 * axis, sizeof word);
  return hn::And(hn::Set(d, word), hn::Set(d, 0xffff0000));
}

#if HWY_TARGET <= HWY_AVX3

/// All corners lie in one register per axis.
HWY_INLINE void unpack_corners(const std::uint32_t* words, const PackedLeafHead& head, LeafBlock<8>& out) {
  const hn::FixedTag<float, 16> d;
  const hn::FixedTag<std::uint32_t, 16> du;
  const hn::FixedTag<float, 8> half;
  const hn::Vec<decltype(du)> index[3] = {unpack_indices(du, words, 0, 0), unpack_indices(du, words, 1, 0),
                                          unpack_indices(du, words, 2, 0)};
  std::uint32_t begin = PackedLeafHead::begin_of_corners;
  for (int axis = 0; axis < 3; ++axis) {
    const auto differences = unpack_bits(du, words, begin, head.bits[axis]);
    const auto corners = hn::BitCast(d, hn::Add(differences, base_of(du, words, axis)));
    for (int vertex = 0; vertex < 3; ++vertex) {
      const auto of_triangles = hn::TableLookupLanes(corners, hn::IndicesFromVec(d, index[vertex]));
      hn::Store(hn::LowerHalf(half, of_triangles), half, out.vertices[vertex][axis]);
    }
    begin += head.corners * head.bits[axis];
  }
}

#else

HWY_INLINE void unpack_corners(const std::uint32_t* words, const PackedLeafHead& head, LeafBlock<8>& out) {
  using D = hn::CappedTag<float, 8>;
  const D d;
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  alignas(64) float corners[3][most_packed_corners];
  std::uint32_t begin = PackedLeafHead::begin_of_corners;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t i = 0; i < head.corners; i += lanes_of<D>) {
      const auto differences = unpack_bits(du, words, begin + i * head.bits[axis], head.bits[axis]);
      hn::Store(hn::BitCast(d, hn::Add(differences, base_of(du, words, axis))), d, corners[axis] + i);
    }
    begin += head.corners * head.bits[axis];
  }
  for (int vertex = 0; vertex < 3; ++vertex) {
    for (std::uint32_t i = 0; i < 8; i += lanes_of<D>) {
      const auto index = hn::BitCast(di, unpack_indices(du, words, vertex, i));
      for (int axis = 0; axis < 3; ++axis) {
        hn::Store(hn::GatherIndex(d, corners[axis], index), d, out.vertices[vertex][axis] + i);
      }
    }
  }
}

#endif

/// The number of one triangle of a packed leaf.
HWY_INLINE std::uint32_t number_of_packed(const std::uint32_t* words, std::uint32_t triangle) {
  const PackedLeafHead head(words[0]);
  const std::uint32_t bits = head.bits[3], begin = head.begin_of_numbers() + triangle * bits;
  std::uint64_t two;
  std::memcpy(&two, words + (begin >> 5), sizeof two);
  return words[1] + static_cast<std::uint32_t>(two >> (begin & 31) & ((std::uint64_t{1} << bits) - 1));
}

/// A packed leaf, or a part of one.
HWY_INLINE void unpack_leaf(const std::uint32_t* words, LeafBlock<8>& out) {
  using D = hn::CappedTag<std::uint32_t, 8>;
  const D d;
  const PackedLeafHead head(words[0]);
  unpack_corners(words, head, out);
  const std::uint32_t begin = head.begin_of_numbers();
  for (std::uint32_t i = 0; i < 8; i += lanes_of<D>) {
    const auto differences = unpack_bits(d, words, begin + i * head.bits[3], head.bits[3]);
    hn::Store(hn::Add(differences, hn::Set(d, words[1])), d, out.primitives + i);
  }
  static_assert(packed_more == more_blocks);
  out.primitives[0] |= words[0] & packed_more;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
