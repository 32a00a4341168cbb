// A node as the steps of rays in flight read it. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_OPEN_NODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_OPEN_NODE_INL_H
#undef BOXWOOD_LAYOUT_SIMD_OPEN_NODE_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_OPEN_NODE_INL_H
#endif

#include "layout/simd/boxes-inl.h"
#include "layout/simd/slots-inl.h"
#include "layout/simd/store-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// The node at a reference. A store whose nodes are packed has a form of its own, which tests boxes without unpacking.
template <class Store>
class OpenNode;

template <int N, int L>
class OpenNode<PlainStore<N, L>> {
 public:
  HWY_INLINE OpenNode(const WideView& view, WideReference reference)
      : node_(*reinterpret_cast<const WideNode<N>*>(view.base + std::size_t{reference} * 16)) {}

  /// Children from `begin` on against the ray of a slot, as many as a register holds.
  template <class D>
  HWY_INLINE BoxHits<D> hit(D d, int begin, const Slot& slot) const {
    constexpr std::uint32_t other = PlainStore<N, L>::row_bytes;  // from lower planes to upper ones and back
    const auto* base = reinterpret_cast<const std::byte*>(&node_);
    const auto plane = [&](std::uint32_t row, int axis, float offset) {
      return hn::MulSub(hn::Load(d, reinterpret_cast<const float*>(base + row) + begin), hn::Set(d, slot.inverse[axis]),
                        hn::Set(d, offset));
    };
    const std::uint32_t x = slot.near_row[0], y = slot.near_row[1], z = slot.near_row[2];
    const auto entry = hn::Max(hn::Max(plane(x, 0, slot.near_offset[0]), plane(y, 1, slot.near_offset[1])),
                               hn::Max(plane(z, 2, slot.near_offset[2]), hn::Set(d, slot.t_near)));
    const auto exit = hn::Min(hn::Min(plane(x ^ other, 0, slot.far_offset[0]), plane(y ^ other, 1, slot.far_offset[1])),
                              hn::Min(plane(z ^ other, 2, slot.far_offset[2]), hn::Set(d, slot.t_limit)));
    return {entry, hn::Le(entry, exit)};
  }

  /// Where the children are that hit() tested.
  template <class D>
  HWY_INLINE hn::Vec<hn::RebindToUnsigned<D>> children(D, int begin) const {
    return hn::Load(hn::RebindToUnsigned<D>(), node_.children + begin);
  }

 private:
  const WideNode<N>& node_;
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
