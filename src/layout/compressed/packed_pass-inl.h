// Packed leaves as the steps of rays in flight read them: corners go from their bits to registers, two leaves at a
// time. Compiled once per instruction set that has sixteen lanes.
#if defined(BOXWOOD_LAYOUT_COMPRESSED_PACKED_PASS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_COMPRESSED_PACKED_PASS_INL_H
#undef BOXWOOD_LAYOUT_COMPRESSED_PACKED_PASS_INL_H
#else
#define BOXWOOD_LAYOUT_COMPRESSED_PACKED_PASS_INL_H
#endif

#include "layout/compressed/packed_leaf-inl.h"
#include "layout/compressed/quantized_store-inl.h"
#include "layout/simd/leaf_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_TARGET <= HWY_AVX3

using Words16Of = hn::RebindToUnsigned<RayPair::D>;

/// The corners of a packed leaf, an axis at a time. Where each axis has its bits goes through memory: loads broadcast
/// it, while integer registers would have to be moved to vectors.
class PackedCorners {
 public:
  HWY_INLINE explicit PackedCorners(const std::uint32_t* words) : words_(words) {
    const hn::FixedTag<std::uint32_t, 4> d;
    const hn::FixedTag<std::uint16_t, 4> halves;
    // The fourth lanes, of numbers, are not used.
    const auto bits = hn::And(hn::Shr(hn::Set(d, words[0]), hn::Load(d, PackedLeafHead::places)), hn::Set(d, 63));
    const auto two = hn::Add(bits, hn::ShiftLeftLanes<1>(d, bits));
    const auto before = hn::ShiftLeftLanes<1>(d, hn::Add(two, hn::ShiftLeftLanes<2>(d, two)));
    const auto begin = hn::Add(hn::Mul(before, hn::Set(d, PackedLeafHead(words[0]).corners)),
                               hn::Set(d, PackedLeafHead::begin_of_corners));
    hn::Store(bits, d, bits_);
    hn::Store(hn::Sub(hn::Shl(hn::Set(d, 1), bits), hn::Set(d, 1)), d, mask_);
    hn::Store(hn::ShiftRight<5>(begin), d, word_);
    hn::Store(hn::And(begin, hn::Set(d, 31)), d, offset_);
    const auto* bases = reinterpret_cast<const std::uint16_t*>(words) + PackedLeafHead::begin_of_bases / 16;
    hn::Store(hn::ShiftLeft<16>(hn::PromoteTo(d, hn::LoadU(halves, bases))), d, base_);
  }
  /// The coordinate of each corner; lanes behind the last hold anything.
  HWY_INLINE hn::Vec<RayPair::D> coordinate(std::uint32_t axis) const {
    const Words16Of d;
    const auto place = hn::Add(hn::Mul(hn::Iota(d, 0), hn::Set(d, bits_[axis])), hn::Set(d, offset_[axis]));
    const auto differences = unpack_at(d, words_ + word_[axis], place, hn::Set(d, mask_[axis]));
    return hn::BitCast(RayPair::D(), hn::Add(differences, hn::Set(d, base_[axis])));
  }

 private:
  const std::uint32_t* words_;
  alignas(16) std::uint32_t bits_[4], mask_[4];    // of a difference
  alignas(16) std::uint32_t word_[4], offset_[4];  // where the first begins
  alignas(16) std::uint32_t base_[4];
};

/// Which corner is vertex `vertex` of each of eight triangles of two leaves, those of the second from 16 on.
HWY_INLINE hn::Vec<Words16Of> indices_of_both(const std::uint32_t* a, const std::uint32_t* b, int vertex) {
  const Words16Of d;
  const int word = PackedLeafHead::begin_of_indices / 32 + vertex;
  const auto packed = hn::IfThenElse(hn::FirstN(d, 8), hn::Set(d, a[word]), hn::Set(d, b[word]));
  const auto lane = hn::Iota(d, 0);
  const auto shift = hn::ShiftLeft<2>(hn::And(lane, hn::Set(d, 7)));
  const auto second = hn::ShiftLeft<1>(hn::And(lane, hn::Set(d, 8)));
  return hn::Or(hn::And(hn::Shr(packed, shift), hn::Set(d, 15)), second);
}

