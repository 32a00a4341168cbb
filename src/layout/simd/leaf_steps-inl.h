// Leaf steps of rays in flight: one ray against a block of triangles, or, where 512-bit registers allow, two rays
// against a block of eight each. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H
#undef BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H
#endif

#include "layout/simd/single-inl.h"
#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// All blocks of the ray's leaf from number `first` on.
template <class Store>
HWY_INLINE void closest_in_blocks(const WideView& view, std::size_t first, Slot& slot) {
  typename Store::BlockBuffer buffer;
  bool more = true;
  for (std::size_t i = first; more; ++i) {
    const auto& block = Store::block(view, slot.next, i, buffer);
    if (closest_in_block(block, slot.leaf, slot.t_near, slot.t_limit, slot.best)) slot.t_limit = slot.best.t + 0.0f;
    more = (block.primitives[0] & more_blocks) != 0;
  }
}

template <class Store>
HWY_INLINE bool any_in_blocks(const WideView& view, std::size_t first, const Slot& slot) {
  typename Store::BlockBuffer buffer;
  bool more = true;
  for (std::size_t i = first; more; ++i) {
    const auto& block = Store::block(view, slot.next, i, buffer);
    if (any_in_block(block, slot.leaf, slot.t_near, slot.t_limit)) return true;
    more = (block.primitives[0] & more_blocks) != 0;
  }
  return false;
}

/// L: triangles per block.
template <class Store, int L = Store::triangles>
struct LeafSteps {
  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, const SlotList& list) {
    for (std::uint32_t i = 0; i < list.size; ++i) closest_in_blocks<Store>(view, 0, slots.at(list.offsets[i]));
  }
  /// Calls decide(number in the list, slot, whether it is blocked) for each ray.
  template <class Decide>
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, const SlotList& list, Decide decide) {
    for (std::uint32_t i = 0; i < list.size; ++i) {
      Slot& slot = slots.at(list.offsets[i]);
      decide(i, slot, any_in_blocks<Store>(view, 0, slot));
    }
  }
};

#if HWY_TARGET <= HWY_AVX3

/// Two rays and a block of eight triangles for each.
struct BlockPair {
  using D = hn::FixedTag<float, 16>;
  using Half = hn::FixedTag<float, 8>;

  const LeafBlock<8>& a;
  const LeafBlock<8>& b;

  static HWY_INLINE hn::Vec<D> both(const float* low, const float* high) {
    return hn::Combine(D(), hn::Load(Half(), high), hn::Load(Half(), low));
  }
  static HWY_INLINE hn::Vec<D> both(float low, float high) {
    return hn::IfThenElse(hn::FirstN(D(), 8), hn::Set(D(), low), hn::Set(D(), high));
  }
  HWY_INLINE Vertices<D> vertices(int vertex, const TriangleRay& ray_a, const TriangleRay& ray_b) const {
    const auto coordinate = [&](int axis) {
      return both(a.vertices[vertex][ray_a.axes[axis]], b.vertices[vertex][ray_b.axes[axis]]);
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }
  /// Within the range of t of each.
  HWY_INLINE TriangleHits<D> hit(const Slot& slot_a, const Slot& slot_b) const {
    const D d;
    const TriangleRay& x = slot_a.leaf;
    const TriangleRay& y = slot_b.leaf;
    const Vertices<D> triangles[3] = {vertices(0, x, y), vertices(1, x, y), vertices(2, x, y)};
    const ShearedRays<D> rays{both(x.origin[0], y.origin[0]), both(x.origin[1], y.origin[1]),
                              both(x.origin[2], y.origin[2]), both(x.shear_x, y.shear_x),
                              both(x.shear_y, y.shear_y),     both(x.scale_z, y.scale_z)};
    TriangleHits<D> hits = hit_triangles(d, triangles, rays);
    hits.hit = hn::And(hits.hit, hn::And(hn::Ge(hits.t, both(slot_a.t_near, slot_b.t_near)),
                                         hn::Le(hits.t, both(slot_a.t_limit, slot_b.t_limit))));
    return hits;
  }
};

/// What the tests of pairs found, kept until the whole pass is tested: hits come as they like, and a branch on each
/// would be mispredicted as often.
struct PassHits {
  StoredHits<BlockPair::D> pairs[most_in_flight / 2];
  std::uint32_t found[most_in_flight + 1];  // ray in the list
  std::uint32_t lanes[most_in_flight + 1];  // one bit each, of its half of the pair
  std::uint32_t size = 0;

