// Quantized nodes as the steps of rays in flight read them: boxes are tested on the grid, never unpacked. Compiled once
// per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_COMPRESSED_OPEN_QUANTIZED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_COMPRESSED_OPEN_QUANTIZED_INL_H
#undef BOXWOOD_LAYOUT_COMPRESSED_OPEN_QUANTIZED_INL_H
#else
#define BOXWOOD_LAYOUT_COMPRESSED_OPEN_QUANTIZED_INL_H
#endif

#include "layout/compressed/quantized_store-inl.h"
#include "layout/simd/open_node-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

template <class Node, int N>
class OpenNode<QuantizedStore<Node, N>> {
 public:
  HWY_INLINE OpenNode(const WideView& view, WideReference reference)
      : node_(*reinterpret_cast<const Node*>(place_of(view, reference))) {}

  /// A plane's distance is (origin + q * step) / direction - offset, taken as q * (step / direction) plus what all
  /// children share. The first product is rounded, the sum once more, and the plane once less: that is at most four
  /// parts in 2^24 of the largest coordinate, and with the 28 of PreparedRay's own tests all that it widens boxes by.
  template <class D>
  HWY_INLINE BoxHits<D> hit(D d, int begin, const Slot& slot) const {
    const Axes axes(node_, slot);
    const auto plane = [&](int axis, std::uint32_t row, float begin_of_grid) {
      const auto* q = reinterpret_cast<const std::uint8_t*>(&node_) + row + begin;
      const hn::RebindToSigned<D> di;
      const auto steps = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::uint8_t, D>(), q)));
      return hn::MulAdd(steps, hn::Set(d, axes.step[axis]), hn::Set(d, begin_of_grid));
    };
    const auto near_plane = [&](int axis) { return plane(axis, slot.near_row[axis], axes.near_begin[axis]); };
    const auto far_plane = [&](int axis) { return plane(axis, slot.near_row[axis] ^ N, axes.far_begin[axis]); };
    const auto entry = hn::Max(hn::Max(near_plane(0), near_plane(1)), hn::Max(near_plane(2), hn::Set(d, slot.t_near)));
    const auto exit = hn::Min(hn::Min(far_plane(0), far_plane(1)), hn::Min(far_plane(2), hn::Set(d, slot.t_limit)));
    const auto some = children_of(hn::RebindToUnsigned<D>(), node_, begin).some;
    return {entry, hn::And(hn::RebindMask(d, some), hn::Le(entry, exit))};
  }

  template <class D>
  HWY_INLINE hn::Vec<hn::RebindToUnsigned<D>> children(D, int begin) const {
    return children_of(hn::RebindToUnsigned<D>(), node_, begin).references;
  }

 private:
  /// Per axis: how far along the ray a step of the grid is, and where the grid begins.
  struct Axes {
    alignas(16) float step[4], near_begin[4], far_begin[4];

    HWY_INLINE Axes(const Node& node, const Slot& slot) {
      const FourFloats d;
      const auto origin = origins(node), inverse = hn::LoadU(d, slot.inverse);
      hn::Store(hn::Mul(steps(node), inverse), d, step);
      hn::Store(hn::MulSub(origin, inverse, hn::LoadU(d, slot.near_offset)), d, near_begin);
      hn::Store(hn::MulSub(origin, inverse, hn::LoadU(d, slot.far_offset)), d, far_begin);
    }

    // Fourth lanes are of no use, but no slow denormals.
    static HWY_INLINE hn::Vec<FourFloats> origins(const QuantizedNode8& node) {
      return hn::MaskedLoad(hn::FirstN(FourFloats(), 3), FourFloats(), node.origin);
    }
    static HWY_INLINE hn::Vec<FourFloats> origins(const QuantizedNode16& node) {
      return hn::Load(FourFloats(), node.origin);
    }
    static HWY_INLINE hn::Vec<FourFloats> steps(const QuantizedNode8& node) {
      const hn::RebindToSigned<FourFloats> d;
      const auto exponent = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, FourFloats>(), node.exponent));
      return hn::BitCast(FourFloats(), hn::ShiftLeft<23>(exponent));
    }
    static HWY_INLINE hn::Vec<FourFloats> steps(const QuantizedNode16& node) {
      return hn::Load(FourFloats(), node.step);
    }
  };

  const Node& node_;
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