/// Corners of the whole list are unpacked first, since the steps of both wait for one another, and short loops have
/// more of them under way.
template <class Node, int N>
class PassBlocks<QuantizedStore<Node, N>> {
  using Store = QuantizedStore<Node, N>;

 public:
  HWY_INLINE void open(const Slots& slots, const WideView& view, const SlotList& list) {
    const std::uint32_t size = (list.size + 1) & ~1u;  // an odd last one is its own partner
    for (std::uint32_t i = 0; i < size; ++i) {
      const Slot& slot = slots.at(list.offsets[i]);
      words_[i] = reinterpret_cast<const std::uint32_t*>(place_of(view, slot.next));
      if (HWY_UNLIKELY(!is_packed(i))) continue;
      more_ |= words_[i][0];
      const PackedCorners corners(words_[i]);
      for (int axis = 0; axis < 3; ++axis) {
        hn::Store(corners.coordinate(slot.leaf.axes[axis]), RayPair::D(), corners_[i][axis]);
      }
    }
  }
  HWY_INLINE TriangleHits<RayPair::D> hit(const WideView& view, const RayPair& rays, std::uint32_t i) {
    if (HWY_UNLIKELY(!is_packed(i) || !is_packed(i + 1))) return hit_blocks(view, rays, i);
    const auto* const words_a = words_[i];
    const auto* const words_b = words_[i + 1];
    const hn::Vec<Words16Of> index[3] = {indices_of_both(words_a, words_b, 0), indices_of_both(words_a, words_b, 1),
                                         indices_of_both(words_a, words_b, 2)};
    hn::Vec<RayPair::D> out[3][3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = hn::Load(RayPair::D(), corners_[i][axis]), b = hn::Load(RayPair::D(), corners_[i + 1][axis]);
      for (int vertex = 0; vertex < 3; ++vertex) {
        out[vertex][axis] = hn::Vec<RayPair::D>{_mm512_permutex2var_ps(a.raw, index[vertex].raw, b.raw)};
      }
    }
    return rays.hit(
        {{out[0][0], out[0][1], out[0][2]}, {out[1][0], out[1][1], out[1][2]}, {out[2][0], out[2][1], out[2][2]}});
  }
  HWY_INLINE std::uint32_t primitive(std::uint32_t i, std::uint32_t lane) const {
    if (HWY_LIKELY(is_packed(i))) return number_of_packed(words_[i], lane);
    return blocks_[i].primitives[lane] & ~more_blocks;
  }
  HWY_INLINE bool any_goes_on() const { return (more_ & more_blocks) != 0; }
  HWY_INLINE bool goes_on(std::uint32_t i) const {
    const std::uint32_t word = is_packed(i) ? words_[i][0] : blocks_[i].primitives[0];
    return (word & more_blocks) != 0;
  }

 private:
  HWY_INLINE bool is_packed(std::uint32_t i) const { return (words_[i][0] & packed_leaf) != 0; }
  HWY_NOINLINE TriangleHits<RayPair::D> hit_blocks(const WideView& view, const RayPair& rays, std::uint32_t i) {
    const auto& a = Store::block(view, rays.a.next, 0, blocks_[i]);
    const auto& b = Store::block(view, rays.b.next, 0, blocks_[i + 1]);
    more_ |= a.primitives[0] | b.primitives[0];
    return rays.hit(a, b);
  }

  const std::uint32_t* words_[most_in_flight + 1];
  alignas(64) float corners_[most_in_flight + 1][3][16];  // in the axes of the ray
  LeafBlock<8> blocks_[most_in_flight + 1];               // of pairs of leaves of which one only names triangles
  std::uint32_t more_ = 0;
};

#endif  // HWY_TARGET <= HWY_AVX3
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