  HWY_INLINE void note(std::uint32_t ray, std::uint32_t bits) {
    found[size] = ray;
    lanes[size] = bits;
    size += (bits + 0xff) >> 8;
  }
};

/// The first blocks of the leaves of a list of rays.
template <class Store>
struct PassBlocks {
  const LeafBlock<8>* blocks[most_in_flight + 1];
  typename Store::BlockBuffer buffers[most_in_flight + 1];
  std::uint32_t more = 0;

  /// That of the i-th ray.
  HWY_INLINE const LeafBlock<8>& get(const Slots& slots, const WideView& view, const SlotList& list, std::uint32_t i) {
    blocks[i] = &Store::block(view, slots.at(list.offsets[i]).next, 0, buffers[i]);
    more |= blocks[i]->primitives[0];
    return *blocks[i];
  }
};

template <class Store>
struct LeafSteps<Store, 8> {
  static HWY_INLINE void test(const BlockPair& pair, const Slot& a, const Slot& b, std::uint32_t ray, PassHits& out) {
    const TriangleHits<BlockPair::D> hits = pair.hit(a, b);
    out.pairs[ray / 2].store(hits);
    const std::uint32_t bits = bits_of(BlockPair::D(), hits.hit);
    out.note(ray, bits & 0xff);
    out.note(ray + 1, bits >> 8);
  }

  /// The best of what was found for one ray.
  static HWY_INLINE void keep_best(const LeafBlock<8>& block, const StoredHits<BlockPair::D>& pair, std::uint32_t half,
                                   std::uint32_t lanes, Slot& slot) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const std::uint32_t at = half + lane;
      const std::uint32_t primitive = block.primitives[lane] & ~more_blocks;
      if (!wins(pair.t[at], 0, primitive, slot.best)) continue;
      slot.best = pair.hit(static_cast<int>(at), primitive, 0);
      slot.t_limit = pair.t[at] + 0.0f;
    }
  }

  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, SlotList& list) {
    list.repeat_last();
    PassBlocks<Store> leaves;
    PassHits hits;
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      const BlockPair pair{leaves.get(slots, view, list, i), leaves.get(slots, view, list, i + 1)};
      test(pair, slots.at(list.offsets[i]), slots.at(list.offsets[i + 1]), i, hits);
    }
    for (std::uint32_t i = 0; i < hits.size; ++i) {
      const std::uint32_t ray = hits.found[i];
      keep_best(*leaves.blocks[ray], hits.pairs[ray / 2], (ray & 1) * 8, hits.lanes[i], slots.at(list.offsets[ray]));
    }
    if (HWY_LIKELY((leaves.more & more_blocks) == 0)) return;
    for (std::uint32_t i = 0; i < list.size; ++i) {
      if ((leaves.blocks[i]->primitives[0] & more_blocks) == 0) continue;
      closest_in_blocks<Store>(view, 1, slots.at(list.offsets[i]));
    }
  }
  template <class Decide>
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, SlotList& list, Decide decide) {
    list.repeat_last();
    PassBlocks<Store> leaves;
    const auto more_found = [&](std::uint32_t i, const Slot& slot) HWY_ATTR {
      return (leaves.blocks[i]->primitives[0] & more_blocks) != 0 && any_in_blocks<Store>(view, 1, slot);
    };
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      Slot& a = slots.at(list.offsets[i]);
      Slot& b = slots.at(list.offsets[i + 1]);
      const BlockPair pair{leaves.get(slots, view, list, i), leaves.get(slots, view, list, i + 1)};
      const std::uint32_t bits = bits_of(BlockPair::D(), pair.hit(a, b).hit);
      bool found_a = (bits & 0xff) != 0, found_b = (bits & 0xff00) != 0;
      if (HWY_UNLIKELY((leaves.more & more_blocks) != 0)) {
        found_a = found_a || more_found(i, a);
        found_b = found_b || more_found(i + 1, b);
      }
      decide(i, a, found_a);
      if (i + 1 < list.size) decide(i + 1, b, found_b);
    }
  }
};

#endif  // HWY_TARGET <= HWY_AVX3
#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
