// Leaf steps of rays in flight: one ray against a block of triangles, or, where 512-bit registers allow, two rays
// against a block of eight each. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H
#undef BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_LEAF_STEPS_INL_H
#endif

#include <span>
#include <type_traits>

#include "layout/simd/single-inl.h"
#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// All blocks of the ray's leaf.
template <class Store>
HWY_INLINE void closest_in_blocks(const WideView& view, Slot& slot) {
  typename Store::BlockBuffer buffer;
  bool more = true;
  for (std::size_t i = 0; more; ++i) {
    const auto& block = Store::block(view, slot.next, i, buffer);
    if (closest_in_block(block, slot.leaf, slot.t_near, slot.t_limit, slot.best)) slot.t_limit = slot.best.t + 0.0f;
    more = (block.primitives[0] & more_blocks) != 0;
  }
}

/// From block number `first` on.
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
    for (std::uint32_t i = 0; i < list.size; ++i) closest_in_blocks<Store>(view, slots.at(list.offsets[i]));
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

/// Two rays in a register, eight triangles for each: those of the first in the lower lanes.
struct RayPair {
  using D = hn::FixedTag<float, 16>;
  using Half = hn::FixedTag<float, 8>;

  const Slot& a;
  const Slot& b;

  static HWY_INLINE hn::Vec<D> both(const float* low, const float* high) {
    return hn::Combine(D(), hn::Load(Half(), high), hn::Load(Half(), low));
  }
  static HWY_INLINE hn::Vec<D> both(float low, float high) {
    return hn::IfThenElse(hn::FirstN(D(), 8), hn::Set(D(), low), hn::Set(D(), high));
  }
  /// Those within the range of t of each.
  HWY_INLINE TriangleHits<D> in_range(const TriangleHits<D>& hits) const {
    const auto in = hn::And(hn::Ge(hits.t, both(a.t_near, b.t_near)), hn::Le(hits.t, both(a.t_limit, b.t_limit)));
    return {hn::And(hits.hit, in), hits.t, hits.v, hits.w, hits.determinant};
  }
  HWY_INLINE hn::Vec<D> scale_z() const { return both(a.leaf.scale_z, b.leaf.scale_z); }
  HWY_INLINE TriangleHits<D> hit(const LeafBlock<8>& block_a, const LeafBlock<8>& block_b) const {
    const auto vertices = [&](int vertex) HWY_ATTR {
      const auto coordinate = [&](int axis) HWY_ATTR {
        return both(block_a.vertices[vertex][a.leaf.axes[axis]], block_b.vertices[vertex][b.leaf.axes[axis]]);
      };
      return Vertices<D>{coordinate(0), coordinate(1), coordinate(2)};
    };
    const TriangleRay& x = a.leaf;
    const TriangleRay& y = b.leaf;
    const ShearedRays<D> rays{both(x.origin[0], y.origin[0]), both(x.origin[1], y.origin[1]),
                              both(x.origin[2], y.origin[2]), both(x.shear_x, y.shear_x),
                              both(x.shear_y, y.shear_y),     scale_z()};
    return in_range(hit_triangles(D(), {vertices(0), vertices(1), vertices(2)}, rays));
  }
};

/// Hits that are kept where they are found, since compilers would take them through memory.
template <class Keep>
HWY_INLINE std::uint32_t kept(const TriangleHits<RayPair::D>& hits, const Keep& keep) {
  keep(hits);
  return bits_of(RayPair::D(), hits.hit);
}

/// What the tests of pairs found, kept until the whole pass is tested: hits come as they like, and a branch on each
/// would be mispredicted as often.
struct PassHits {
  StoredHits<RayPair::D> pairs[most_in_flight / 2];
  std::uint32_t found[most_in_flight + 1];  // ray in the list
  std::uint32_t lanes[most_in_flight + 1];  // one bit each, of its half of the pair
  std::uint32_t size = 0;

  HWY_INLINE void note(std::uint32_t ray, std::uint32_t bits) {
    found[size] = ray;
    lanes[size] = bits;
    size += (bits + 0xff) >> 8;
  }
};

/// The first blocks of the leaves that a list of rays is at. A store whose leaves are packed has a form of its own,
/// which tests triangles without unpacking leaves to memory.
template <class Store>
class PassBlocks {
 public:
  /// Before the first test.
  HWY_INLINE void open(const Slots&, const WideView&, const SlotList&) {}
  /// Which triangles the i-th ray of the list and the next one hit, a bit each; calls keep(TriangleHits).
  template <class Keep>
  HWY_INLINE std::uint32_t hit(const WideView& view, const RayPair& rays, std::uint32_t i, const Keep& keep) {
    return kept(rays.hit(get(view, rays.a, i), get(view, rays.b, i + 1)), keep);
  }
  /// The name of a triangle of the i-th ray's block.
  HWY_INLINE std::uint32_t primitive(std::uint32_t i, std::uint32_t lane) const {
    return blocks_[i]->primitives[lane] & ~more_blocks;
  }
  /// Whether the leaf of any ray so far, or of the i-th, has more blocks.
  HWY_INLINE bool any_goes_on() const { return (more_ & more_blocks) != 0; }
  HWY_INLINE bool goes_on(std::uint32_t i) const { return (blocks_[i]->primitives[0] & more_blocks) != 0; }
  /// Rays that were in the list but have to come again, since their leaves are not there yet.
  HWY_INLINE std::span<const std::uint32_t> waiting() const { return {}; }

