// How kernels get at nodes and leaf blocks. A store says where they are and, when they are packed, unpacks them into a
// buffer of the caller's. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SIMD_STORE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_STORE_INL_H
#undef BOXWOOD_LAYOUT_SIMD_STORE_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_STORE_INL_H
#endif

#include <algorithm>

#include "layout/simd/lanes-inl.h"
#include "layout/simd/wide_arena.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Nodes of N children and blocks of L triangles lie in memory as the kernels read them.
template <int N, int L>
struct PlainStore {
  static constexpr int children = N, triangles = L;
  static constexpr std::uint32_t row_bytes = 4 * N;  // of the planes of one side of one axis
  struct NodeBuffer {};
  struct BlockBuffer {};

  static HWY_INLINE const WideNode<N>& node(const WideView& view, WideReference reference, NodeBuffer&) {
    return *reinterpret_cast<const WideNode<N>*>(view.base + std::size_t{reference} * 16);
  }
  /// One plane of the child in `lane`; rows as in WideNode.
  static HWY_INLINE float plane(const WideView& view, WideReference reference, int row, std::uint32_t lane) {
    return reinterpret_cast<const WideNode<N>*>(view.base + std::size_t{reference} * 16)->planes[row][lane];
  }
  /// Block `number` of the run that begins at `reference`.
  static HWY_INLINE const LeafBlock<L>& block(const WideView& view, WideReference reference, std::size_t number,
                                              BlockBuffer&) {
    return reinterpret_cast<const LeafBlock<L>*>(view.base + wide_offset(reference))[number];
  }
  /// The rest of a leaf, from its second block on.
  static HWY_INLINE WideReference next_block(const WideView&, WideReference reference) {
    static_assert(sizeof(LeafBlock<L>) % 32 == 0);
    return reference + sizeof(LeafBlock<L>) / 16;
  }
  /// All lines of a node or of a block.
  static HWY_INLINE void prefetch(const WideView& view, WideReference reference) {
    constexpr std::size_t node_bytes = sizeof(WideNode<N>), block_bytes = sizeof(LeafBlock<L>);
    const std::byte* place = view.base + std::size_t{reference} * 16;
    for (std::size_t at = 0; at < block_bytes; at += 64) __builtin_prefetch(place + at);
    if constexpr (node_bytes > block_bytes) {
      // What only nodes have; of blocks the first lines again, without a branch.
      const std::byte* rest = place + (block_bytes >> (reference % 2 * 8));
      for (std::size_t at = 0; at < node_bytes - block_bytes; at += 64) __builtin_prefetch(rest + at);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
