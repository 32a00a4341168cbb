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

/// All blocks from `block` on.
template <int L>
HWY_INLINE void closest_in_blocks(const LeafBlock<L>* block, Slot& slot) {
  bool more = true;
  for (; more; ++block) {
    if (closest_in_block(*block, slot.leaf, slot.t_near, slot.t_limit, slot.best)) {
      slot.t_limit = slot.best.t + 0.0f;
    }
    more = (block->primitives[0] & more_blocks) != 0;
  }
}

template <int L>
HWY_INLINE bool any_in_blocks(const LeafBlock<L>* block, const Slot& slot) {
  bool more = true;
  for (; more; ++block) {
    if (any_in_block(*block, slot.leaf, slot.t_near, slot.t_limit)) return true;
    more = (block->primitives[0] & more_blocks) != 0;
  }
  return false;
}

template <int L>
struct LeafSteps {
  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, const SlotList& list) {
    for (std::uint32_t i = 0; i < list.size; ++i) {
      Slot& slot = slots.at(list.offsets[i]);
      closest_in_blocks(blocks_at<L>(view, slot.next), slot);
    }
  }
  /// Calls found(slot) or missed(slot) for each ray.
  template <class Decide>
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, const SlotList& list, Decide decide) {
    for (std::uint32_t i = 0; i < list.size; ++i) {
      Slot& slot = slots.at(list.offsets[i]);
      decide(i, slot, any_in_blocks(blocks_at<L>(view, slot.next), slot));
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
    return hn::Combine(D(), hn::Set(Half(), high), hn::Set(Half(), low));
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

/// What one pair's test found, kept until the whole pass is tested: hits come as they like, and a branch on each would
/// be mispredicted as often.
struct PairHits {
  alignas(64) float t[16], v[16], w[16], determinant[16];
};
struct PassHits {
  PairHits pairs[most_in_flight / 2];
  std::uint32_t found[most_in_flight + 1];  // ray in the list
  std::uint32_t lanes[most_in_flight + 1];  // one bit each, of its half of the pair
  std::uint32_t size = 0;

  HWY_INLINE void note(std::uint32_t ray, std::uint32_t bits) {
    found[size] = ray;
    lanes[size] = bits;
    size += (bits + 0xff) >> 8;
  }
};

template <>
struct LeafSteps<8> {
  static HWY_INLINE void test(const WideView& view, const Slot& a, const Slot& b, std::uint32_t ray, PassHits& out) {
    const BlockPair::D d;
    const BlockPair pair{*blocks_at<8>(view, a.next), *blocks_at<8>(view, b.next)};
    const TriangleHits<BlockPair::D> hits = pair.hit(a, b);
    PairHits& kept = out.pairs[ray / 2];
    hn::Store(hits.t, d, kept.t);
    hn::Store(hits.v, d, kept.v);
    hn::Store(hits.w, d, kept.w);
    hn::Store(hits.determinant, d, kept.determinant);
    const std::uint32_t bits = bits_of(d, hits.hit);
    out.note(ray, bits & 0xff);
    out.note(ray + 1, bits >> 8);
  }

  /// The best of what was found for one ray.
  static HWY_INLINE void keep_best(const LeafBlock<8>& block, const PairHits& pair, std::uint32_t half,
                                   std::uint32_t lanes, Slot& slot) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const std::uint32_t at = half + lane;
      const std::uint32_t primitive = block.primitives[lane] & ~more_blocks;
      if (!wins(pair.t[at], 0, primitive, slot.best)) continue;
      const float determinant = pair.determinant[at];
      slot.best = {pair.t[at], pair.v[at] / determinant, pair.w[at] / determinant, primitive, 0};
      slot.t_limit = pair.t[at] + 0.0f;
    }
  }

  /// Bit 0: the first ray is blocked; bit 1: the second.
  static HWY_INLINE std::uint32_t any_pair(const WideView& view, const Slot& a, const Slot& b) {
    const BlockPair pair{*blocks_at<8>(view, a.next), *blocks_at<8>(view, b.next)};
    const std::uint32_t bits = bits_of(BlockPair::D(), pair.hit(a, b).hit);
    std::uint32_t found = ((bits & 0xff) != 0 ? 1u : 0) | ((bits & 0xff00) != 0 ? 2u : 0);
    const std::uint32_t more = pair.a.primitives[0] | pair.b.primitives[0];
    if (HWY_UNLIKELY((more & more_blocks) != 0)) {
      if ((pair.a.primitives[0] & more_blocks) != 0 && any_in_blocks(&pair.a + 1, a)) found |= 1;
      if ((pair.b.primitives[0] & more_blocks) != 0 && any_in_blocks(&pair.b + 1, b)) found |= 2;
    }
    return found;
  }
  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, SlotList& list) {
    PassHits hits;
    std::uint32_t more = 0;
    list.offsets[list.size] = list.offsets[list.size - 1];  // an odd last ray is its own partner
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      const Slot& a = slots.at(list.offsets[i]);
      const Slot& b = slots.at(list.offsets[i + 1]);
      test(view, a, b, i, hits);
      more |= blocks_at<8>(view, a.next)->primitives[0] | blocks_at<8>(view, b.next)->primitives[0];
    }
    for (std::uint32_t i = 0; i < hits.size; ++i) {
      const std::uint32_t ray = hits.found[i];
      Slot& slot = slots.at(list.offsets[ray]);
      keep_best(*blocks_at<8>(view, slot.next), hits.pairs[ray / 2], (ray & 1) * 8, hits.lanes[i], slot);
    }
    if (HWY_LIKELY((more & more_blocks) == 0)) return;
    for (std::uint32_t i = 0; i < list.size; ++i) {
      Slot& slot = slots.at(list.offsets[i]);
      const LeafBlock<8>* block = blocks_at<8>(view, slot.next);
      if ((block->primitives[0] & more_blocks) != 0) closest_in_blocks(block + 1, slot);
    }
  }
  template <class Decide>
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, SlotList& list, Decide decide) {
    list.offsets[list.size] = list.offsets[list.size - 1];
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      Slot& a = slots.at(list.offsets[i]);
      Slot& b = slots.at(list.offsets[i + 1]);
      const std::uint32_t found = any_pair(view, a, b);
      decide(i, a, (found & 1) != 0);
      if (i + 1 < list.size) decide(i + 1, b, (found & 2) != 0);
    }
  }
};

#endif  // HWY_TARGET <= HWY_AVX3
#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