 private:
  HWY_INLINE const LeafBlock<8>& get(const WideView& view, const Slot& slot, std::uint32_t i) {
    blocks_[i] = &Store::block(view, slot.next, 0, none_);
    more_ |= blocks_[i]->primitives[0];
    return *blocks_[i];
  }

  const LeafBlock<8>* blocks_[most_in_flight + 1];
  static_assert(std::is_empty_v<typename Store::BlockBuffer>, "blocks lie in memory as they are");
  typename Store::BlockBuffer none_;
  std::uint32_t more_ = 0;
};

/// Where a ray's stack has a reference, be it of entries or of references alone.
HWY_INLINE WideReference& reference_of(StackEntry& entry) { return entry.reference; }
HWY_INLINE WideReference& reference_of(WideReference& reference) { return reference; }

template <class Store>
struct LeafSteps<Store, 8> {
  /// Has a ray come to its leaf again: on its stack, right above the top, still is what the leaf was taken from.
  template <class Entry>
  static HWY_INLINE Entry& push_again(Slot& slot) {
    auto* const taken = top_of<Entry>(slot);
    slot.top = taken + 1;
    return *taken;
  }
  /// Has it come to the next block of its leaf as it comes to leaves.
  template <class Entry>
  static HWY_INLINE void push_next_block(const WideView& view, Slot& slot) {
    reference_of(push_again<Entry>(slot)) = Store::next_block(view, slot.next);
  }

  /// The best of what was found for one ray, the i-th.
  static HWY_INLINE void keep_best(const PassBlocks<Store>& leaves, const PassHits& hits, std::uint32_t i,
                                   std::uint32_t lanes, Slot& slot) {
    const StoredHits<RayPair::D>& pair = hits.pairs[i / 2];
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const std::uint32_t at = (i & 1) * 8 + lane;
      const std::uint32_t primitive = leaves.primitive(i, lane);
      if (!wins(pair.t[at], 0, primitive, slot.best)) continue;
      slot.best = pair.hit(static_cast<int>(at), primitive, 0);
      slot.t_limit = pair.t[at] + 0.0f;
    }
  }

  static HWY_INLINE void closest_pass(const Slots& slots, const WideView& view, SlotList& list) {
    list.repeat_last();
    PassBlocks<Store> leaves;
    PassHits hits;
    leaves.open(slots, view, list);
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      const RayPair rays{slots.at(list.offsets[i]), slots.at(list.offsets[i + 1])};
      StoredHits<RayPair::D>& pair = hits.pairs[i / 2];
      const std::uint32_t bits =
          leaves.hit(view, rays, i, [&pair](const TriangleHits<RayPair::D>& found) HWY_ATTR { pair.store(found); });
      hits.note(i, bits & 0xff);
      hits.note(i + 1, bits >> 8);
    }
    for (std::uint32_t i = 0; i < hits.size; ++i) {
      const std::uint32_t ray = hits.found[i];
      keep_best(leaves, hits, ray, hits.lanes[i], slots.at(list.offsets[ray]));
    }
    for (std::uint32_t i = 0; leaves.any_goes_on() && i < list.size; ++i) {
      if (leaves.goes_on(i)) push_next_block<StackEntry>(view, slots.at(list.offsets[i]));
    }
    for (const std::uint32_t offset : leaves.waiting()) {
      push_again<StackEntry>(slots.at(offset));
      list.add(offset);
    }
  }
  template <class Decide>
  static HWY_INLINE void any_pass(const Slots& slots, const WideView& view, SlotList& list, Decide decide) {
    list.repeat_last();
    PassBlocks<Store> leaves;
    leaves.open(slots, view, list);
    for (std::uint32_t i = 0; i < list.size; i += 2) {
      Slot& a = slots.at(list.offsets[i]);
      Slot& b = slots.at(list.offsets[i + 1]);
      const std::uint32_t bits = leaves.hit(view, {a, b}, i, [](const TriangleHits<RayPair::D>&) HWY_ATTR {});
      const auto go_on = [&](std::uint32_t number, Slot& slot, bool found) HWY_ATTR {
        if (leaves.any_goes_on() && leaves.goes_on(number)) push_next_block<WideReference>(view, slot);
        decide(number, slot, found);
      };
      go_on(i, a, (bits & 0xff) != 0);
      if (i + 1 < list.size) go_on(i + 1, b, (bits & 0xff00) != 0);
    }
    for (const std::uint32_t offset : leaves.waiting()) {
      Slot& slot = slots.at(offset);
      push_again<WideReference>(slot);
      decide(list.size, slot, false);
      list.add(offset);
    }
  }
};

#endif  // HWY_TARGET <= HWY_AVX3
#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
