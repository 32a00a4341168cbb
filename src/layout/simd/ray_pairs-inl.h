// What a stream does with nodes that few of its rays enter: each ray takes the step by itself, many of them in one
// loop, whatever node they are at. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_RAY_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_RAY_PAIRS_INL_H
#undef BOXWOOD_LAYOUT_SIMD_RAY_PAIRS_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_RAY_PAIRS_INL_H
#endif

#include <algorithm>

#include "layout/simd/open_node-inl.h"
#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// Rays, by their slots' offsets, with a reference each.
template <std::uint32_t Capacity>
struct RayPairs {
  static constexpr std::uint32_t capacity = Capacity;

  std::uint32_t size = 0;
  alignas(64) std::uint32_t rays[capacity + 16];  // whole vectors are written behind the end
  alignas(64) WideReference references[capacity + 16];

  /// At most as many as a register holds.
  HWY_INLINE void add(const std::uint32_t* offsets, WideReference reference, std::uint32_t count) {
    const WidestWords d;
    hn::StoreU(hn::LoadU(d, offsets), d, rays + size);
    hn::StoreU(hn::Set(d, reference), d, references + size);
    size += count;
  }
  /// Writes those of a register to `place`, and returns how many.
  HWY_INLINE std::uint32_t put(hn::Vec<WidestWords> offsets, hn::Vec<WidestWords> with, hn::Mask<WidestWords> which,
                               std::uint32_t place) {
    compress_store<WidestWords>(offsets, which, rays + place);
    return compress_store<WidestWords>(with, which, references + place);
  }
};

/// Rays at nodes, the last of which take a step together: what that finds comes first, so that few are waiting.
template <class Store>
class RaysAtNodes {
  static constexpr std::uint32_t at_once = 64, most_children = Store::children, most_waiting = 3072;

 public:
  using Leaves = RayPairs<at_once * most_children>;

  /// At most as many as a register holds.
  HWY_INLINE void add(const std::uint32_t* offsets, WideReference node, std::uint32_t count) {
    nodes_.add(offsets, node, count);
  }
  bool empty() const { return nodes_.size == 0; }
  /// Enough for a step that is worth it.
  bool enough() const { return nodes_.size >= at_once; }

  /// The last pairs take a step; `leaves`: what they enter besides nodes. Returns how many they were. slot(offset): a
  /// ray's.
  template <class SlotAt>
  HWY_INLINE std::uint32_t step(const WideView& view, SlotAt slot, Leaves& leaves) {
    // One after the other they need no more room than a ray's stack, which there is in any case.
    const std::uint32_t taken = nodes_.size <= most_waiting ? std::min(at_once, nodes_.size) : 1;
    nodes_.size -= taken;
    meet(view, slot, taken);
    split(leaves);
    if (view.out_of_cache) {
      for (std::uint32_t i = 0; i < met_.size; ++i) Store::prefetch(view, met_.references[i]);
    }
    return taken;
  }

 private:
  static constexpr int N = Store::children;
  using D = Floats<N>;
  using Words = hn::RebindToUnsigned<D>;

  /// The children that the `taken` pairs behind the end enter.
  template <class SlotAt>
  HWY_INLINE void meet(const WideView& view, SlotAt slot, std::uint32_t taken) {
    const D d;
    const WidestWords words;
    std::uint32_t size = 0;
    const std::uint32_t begin = nodes_.size, end = begin + taken;
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t offset = nodes_.rays[i];
      const OpenNode<Store> node(view, nodes_.references[i]);
      for (int first = 0; first < N; first += lanes_of<D>) {
        hn::StoreU(hn::Set(words, offset), words, met_.rays + size);
        const auto hit = hn::RebindMask(Words(), node.hit(d, first, slot(offset)).hit);
        size += compress_store<Words>(node.children(d, first), hit, met_.references + size);
      }
    }
    met_.size = size;
  }

  HWY_INLINE void split(Leaves& leaves) {
    const WidestWords d;
    const hn::RebindToSigned<WidestWords> di;
    std::uint32_t node_count = nodes_.size, leaf_count = 0;
    const std::uint32_t size = met_.size;
    for (std::uint32_t i = 0; i < size; i += lanes_of<WidestWords>) {
      const auto rays = hn::Load(d, met_.rays + i), references = hn::Load(d, met_.references + i);
      const auto in_use = hn::RebindMask(d, hn::Lt(hn::Iota(di, 0), hn::Set(di, static_cast<int>(size - i))));
      const auto leaf = hn::TestBit(references, hn::Set(d, 1));
      node_count += nodes_.put(rays, references, hn::AndNot(leaf, in_use), node_count);
      leaf_count += leaves.put(rays, references, hn::And(leaf, in_use), leaf_count);
    }
    nodes_.size = node_count;
    leaves.size = leaf_count;
  }

  RayPairs<most_waiting + at_once * most_children + wide_stack_limit> nodes_;
  Leaves met_;
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
