// Unpacks leaves that hold their own corners. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H
#undef BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H
#else
#define BOXWOOD_LAYOUT_COMPRESSED_PACKED_LEAF_INL_H
#endif

#include <algorithm>
#include <cstring>
#include <iterator>

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

/// A register full of words from any byte on.
template <class D>
HWY_INLINE hn::Vec<D> load_words(D d, const std::uint8_t* bytes) {
#if HWY_TARGET == HWY_SCALAR
  std::uint32_t word;
  std::memcpy(&word, bytes, sizeof word);
  return hn::Set(d, word);
#else
  return hn::BitCast(d, hn::LoadU(hn::Repartition<std::uint8_t, D>(), bytes));
#endif
}

/// A register full of numbers, each from the bit `place` of a stream on. Two words hold any of them: the one it begins
/// in and the next.
template <class D>
HWY_INLINE hn::Vec<D> unpack_at(D d, const std::uint8_t* stream, hn::Vec<D> place, hn::Vec<D> mask) {
  const auto word = hn::IndicesFromVec(d, hn::ShiftRight<5>(place));
  const auto shift = hn::And(place, hn::Set(d, 31));
  const auto low = hn::Shr(hn::TableLookupLanes(load_words(d, stream), word), shift);
  const auto high = shift_from_above(d, hn::TableLookupLanes(load_words(d, stream + 4), word), shift);
  return hn::And(hn::Or(low, high), mask);
}

template <class D>
HWY_INLINE hn::Vec<D> mask_of_bits(D d, std::uint32_t bits) {
  return hn::Set(d, static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1));
}

/// A register full of numbers of `bits` bits each, from bit `begin` of a stream on.
template <class D>
HWY_INLINE hn::Vec<D> unpack_bits(D d, const std::uint8_t* stream, std::uint32_t begin, std::uint32_t bits) {
  const auto place = hn::Add(hn::Mul(hn::Iota(d, 0), hn::Set(d, bits)), hn::Set(d, begin & 7));
  return unpack_at(d, stream + (begin >> 3), place, mask_of_bits(d, bits));
}

/// Of a leaf that is not tight, which corner is vertex `vertex` of each triangle, 4 bits each.
HWY_INLINE std::uint32_t indices_of(const std::uint32_t* words, int vertex) {
  return words[PackedLeafHead::begin_of_indices / 4 + vertex];
}

/// Likewise for the triangles from `begin` on, a lane each.
template <class D>
HWY_INLINE hn::Vec<D> unpack_indices(D d, const std::uint32_t* words, int vertex, std::uint32_t begin) {
  const auto packed = hn::Set(d, indices_of(words, vertex) >> 4 * begin);
  return hn::And(hn::Shr(packed, hn::ShiftLeft<2>(hn::Iota(d, 0))), hn::Set(d, 15));
}

/// What a tight leaf has before its corners, as other leaves have it.
struct SpreadHead {
  std::uint32_t words[16];

  HWY_INLINE void take(const std::uint32_t* tight) {
    using Head = PackedLeafHead;
    const std::uint32_t pairs = Head(tight[0]).pairs;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(tight);
    words[0] = tight[0];
    words[1] = tight[1];
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
      std::uint32_t indices;
      std::memcpy(&indices, bytes + Head::begin_of_indices + vertex * pairs, sizeof indices);
      words[2 + vertex] = indices & 0xffffffff >> (32 - 8 * pairs);
    }
    // To behind the most numbers there can be.
    std::memcpy(words + 5, bytes + Head::begin_of_bases(pairs), sizeof words - 5 * sizeof words[0]);
  }
};
static_assert(PackedLeafHead::begin_of_numbers(PackedLeafHead::all_pairs) + 7 * sizeof(std::uint32_t) <=
              sizeof(SpreadHead));

/// The base of an axis: its upper half is kept.
HWY_INLINE std::uint32_t base_of(const std::uint8_t* bases, int axis) {
  std::uint32_t word;
  std::memcpy(&word, bases + 2 * axis - 2, sizeof word);
  return word;
}

#if HWY_TARGET <= HWY_AVX3_DL

