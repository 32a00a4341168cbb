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

/// Which corner is vertex `vertex` of each of eight triangles of two leaves, those of the second from 16 on.
HWY_INLINE hn::Vec<Words16Of> indices_of_both(const std::uint32_t* a, const std::uint32_t* b, int vertex) {
  const Words16Of d;
  const auto of_a = hn::Set(d, indices_of(a, vertex)), of_b = hn::Set(d, indices_of(b, vertex));
  const auto packed = hn::IfThenElse(hn::FirstN(d, 8), of_a, of_b);
  const auto lane = hn::Iota(d, 0);
  const auto shift = hn::ShiftLeft<2>(hn::And(lane, hn::Set(d, 7)));
  const auto second = hn::ShiftLeft<1>(hn::And(lane, hn::Set(d, 8)));
  return hn::OrAnd(second, hn::Shr(packed, shift), hn::Set(d, 15));
}

/// Corners of the whole list are unpacked first, since the steps of both wait for one another, and short loops have
/// more of them under way.
template <class Node, int N>
class PassBlocks<QuantizedStore<Node, N>> {
  using Store = QuantizedStore<Node, N>;

 public:
  HWY_INLINE void open(const Slots& slots, const WideView& view, SlotList& list) {
    const std::uint32_t with_partner = (list.size + 1) & ~1u;  // an odd last one is its own partner
    packed_ = view.positions == nullptr ? with_partner : open_named(slots, view, list);
    if (HWY_UNLIKELY(view.tight)) return unpack_tight(slots, view, list);
    for (std::uint32_t i = 0; i < packed_; ++i) {
      words_[i] = words_of(view, slots.at(list.offsets[i]));
      more_ |= words_[i][0];
      PackedCorners<RayPair::D, false> corners(words_[i]);
      for (auto& of_axis : corners_[i]) store_next(corners, of_axis);
    }
  }
  template <class Keep>
  HWY_INLINE std::uint32_t hit(const WideView& view, const RayPair& rays, std::uint32_t i, const Keep& keep) {
    if (HWY_UNLIKELY(!is_packed(i + 1))) return hit_blocks(view, rays, i, keep);
    const auto* const words_a = words_[i];
    const auto* const words_b = words_[i + 1];
    const hn::Vec<Words16Of> index[3] = {indices_of_both(words_a, words_b, 0), indices_of_both(words_a, words_b, 1),
                                         indices_of_both(words_a, words_b, 2)};
    const Corners a = sheared(rays.a, i), b = sheared(rays.b, i + 1);
    const auto pick = [&](int vertex) HWY_ATTR {
      const auto of_both = [&](hn::Vec<RayPair::D> of_a, hn::Vec<RayPair::D> of_b) HWY_ATTR {
        return hn::Vec<RayPair::D>{_mm512_permutex2var_ps(of_a.raw, index[vertex].raw, of_b.raw)};
      };
      return Corners{of_both(a.x, b.x), of_both(a.y, b.y), of_both(a.z, b.z)};
    };
    return kept(rays.in_range(hit_sheared(RayPair::D(), pick(0), pick(1), pick(2), rays.scale_z())), keep);
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
  HWY_INLINE std::span<const std::uint32_t> waiting() const { return std::span(waiting_).first(waits_); }

 private:
  static HWY_INLINE const std::uint32_t* words_of(const WideView& view, const Slot& slot) {
    return reinterpret_cast<const std::uint32_t*>(place_of(view, slot.next));
  }
  HWY_INLINE bool is_packed(std::uint32_t i) const { return i < packed_; }

  template <bool Tight>
  static HWY_INLINE void store_next(PackedCorners<RayPair::D, Tight>& corners, float* out) {
    corners.next([&](std::uint32_t, hn::Vec<RayPair::D> coordinates)
                     HWY_ATTR { hn::Store(coordinates, RayPair::D(), out); });
  }

  /// In two loops, each of which has all that it needs in registers.
  HWY_NOINLINE void unpack_tight(const Slots slots, const WideView view, const SlotList& list) {
    const std::uint32_t* tight[most_in_flight + 1];
    const std::uint32_t size = packed_;
    for (std::uint32_t i = 0; i < size; ++i) {
      tight[i] = words_of(view, slots.at(list.offsets[i]));
      more_ |= tight[i][0];
      spread_[i].take(tight[i]);
      words_[i] = spread_[i].words;
    }
    for (std::uint32_t i = 0; i < size; ++i) {
      PackedCorners<RayPair::D, true> corners(tight[i]);
#pragma GCC unroll 1  // three times both ways to keep an axis do not fit into registers
      for (auto& of_axis : corners_[i]) store_next(corners, of_axis);
    }
  }

  /// Puts rays whose leaves only name triangles last in the list, and gathers their triangles. Returns how many leaves
  /// there are to unpack.
  HWY_NOINLINE std::uint32_t open_named(const Slots& slots, const WideView& view, SlotList& list) {
    std::uint32_t packed = 0, named = 0;
    std::uint32_t offsets[most_in_flight];
    for (std::uint32_t i = 0; i < list.size; ++i) {
      const std::uint32_t offset = list.offsets[i];
      const bool is = (words_of(view, slots.at(offset))[0] & packed_leaf) != 0;
      list.offsets[packed] = offset;
      offsets[named] = offset;
      packed += is ? 1 : 0;
      named += is ? 0 : 1;
    }
    list.size = packed;
    for (std::uint32_t i = 0; i < named; ++i) {
      if (!view.out_of_cache || named >= enough_named || fetch(view, slots.at(offsets[i])))
        list.add(offsets[i]);
      else
        waiting_[waits_++] = offsets[i];
    }
    if (list.size != 0) list.repeat_last();
    if (list.size == packed) return (packed + 1) & ~1u;
    gather(slots, view, list, packed);
    return packed;
  }

  /// So many rays of a pass whose leaves name triangles have theirs fetched at once. Fewer would wait for one another,
  /// and come again instead while it is under way.
  static constexpr std::uint32_t enough_named = 8;
  /// Fetches what a leaf's triangles need next: their vertex numbers, then the vertices. Returns whether that was all.
  static HWY_INLINE bool fetch(const WideView& view, Slot& slot) {
    if (slot.fetched == 2) return true;
    std::uint32_t names[8];
    load_names(words_of(view, slot), names);
    if (slot.fetched++ == 0)
      fetch_triangles(view, names);
    else
      fetch_vertices(view, names);
    return false;
  }
  static HWY_INLINE void fetch_triangles(const WideView& view, const std::uint32_t* names) {
    for (int lane = 0; lane < 8; ++lane) __builtin_prefetch(&view.triangles[names[lane]]);
  }
  static HWY_INLINE void fetch_vertices(const WideView& view, const std::uint32_t* names) {
    for (int lane = 0; lane < 8; ++lane) {
      for (const std::uint32_t vertex : view.triangles[names[lane]]) __builtin_prefetch(&view.positions[vertex]);
    }
  }

  /// From the i-th ray on. What a step needs is fetched for all before the next begins.
  HWY_INLINE void gather(const Slots& slots, const WideView& view, const SlotList& list, std::uint32_t begin) {
    const std::uint32_t end = (list.size + 1) & ~1u;
    int count[most_in_flight + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      Slot& slot = slots.at(list.offsets[i]);
      slot.fetched = 0;
      count[i] = load_names(words_of(view, slot), blocks_[i].primitives);
      fetch_triangles(view, blocks_[i].primitives);
    }
    for (std::uint32_t i = begin; i < end; ++i) fetch_vertices(view, blocks_[i].primitives);
    for (std::uint32_t i = begin; i < end; ++i) {
      gather_vertices(view, count[i], blocks_[i]);
      blocks_[i].primitives[0] |= count[i] > 8 ? more_blocks : 0;
      more_ |= blocks_[i].primitives[0];
    }
  }

  template <class Keep>
  HWY_NOINLINE std::uint32_t hit_blocks(const WideView& view, const RayPair& rays, std::uint32_t i, const Keep& keep) {
    const auto& a = is_packed(i) ? Store::block(view, rays.a.next, 0, blocks_[i]) : blocks_[i];
    return kept(rays.hit(a, blocks_[i + 1]), keep);
  }

  using Corners = Vertices<RayPair::D>;
  /// The corners of the i-th ray's leaf, sheared by the ray: each once, however many triangles have it.
  HWY_INLINE Corners sheared(const Slot& slot, std::uint32_t i) const {
    const auto along = [&](int axis) HWY_ATTR { return hn::Load(RayPair::D(), corners_[i][slot.leaf.axes[axis]]); };
    return shear(RayPair::D(), {along(0), along(1), along(2)}, broadcast_sheared(RayPair::D(), slot.leaf));
  }

  const std::uint32_t* words_[most_in_flight + 1];
  SpreadHead spread_[most_in_flight + 1];  // of tight leaves
  alignas(64) float corners_[most_in_flight + 1][3][16];
  LeafBlock<8> blocks_[most_in_flight + 1];  // of leaves that only name triangles
  std::uint32_t waiting_[most_in_flight];
  std::uint32_t packed_ = 0, more_ = 0, waits_ = 0;
};

#endif  // HWY_TARGET <= HWY_AVX3
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