/// How to take numbers of each width from a register of bytes.
struct alignas(64) TakenBits {
  std::uint8_t bytes[64];  // four for each number, those that its bits are in
  std::uint32_t shifts[16];
};
struct TakenBitsTable {
  TakenBits of_code[32]{};
  std::uint32_t masks[32]{};

  constexpr TakenBitsTable() {
    for (std::uint32_t code = 0; code < 32; ++code) {
      const std::uint32_t bits = PackedLeafHead::bits_of_code[code];
      for (std::uint32_t i = 0; i < 64; ++i) {
        of_code[code].bytes[i] = static_cast<std::uint8_t>((i / 4 * bits / 8 + i % 4) % 64);
      }
      for (std::uint32_t i = 0; i < 16; ++i) of_code[code].shifts[i] = i * bits % 8;
      masks[code] = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    }
  }
};
inline constexpr TakenBitsTable taken_bits;

#endif

/// The corners of a packed leaf, an axis after the other. Tight: values of an axis may repeat.
template <class D, bool Tight>
class PackedCorners {
 public:
  HWY_INLINE explicit PackedCorners(const std::uint32_t* words)
      : bases_(reinterpret_cast<const std::uint8_t*>(words) + PackedLeafHead::begin_of_bases(head_of(words).pairs)),
        stream_(reinterpret_cast<const std::uint8_t*>(words) + head_of(words).begin_of_corners()),
        codes_(words[0] >> PackedLeafHead::begin_of_codes),
        corners_(head_of(words).corners) {}

  /// The next axis: calls use(i, the coordinates of a register full of corners from the i-th on). Lanes behind the last
  /// corner hold anything.
  template <class Use>
  HWY_INLINE void next(const Use& use) {
    const std::uint32_t code = codes_ & 31, bits = bits_of(code);
    if (Tight && PackedLeafHead::repeats(code)) {
      const std::uint32_t changes = PackedLeafHead::changes_at(stream_);
      stream_ += PackedLeafHead::bytes_of_changes;
      next_repeated(changes, code, use);
      stream_ += PackedLeafHead::bytes_of(static_cast<std::uint32_t>(std::popcount(changes)), bits);
    } else {
      for_each_register(corners_, code, use);
      stream_ += PackedLeafHead::bytes_of(corners_, bits);
    }
    codes_ >>= 5;
    ++axis_;
  }

 private:
  using Words = hn::RebindToUnsigned<D>;

  static HWY_INLINE PackedLeafHead head_of(const std::uint32_t* words) {
    PackedLeafHead head(words[0]);
    if constexpr (!Tight) head.pairs = PackedLeafHead::all_pairs;
    return head;
  }
  /// Of codes of leaves that are not tight by arithmetic, which takes less time than the table.
  static HWY_INLINE std::uint32_t bits_of(std::uint32_t code) {
    return Tight ? PackedLeafHead::bits_of_code[code] : code + (code + 1) / 32;
  }

  /// Of the first `count` values that follow.
  template <class Use>
  HWY_INLINE void for_each_register(std::uint32_t count, std::uint32_t code, const Use& use) const {
    const auto base = hn::Set(Words(), base_of(bases_, axis_));
    for (std::uint32_t i = 0; i < count; i += lanes_of<D>) {
      use(i, hn::BitCast(D(), hn::Add(differences(i, code), base)));
      if constexpr (lanes_of<D> >= most_packed_corners) break;
    }
  }

  /// A corner has the value of the last change up to it, and before the first none: zero.
  template <class Use>
  HWY_INLINE void next_repeated(std::uint32_t changes, std::uint32_t code, const Use& use) const {
    const Words d;
    const auto changes_up_to = [&](std::uint32_t i) HWY_ATTR {
      const auto lane = hn::Add(hn::Iota(d, 0), hn::Set(d, i));
      const auto others = hn::Shl(hn::Set(d, ~1u), lane);
      return hn::PopulationCount(hn::AndNot(others, hn::Set(d, changes)));
    };
    if constexpr (lanes_of<D> >= most_packed_corners) {
      const auto count = changes_up_to(0);
      for_each_register(1, code, [&](std::uint32_t, hn::Vec<D> values) HWY_ATTR {
        const auto last = hn::And(hn::Sub(count, hn::Set(d, 1)), hn::Set(d, most_packed_corners - 1));
        const auto of_corners = hn::TableLookupLanes(hn::BitCast(d, values), hn::IndicesFromVec(d, last));
        use(0, hn::BitCast(D(), hn::IfThenElseZero(hn::Ne(count, hn::Zero(d)), of_corners)));
      });
    } else {
      alignas(64) float values[lanes_of<D> + most_packed_corners];
      values[lanes_of<D> - 1] = 0;
      for_each_register(most_packed_corners, code, [&](std::uint32_t i, hn::Vec<D> some) HWY_ATTR {
        hn::Store(some, D(), values + lanes_of<D> + i);
      });
      for (std::uint32_t i = 0; i < corners_; i += lanes_of<D>) {
        const auto count = hn::BitCast(hn::RebindToSigned<D>(), changes_up_to(i));
        use(i, hn::GatherIndex(D(), values + lanes_of<D> - 1, count));
      }
    }
  }

  HWY_INLINE hn::Vec<Words> differences(std::uint32_t i, std::uint32_t code) const {
    const Words d;
#if HWY_TARGET <= HWY_AVX3_DL
    if constexpr (lanes_of<D> == 16) {
      const TakenBits& taken = taken_bits.of_code[code];
      const hn::Repartition<std::uint8_t, D> bytes;
      const hn::Vec<Words> words{
          _mm512_permutexvar_epi8(hn::Load(bytes, taken.bytes).raw, hn::LoadU(bytes, stream_).raw)};
      return hn::And(hn::Shr(words, hn::Load(d, taken.shifts)), hn::Set(d, taken_bits.masks[code]));
    }
#endif
    return unpack_bits(d, stream_, i * bits_of(code), bits_of(code));
  }

  const std::uint8_t* bases_;
  const std::uint8_t* stream_;
  std::uint32_t codes_, corners_;
  int axis_ = 0;
};

#if HWY_TARGET <= HWY_AVX3

/// All corners lie in one register per axis. `head`: of a leaf that is not tight, or spread.
template <bool Tight>
HWY_INLINE void unpack_corners(const std::uint32_t* words, const std::uint32_t* head, LeafBlock<8>& out) {
  using D = hn::FixedTag<float, 16>;
  const D d;
  const hn::FixedTag<std::uint32_t, 16> du;
  const hn::FixedTag<float, 8> half;
  const hn::Vec<decltype(du)> index[3] = {unpack_indices(du, head, 0, 0), unpack_indices(du, head, 1, 0),
                                          unpack_indices(du, head, 2, 0)};
  PackedCorners<D, Tight> corners(words);
  for (int axis = 0; axis < 3; ++axis) {
    corners.next([&](std::uint32_t, hn::Vec<D> coordinates) HWY_ATTR {
      for (int vertex = 0; vertex < 3; ++vertex) {
        const auto of_triangles = hn::TableLookupLanes(coordinates, hn::IndicesFromVec(d, index[vertex]));
        hn::Store(hn::LowerHalf(half, of_triangles), half, out.vertices[vertex][axis]);
      }
    });
  }
}

#else

template <bool Tight>
HWY_INLINE void unpack_corners(const std::uint32_t* words, const std::uint32_t* head, LeafBlock<8>& out) {
  using D = hn::CappedTag<float, 8>;
  const D d;
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  alignas(64) float corners[3][most_packed_corners];
  PackedCorners<D, Tight> packed(words);
  for (auto& of_axis : corners) {
    packed.next([&](std::uint32_t i, hn::Vec<D> coordinates) HWY_ATTR { hn::Store(coordinates, d, of_axis + i); });
  }
  for (int vertex = 0; vertex < 3; ++vertex) {
    for (std::uint32_t i = 0; i < 8; i += lanes_of<D>) {
      const auto index = hn::BitCast(di, unpack_indices(du, head, vertex, i));
      for (int axis = 0; axis < 3; ++axis) {
        hn::Store(hn::GatherIndex(d, corners[axis], index), d, out.vertices[vertex][axis] + i);
      }
    }
  }
}

#endif

/// The number of one triangle of a packed leaf that is not tight.
HWY_INLINE std::uint32_t number_of_packed(const std::uint32_t* words, std::uint32_t triangle) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(words);
  const PackedLeafHead head(words[0]);
  const NumberRuns runs(bytes[PackedLeafHead::begin_of_joined(PackedLeafHead::all_pairs)], triangle);
  const auto bits = static_cast<std::int32_t>(head.number_bits);
  // Of the first run nothing is kept: what is before the others is read, and none of it taken. No branch, since runs
  // come as they like.
  const auto run = static_cast<std::int32_t>(runs.count()) - 1;
  const std::int32_t begin = (run - 1) * bits;
  std::uint64_t two;
  std::memcpy(&two, bytes + PackedLeafHead::begin_of_numbers(PackedLeafHead::all_pairs) + (begin >> 3), sizeof two);
  const std::uint64_t mask = (std::uint64_t{1} << (bits & -static_cast<std::int32_t>(run != 0))) - 1;
  return words[1] + static_cast<std::uint32_t>(two >> (begin & 7) & mask) + triangle - runs.last();
}

/// Of eight triangles, by which numbers are one more than the one before: the run that each is in, and in the upper
/// half of the byte its place there.
struct RunsTable {
  std::uint8_t of_joined[1u << most_packed_triangles][most_packed_triangles]{};

  constexpr RunsTable() {
    for (std::uint32_t joined = 0; joined < std::size(of_joined); ++joined) {
      for (std::uint32_t i = 0; i < most_packed_triangles; ++i) {
        const NumberRuns runs(joined & ~1u, i);
        of_joined[joined][i] = static_cast<std::uint8_t>((runs.count() - 1) | (i - runs.last()) << 4);
      }
    }
  }
};
inline constexpr RunsTable runs_table;

/// The numbers of eight triangles of such a leaf; those of missing ones may be any.
HWY_INLINE void unpack_numbers(const std::uint32_t* words, std::uint32_t* out) {
  const hn::CappedTag<std::uint32_t, most_packed_triangles> d;
  if constexpr (lanes_of<decltype(d)> == most_packed_triangles) {
    const PackedLeafHead head(words[0]);
    const std::uint32_t bits = head.number_bits;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(words);
    const auto* entries = runs_table.of_joined[bytes[PackedLeafHead::begin_of_joined(PackedLeafHead::all_pairs)]];
    const hn::Rebind<std::uint8_t, decltype(d)> narrow;
    const auto entry = hn::PromoteTo(d, hn::LoadU(narrow, entries));
    const auto run = hn::And(entry, hn::Set(d, 15));
    const auto place = hn::Mul(hn::Sub(hn::Max(run, hn::Set(d, 1)), hn::Set(d, 1)), hn::Set(d, bits));
    const auto kept =
        unpack_at(d, bytes + PackedLeafHead::begin_of_numbers(PackedLeafHead::all_pairs), place, mask_of_bits(d, bits));
    const auto first = hn::Add(hn::Set(d, words[1]), hn::IfThenZeroElse(hn::Eq(run, hn::Zero(d)), kept));
    hn::Store(hn::Add(first, hn::ShiftRight<4>(entry)), d, out);
  } else {
    for (std::uint32_t i = 0; i < most_packed_triangles; ++i) out[i] = number_of_packed(words, i);
  }
}

/// A packed leaf, or a part of one.
HWY_INLINE void unpack_leaf(const std::uint32_t* words, LeafBlock<8>& out) {
  unpack_corners<false>(words, words, out);
  unpack_numbers(words, out.primitives);
  static_assert(packed_more == more_blocks);
  out.primitives[0] |= words[0] & packed_more;
}

/// The same of a tight one.
HWY_NOINLINE inline void unpack_tight_leaf(const std::uint32_t* words, LeafBlock<8>& out) {
  SpreadHead head;
  head.take(words);
  unpack_corners<true>(words, head.words, out);
  unpack_numbers(head.words, out.primitives);
  out.primitives[0] |= words[0] & packed_more;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
